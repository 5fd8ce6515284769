//! The quantities of a matrix, and the scales of their errors.

use serde::Deserialize;

use crate::results::CaseRecord;

/// A field of the outcome (a maximum's value), or a reading of the scene.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(from = "String")]
pub struct Quantity {
    name: String,
    kind: Kind,
}

/// The kind of a quantity. It decides the scale of its error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A force, relative to its true value.
    Force,
    /// A level, relative to the still water depth.
    Runup,
    /// A displacement, relative to its true value.
    Displacement,
    /// Any other quantity of a flow, relative to its true value.
    Flow,
    /// The error of a flow, in percent: used as it is.
    Gap,
}

/// Fields of the outcome by kind. All others, and readings, are of the flow.
const FIELDS: [(Kind, &[&str]); 3] = [
    (
        Kind::Force,
        &[
            "force_max",
            "first_force_max",
            "first_force_peak",
            "force_max_raw",
            "force_at_rest",
            "force_end",
        ],
    ),
    (Kind::Runup, &["runup_max", "first_runup_max", "first_runup_peak", "runup_end"]),
    (Kind::Displacement, &["displacement_max", "first_displacement_max", "displacement_end"]),
];

impl From<String> for Quantity {
    fn from(name: String) -> Quantity {
        let field = FIELDS.iter().find(|(_, names)| names.contains(&name.as_str()));
        let gap = name.ends_with("_gap") || name.ends_with("_gap_percent");
        let other = if gap { Kind::Gap } else { Kind::Flow };
        Quantity { kind: field.map_or(other, |(kind, _)| *kind), name }
    }
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}

impl Quantity {
    /// What it is.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its value in a record; `None` where it has none.
    pub fn of(&self, record: &CaseRecord) -> Option<f64> {
        if let Some(reading) = record.readings.iter().find(|reading| reading.name == self.name) {
            return Some(reading.value);
        }
        let outcome = serde_json::to_value(record.outcome.as_ref()?).ok()?;
        let field = outcome.get(&self.name)?;
        field.as_f64().or_else(|| field.get("value")?.as_f64())
    }

    /// Its error in a record, percent.
    pub fn error_percent(&self, record: &CaseRecord, exact: f64) -> Option<f64> {
        let off = self.of(record)? - exact;
        Some(match self.kind {
            Kind::Gap => off,
            Kind::Runup => 100.0 * off,
            Kind::Force | Kind::Displacement | Kind::Flow => 100.0 * off / exact.abs(),
        })
    }
}
