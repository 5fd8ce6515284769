//! Failed cases of one kind, and the values of the swept keys among them.

use std::collections::BTreeMap;

use serde::Serialize;

use super::table::Table;
use crate::keys::shortened;
use crate::math::name::name_of;
use crate::math::words::counted;
use crate::results::Fared;

/// How many values of a key are listed for failed cases.
const MOST_VALUES: usize = 20;

/// How many failed cases each value of each swept key has.
#[derive(Default, Serialize)]
pub(super) struct FailedCases {
    reason: String,
    cases: usize,
    example: String,
    values: BTreeMap<String, BTreeMap<String, usize>>,
}

impl FailedCases {
    /// Groups failed runs by kind.
    pub(super) fn of(failed: &[&Fared]) -> Vec<FailedCases> {
        let mut groups: BTreeMap<_, FailedCases> = BTreeMap::new();
        for record in failed {
            let kind = record.failure.map_or_else(|| "failed".to_owned(), name_of);
            let group = groups.entry(kind).or_insert_with_key(|kind| FailedCases {
                reason: kind.clone(),
                example: record.reason.clone(),
                ..FailedCases::default()
            });
            group.cases += 1;
            for (key, value) in &record.values {
                let counts = group.values.entry(key.clone()).or_default();
                *counts.entry(value.to_string()).or_default() += 1;
            }
        }
        groups.into_values().collect()
    }

    /// The table for people.
    pub(super) fn text(&self) -> String {
        let mut table = Table::default();
        for (key, values) in &self.values {
            let counts =
                values.iter().map(|(value, count)| format!("{} ({count})", shortened(value)));
            let more = values.len().saturating_sub(MOST_VALUES);
            let more = (more > 0).then(|| counted(more, "other") + " (--format json has all)");
            let counts: Vec<_> = counts.take(MOST_VALUES).chain(more).collect();
            table.row([key.clone(), counts.join(", ")]);
        }
        let (reason, cases) = (&self.reason, counted(self.cases, "case"));
        format!("\n{reason}: {cases}, such as\n  {}\n{}", self.example, table.render())
    }
}
