//! Rows of summaries and references, and which of them are the same case.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context, Result};

/// What tells which case of a reference a row is.
pub const KEYS: [&str; 3] =
    ["wave_height_ratio", "spring_stiffness_n_per_m", "seawall_mass_kg_per_m"];

/// Cells by the names of their columns.
pub type Row = HashMap<String, String>;

/// A cell that holds a number.
pub fn number(row: &Row, column: &str) -> Option<f64> {
    row.get(column)?.parse().ok()
}

/// Whether two rows are of the same case.
pub fn same_case(a: &Row, b: &Row) -> bool {
    KEYS.iter().all(|key| number(a, key) == number(b, key))
}

/// The rows of a table whose comments start with `#`.
pub fn read(path: &Path) -> Result<Vec<Row>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let rows = reader.deserialize().collect::<Result<Vec<Row>, _>>();
    rows.with_context(|| format!("cannot read {}", path.display()))
}
