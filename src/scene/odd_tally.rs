//! Odd values of several cases, each key once.

use std::collections::BTreeMap;

use super::config::CaseConfig;
use super::odd_values::odd_values;

/// By key the first odd value in words, and the number of cases with odd values of this key.
#[derive(Debug, Default)]
pub struct OddTally {
    keys: BTreeMap<String, (String, usize)>,
    cases: usize,
}

impl OddTally {
    /// Counts a case.
    pub fn add(&mut self, case: &CaseConfig) {
        self.cases += 1;
        for value in odd_values(case) {
            let first = || (value.to_string(), 0);
            self.keys.entry(value.key.clone()).or_insert_with(first).1 += 1;
        }
    }

    /// Counts the cases of a tally of later ones.
    pub fn append(&mut self, later: OddTally) {
        self.cases += later.cases;
        for (key, (first, cases)) in later.keys {
            self.keys.entry(key).or_insert((first, 0)).1 += cases;
        }
    }

    /// A line per key. Where only some of the cases have odd values, what `some` makes of their
    /// number follows.
    pub fn lines(self, some: impl Fn(usize) -> String) -> Vec<String> {
        let line = |(line, cases): (String, usize)| match cases {
            cases if cases == self.cases => line,
            cases => line + &some(cases),
        };
        self.keys.into_values().map(line).collect()
    }
}
