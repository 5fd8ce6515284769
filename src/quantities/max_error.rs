//! The columns of `max_error.csv`: the numerics that `--max-error` chose, and whether error bars met
//! the aim.

use serde::{Deserialize, Serialize, Serializer};

/// A line of `max_error.csv`: a finished case.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Line {
    /// The case.
    pub case_id: String,
    /// Its spacing, m.
    #[serde(serialize_with = "plain")]
    pub particle_spacing_m: f64,
    /// Its numerics that are not as by default: `particle_spacing_m = 0.02, boundary = sfdi`.
    pub numerics: String,
    /// The larger of the bars of force and displacement, percent of their values.
    #[serde(serialize_with = "plain_or_empty")]
    pub error_bar_percent: Option<f64>,
    /// The aim, percent.
    #[serde(serialize_with = "plain")]
    pub max_error_percent: f64,
    /// Whether the bar is within it.
    pub met: bool,
}

fn plain<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}

fn plain_or_empty<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&value.map(|value| value.to_string()).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::comma::csv_of;

    #[test]
    fn a_line_is_read_as_it_was_written() {
        let line = Line {
            case_id: "ab".to_owned(),
            particle_spacing_m: 0.02,
            numerics: "particle_spacing_m = 0.02, boundary = sfdi".to_owned(),
            error_bar_percent: None,
            max_error_percent: 2.0,
            met: true,
        };
        let text = csv_of(std::slice::from_ref(&line));
        let header = "case_id,particle_spacing_m,numerics,error_bar_percent,max_error_percent,met";
        let cells = "ab,0.02,\"particle_spacing_m = 0.02, boundary = sfdi\",,2,true";
        assert_eq!(text, format!("{header}\n{cells}\n"));
        let mut read = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
        assert_eq!(read.next().unwrap().ok(), Some(line));
    }
}
