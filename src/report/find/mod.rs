//! The part of a finished study that meets a condition, from its files alone.

mod boundaries;
mod boundary;
mod condition;
mod line;
mod subject;
#[cfg(test)]
mod tests;

pub use boundary::{Basis, Boundary};
pub use condition::{Comparison, Condition, Verdict};
pub use subject::{Reading, Subject};

use super::load::Loaded;

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// What was asked.
    pub condition: Condition,
    /// The answer for every row of the summary.
    pub verdicts: Vec<Verdict>,
    /// Where the part that meets it begins and ends.
    pub boundaries: Vec<Boundary>,
}

/// Looks for the cases that meet a condition, and for its boundaries along the swept keys.
///
/// # Errors
/// In one line: what is wrong with the condition.
pub fn find(text: &str, data: &Loaded) -> Result<Found, String> {
    let condition = Condition::read(text, data)?;
    let verdicts = (0..data.rows.len()).map(|row| condition.verdict(row)).collect();
    let boundaries = boundaries::boundaries(&condition, data);
    Ok(Found { condition, verdicts, boundaries })
}

impl Found {
    /// The rows with a verdict.
    pub fn rows(&self, verdict: Verdict) -> impl Iterator<Item = usize> {
        let all = self.verdicts.iter().enumerate();
        all.filter(move |(_, one)| **one == verdict).map(|(row, _)| row)
    }

    /// Why nothing can be told of a case.
    pub fn why(&self, row: usize) -> &'static str {
        let readings = self.condition.0.iter().filter_map(|comparison| {
            let unknown = comparison.verdict(row) == Verdict::Unknown;
            unknown.then_some(comparison.subject.readings[row])
        });
        match readings.max_by_key(|reading| matches!(reading, Reading::Failed)) {
            Some(Reading::Failed) => "failed",
            Some(Reading::Missing) => "has no such value",
            Some(Reading::Value { .. }) => "a lower bound, short of the limit",
            None => "",
        }
    }
}
