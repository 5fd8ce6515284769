//! Results of a case besides its summary: values of gauges over time, and single readings.

use serde::{Deserialize, Serialize};

/// Values of gauges over time: `probes/<case_id>.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeTable {
    /// Columns without `time_s`.
    pub columns: Vec<ProbeColumn>,
    /// Times, seconds.
    pub time_s: Vec<f64>,
    /// One row of values per time, in the order of `columns`, row after row.
    pub values: Vec<f64>,
}

impl ProbeTable {
    /// The rows, each with its time.
    pub fn rows(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.time_s.iter().copied().zip(self.values.chunks(self.columns.len().max(1)))
    }
}

/// One gauge's column.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeColumn {
    /// Its name.
    pub name: String,
    /// Unit of its values.
    pub unit: String,
    /// How and where it measures.
    pub method: String,
}

/// A number of a finished case that has no column in the summary: `readings/<case_id>.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NamedReading {
    /// What it is.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its unit.
    pub unit: String,
}

impl NamedReading {
    /// A reading.
    pub fn new(name: &str, value: f64, unit: &str) -> NamedReading {
        NamedReading { name: name.to_owned(), value, unit: unit.to_owned() }
    }
}

/// Readings in their order in the file.
#[derive(Debug, Default)]
pub(super) struct Readings(pub(super) Vec<NamedReading>);

impl Readings {
    /// Adds a reading if there is a value.
    pub(super) fn tell(&mut self, name: &str, value: impl Into<Option<f64>>, unit: &str) {
        self.0.extend(value.into().map(|value| NamedReading::new(name, value, unit)));
    }
}
