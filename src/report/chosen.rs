//! The numerics that `--max-error` chose case by case.

use std::collections::HashMap;
use std::path::Path;

use super::column::Cells;
use super::row::Row;
use crate::quantities::max_error::Line;

/// In place of numerics that are not known.
const UNKNOWN: &str = "?";

/// The numerics of each row in `max_error.csv`; `None` where there is no such file.
pub(super) fn chosen(path: &Path, rows: &[Row]) -> Option<Cells> {
    let lines = csv::Reader::from_path(path).ok()?.into_deserialize::<Line>();
    let cases: HashMap<_, _> =
        lines.map_while(Result::ok).map(|line| (line.case_id, line.numerics)).collect();
    Some(rows.iter().map(|row| cases.get(row.id()).map_or(UNKNOWN, String::as_str)).collect())
}
