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

fn four_decimals<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&value.map(|value| format!("{value:.4}")).unwrap_or_default())
}

/// Lines as they stand in `accuracy.csv`.
pub fn csv(lines: &[Line]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    lines.iter().for_each(|line| writer.serialize(line).expect("memory takes it"));
    String::from_utf8(writer.into_inner().expect("memory takes it")).expect("all of it is text")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_table_is_written_as_it_was_read() {
        let table = include_str!("../../data/accuracy.csv");
        let lines = csv::Reader::from_reader(table.as_bytes()).into_deserialize();
        assert_eq!(csv(&lines.collect::<Result<Vec<_>, _>>().unwrap()), table);
    }
}
