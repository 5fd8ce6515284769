//! What finished runs say about their cases, by name, and how tables of it are written.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

/// Cells by the names of their columns.
pub type Row = HashMap<String, String>;

/// Rows of cells, the first being the header.
pub type Table = Vec<Vec<String>>;

/// The rows of a file, by name.
pub fn read(path: &Path) -> Result<Vec<Row>> {
    let told = || format!("cannot read {}", path.display());
    let mut reader = csv::Reader::from_path(path).with_context(told)?;
    reader.deserialize().collect::<Result<Vec<Row>, _>>().with_context(told)
}

/// All cases of a run or sweep, each with its readings, what `--set` changed, and its `scene`, which is
/// the file's name.
pub fn gather(directory: &Path) -> Result<Vec<Row>> {
    let told = || format!("cannot read the manifest of {}", directory.display());
    let manifest = fs::read_to_string(directory.join("manifest.json")).with_context(told)?;
    let manifest: serde_json::Value = serde_json::from_str(&manifest).with_context(told)?;
    let mut common =
        vec![("scene".to_owned(), manifest["name"].as_str().unwrap_or_default().to_owned())];
    for set in manifest["overrides"].as_array().into_iter().flatten().filter_map(|set| set.as_str())
    {
        let (path, value) = set.split_once('=').unwrap_or((set, ""));
        let key = path.rsplit('.').next().unwrap_or(path);
        common.push((key.to_owned(), value.to_owned()));
    }
    let mut rows = read(&directory.join("summary.csv"))?;
    for row in &mut rows {
        let readings = directory.join("readings").join(format!("{}.csv", row["case_id"]));
        if readings.exists() {
            for reading in read(&readings)? {
                row.insert(reading["name"].clone(), reading["value"].clone());
            }
        }
        for (key, value) in &common {
            // What stands in the summary already counts.
            row.entry(key.clone()).or_insert_with(|| value.clone());
        }
    }
    Ok(rows)
}

/// Four significant digits of a number, anything else as it stands.
pub fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value) if value != 0.0 && value.abs() < 1e-3 => format!("{value:.2e}"),
        Ok(value) if value.fract() != 0.0 => {
            let digits = 3 - value.abs().log10().floor().clamp(-3.0, 3.0) as i32;
            format!("{value:.*}", digits.max(0) as usize)
        }
        _ => text.to_owned(),
    }
}

/// A table in Markdown.
pub fn markdown(table: &Table) -> String {
    let mut text = String::new();
    for (number, row) in table.iter().enumerate() {
        text += &format!("| {} |\n", row.join(" | "));
        if number == 0 {
            text += &format!("|{}\n", "---|".repeat(row.len()));
        }
    }
    text
}

/// Writes a table as CSV.
pub fn write(path: &Path, table: &Table) -> Result<()> {
    let mut writer = csv::Writer::from_path(path)?;
    table.iter().try_for_each(|row| writer.write_record(row))?;
    Ok(writer.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shortened() {
        let told = ["1.23456", "-0.00123456", "1234.567", "12", "1.234e-9", "sfdi", ""].map(short);
        assert_eq!(told, ["1.235", "-0.001235", "1235", "12", "1.23e-9", "sfdi", ""]);
    }
}
