//! The columns of `accuracy.csv`: speed against error.

use serde::{Deserialize, Serialize, Serializer};

/// A line of `accuracy.csv`: a method on a case, or the sums of a method.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Line {
    /// The case, or `all` or `loads` where the line holds sums.
    pub case: String,
    /// The method.
    pub method: String,
    /// Percent of the truth.
    #[serde(serialize_with = "four_decimals")]
    pub force_error_percent: Option<f64>,
    /// Percent of the still water depth.
    #[serde(serialize_with = "four_decimals")]
    pub runup_error_percent: Option<f64>,
    /// Percent of the truth.
    #[serde(serialize_with = "four_decimals")]
    pub displacement_error_percent: Option<f64>,
    /// Percent of the truth.
    #[serde(serialize_with = "four_decimals")]
    pub flow_error_percent: Option<f64>,
    /// The root mean square of those that there are.
    #[serde(serialize_with = "four_decimals")]
    pub error_percent: Option<f64>,
    /// Processor seconds.
    #[serde(serialize_with = "four_decimals")]
    pub cpu_time_s: Option<f64>,
    /// Of sums: `yes` if no method is both cheaper and more accurate, else `no`.
    pub pareto: String,
    /// Why there are no errors.
    pub reason: String,
}

/// The errors that count for a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Errors {
    /// All of them.
    All,
    /// Those of force and displacement, in the cases that have any.
    Loads,
}

impl Errors {
    /// Both groups.
    pub const EACH: [Errors; 2] = [Errors::All, Errors::Loads];

    /// The name in the column of cases for the sums of the group.
    pub fn name(self) -> &'static str {
        match self {
            Errors::All => "all",
            Errors::Loads => "loads",
        }
    }

    /// What it holds, in words.
    pub fn words(self) -> &'static str {
        match self {
            Errors::All => "all quantities",
            Errors::Loads => "force and displacement",
        }
    }
}

/// Errors, percent, for each of which the cheapest method is told.
pub const TARGETS: [f64; 3] = [1.0, 3.0, 10.0];

/// The cheapest method on a case, or of a group's sums, whose error is within `percent`.
pub fn cheapest_within<'a>(lines: &'a [Line], case: &str, percent: f64) -> Option<&'a Line> {
    let is_within = |line: &&Line| line.error_percent.is_some_and(|error| error <= percent);
    let good = lines.iter().filter(|line| line.case == case).filter(is_within);
    let time = |line: &Line| line.cpu_time_s.unwrap_or(f64::INFINITY);
    good.min_by(|a, b| time(a).total_cmp(&time(b)))
}

fn four_decimals<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&value.map(|value| format!("{value:.4}")).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::comma::csv_of;

    #[test]
    fn the_cheapest_method_is_that_of_the_case() {
        let line = |case: &str, method: &str, error, time| Line {
            case: case.to_owned(),
            method: method.to_owned(),
            error_percent: error,
            cpu_time_s: Some(time),
            ..Line::default()
        };
        let lines = [
            line("all", "fast", Some(2.0), 1.0),
            line("all", "slow", Some(0.5), 9.0),
            line("all", "sick", None, 0.1),
            line("still", "slow", Some(0.5), 0.2),
        ];
        let best =
            |percent| cheapest_within(&lines, "all", percent).map(|line| line.method.as_str());
        assert_eq!([best(10.0), best(1.0), best(0.1)], [Some("fast"), Some("slow"), None]);
    }

    #[test]
    fn the_stored_table_is_written_as_it_was_read() {
        let table = include_str!("../../data/accuracy.csv");
        let lines = csv::Reader::from_reader(table.as_bytes()).into_deserialize::<Line>();
        assert_eq!(csv_of(&lines.collect::<Result<Vec<_>, _>>().unwrap()), table);
    }
}
