//! The file of a recorded stroke.

use std::io::Cursor;
use std::path::Path;

use crate::keys::bytes_of;

/// A point, and the number of its line.
pub(super) type Row = ([f64; 2], u64);

/// The lines of a file with the columns `time_s` and `stroke_m`.
pub(super) fn rows(
    path: &str,
) -> Result<impl Iterator<Item = Result<Row, String>> + use<>, String> {
    let missing =
        |error| format!("cannot be read: {error}; a path counts from where the program is started");
    let bytes = bytes_of(Path::new(path)).map_err(missing)?;
    let mut reader = csv::Reader::from_reader(Cursor::new(bytes));
    let columns = reader.headers().map_err(|error| in_words(&error))?;
    if columns.iter().map(str::trim).ne(["time_s", "stroke_m"]) {
        let has = columns.iter().collect::<Vec<_>>().join(",");
        let allowed = "must be a CSV file with the columns time_s and stroke_m";
        return Err(format!("{allowed}, in this order and alone; its first line is {has:?}"));
    }
    Ok(reader.into_records().map(|row| {
        let row = row.map_err(|error| in_words(&error))?;
        let line = row.position().map_or(0, csv::Position::line);
        let cell = |place: usize| {
            let text = row.get(place).unwrap_or_default().trim();
            text.parse::<f64>().map_err(|_| format!("line {line}: {text:?} is no number"))
        };
        Ok(([cell(0)?, cell(1)?], line))
    }))
}

/// What is wrong with a line, in words.
fn in_words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos: Some(position), len, .. } => {
            format!("line {}: must have two columns, not {len}", position.line())
        }
        csv::ErrorKind::Utf8 { pos: Some(position), .. } => {
            format!("line {}: is not UTF-8 text", position.line())
        }
        _ => error.to_string(),
    }
}
