//! The part of a finished study that meets a condition, from its files alone.

mod condition;
mod line;
mod subject;
#[cfg(test)]
mod tests;

pub use condition::{Comparison, Condition, Verdict};
pub use subject::{Number, Subject};

use serde::Serialize;

use self::line::{Line, lines};
use super::load::Loaded;
use super::row::Row;
use super::study::Key;
use crate::math::scale::Scale;

/// One end of a part of an axis that meets the condition.
#[derive(Debug, Clone)]
pub struct Boundary {
    /// The swept key, by its place among the study's keys.
    pub key: usize,
    /// A case of the line. It gives the values of the other swept keys.
    pub row: usize,
    /// How the axis is spread.
    pub scale: Scale,
    /// Whether the condition is met above the boundary, rather than below it.
    pub met_above: bool,
    /// The boundary's value; `None` where there is nothing to interpolate with.
    pub at: Option<f64>,
    /// The range in which the boundary lies, as far as known.
    pub between: [f64; 2],
    /// What the range rests on.
    pub basis: Basis,
    /// Whether a case beside the boundary is doubtful.
    pub doubtful: bool,
}

/// What the range of a boundary rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// The bend of the curve, from a third point beside the two interpolated ones, and error bars.
    Bend,
    /// Two cases alone: no third shows how the curve bends.
    TwoCases,
    /// The value beyond is a lower bound.
    LowerBound,
    /// One of the two values is exactly 0: the quantity leaves 0 somewhere between them.
    Start,
    /// The cases between have no value or failed.
    Gap,
    /// The condition is on the axis itself.
    Exact,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The condition.
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
    // What a failed case was to compute is met by none, though its values of swept keys are known.
    let verdict = |(row, at): (usize, &Row)| match condition.verdict(row) {
        Verdict::Met if !at.is_ok() => Verdict::Unknown,
        verdict => verdict,
    };
    let verdicts = data.rows.iter().enumerate().map(verdict).collect();
    let boundaries = boundaries(&condition, data);
    Ok(Found { condition, verdicts, boundaries })
}

impl Found {
    /// The rows with this verdict.
    pub fn rows(&self, verdict: Verdict) -> impl Iterator<Item = usize> {
        let all = self.verdicts.iter().enumerate();
        all.filter(move |(_, one)| **one == verdict).map(|(row, _)| row)
    }

    /// Why a case's verdict is unknown.
    pub fn why(&self, row: usize) -> &'static str {
        let readings = self.condition.0.iter().filter_map(|comparison| {
            let unknown = comparison.verdict(row) == Verdict::Unknown;
            unknown.then_some(comparison.subject.readings[row])
        });
        match readings.max_by_key(|reading| matches!(reading, Number::Failed)) {
            Some(Number::Failed) | None => "failed",
            Some(Number::Missing) => "has no such value",
            Some(Number::Value { .. }) => "a lower bound, short of the limit",
        }
    }
}

/// The boundaries along every swept key that holds numbers.
fn boundaries(condition: &Condition, data: &Loaded) -> Vec<Boundary> {
    if condition.picks_points(data) {
        return Vec::new();
    }
    let of_key = |key: usize| {
        let axis = &data.keys[key];
        if condition.equal().any(|one| one.name == axis.name) {
            return Vec::new();
        }
        let Some(scale) = scale(axis, data) else { return Vec::new() };
        let lines = lines(key, scale, data);
        lines.iter().flat_map(|stops| Line { condition, data, key, scale, stops }.all()).collect()
    };
    (0..data.keys.len()).flat_map(of_key).collect()
}

/// How an axis is spread: as the sweep file says, or else by its values. `None` where its values
/// are no numbers, or all the same.
fn scale(key: &Key, data: &Loaded) -> Option<Scale> {
    let numbers = || key.cells.iter().filter(|cell| !cell.is_empty());
    let values: Vec<f64> = numbers().map(|cell| cell.parse()).collect::<Result<_, _>>().ok()?;
    if values.iter().all(|value| *value == values[0]) {
        return None;
    }
    let written = || {
        let grid = &data.file.as_ref()?.grid;
        let axis = grid.get(&key.name)?.as_table()?;
        let spacing = axis.get("spacing").and_then(toml::Value::as_str);
        Some(if spacing == Some("log") { Scale::Log } else { Scale::Linear })
    };
    Some(written().unwrap_or_else(|| Scale::of(values.into_iter())))
}
