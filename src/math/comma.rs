//! Comma-separated text.

use serde::Serialize;

/// A table of these lines as text, under the names of their fields.
///
/// # Panics
/// Where a line is no struct of plain values.
pub fn csv_of(lines: &[impl Serialize]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    lines.iter().for_each(|line| writer.serialize(line).expect("lines have plain fields"));
    text(writer)
}

/// A table of words and numbers as text. A cell with a comma is quoted.
///
/// # Panics
/// Where a row is not as wide as the first.
pub fn csv<Row: IntoIterator<Item: AsRef<[u8]>>>(rows: impl IntoIterator<Item = Row>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row).expect("rows are as wide as their header");
    }
    text(writer)
}

fn text(writer: csv::Writer<Vec<u8>>) -> String {
    let bytes = writer.into_inner().expect("memory takes it all");
    String::from_utf8(bytes).expect("cells are text")
}
