//! `summary.csv`: one row per finished case, in grid order, made from the journal.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, number, rows};
use crate::disk::Writer;
use crate::disk::names::SUMMARY;
use crate::quantities::{self, Bars, Value, summary};
use crate::scene::CaseConfig;
use crate::study::{Case, Study};

impl CaseRecord {
    /// The data from which reported quantities are read.
    pub fn reported<'a>(&'a self, config: &'a CaseConfig, bars: Bars) -> quantities::Case<'a> {
        quantities::Case {
            id: self.id.to_string(),
            config,
            outcome: self.outcome.as_ref(),
            reason: &self.reason,
            bars,
            wall_time_s: self.wall_time_s,
        }
    }
}

/// Bytes written to the file at once.
const BUFFER: usize = 1 << 20;

/// Writes the summary of the finished cases; `records` holds the companions, too.
pub(super) fn write(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<(), SweepError> {
    let path = directory.join(SUMMARY);
    atomic_file::write_with(&path, |file| {
        let wrong = |error: csv::Error| SweepError::io(&path)(error.into());
        write_table(Writer(file), study, records).map_err(wrong)
    })
}

/// The row of a case, with the names of the columns, from another record than that among `records`.
pub(super) fn row(
    study: &Study,
    records: &[Option<CaseRecord>],
    case: &Case,
    record: &CaseRecord,
) -> csv::Result<Vec<u8>> {
    let (mut bytes, row) = (Vec::new(), (case, record));
    write_rows(&mut bytes, study, records, std::iter::once(row))?;
    Ok(bytes)
}

/// Writes the whole table.
pub(super) fn write_table(
    into: impl Write,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> csv::Result<()> {
    let rows = study.cases.iter().zip(records);
    let rows = rows.filter_map(|(case, record)| Some((case, record.as_ref()?)));
    write_rows(into, study, records, rows)
}

/// Writes row by row: the table of a large study is never in memory as a whole.
fn write_rows<'a>(
    into: impl Write,
    study: &Study,
    records: &[Option<CaseRecord>],
    rows: impl Iterator<Item = (&'a Case, &'a CaseRecord)>,
) -> csv::Result<()> {
    let fixed: Vec<String> = summary::names().collect();
    let places = 0..study.keys.len();
    let further: Vec<_> = places.filter(|&at| !fixed.contains(&study.keys[at])).collect();
    let names = fixed.iter().chain(further.iter().map(|&at| &study.keys[at]));
    let mut into = BufWriter::with_capacity(BUFFER, into);
    let mut header = csv::Writer::from_writer(&mut into);
    header.write_record(names)?;
    header.flush()?;
    drop(header);
    let text = |rows: &[(&Case, &CaseRecord)]| {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut written =
            rows.iter().map(|row| write_row(&mut writer, study, records, *row, &further));
        written.try_for_each(|row| row).expect("text takes it all");
        writer.into_inner().expect("text takes it all")
    };
    rows::write(&mut into, rows, text)?;
    Ok(into.flush()?)
}

fn write_row(
    writer: &mut csv::Writer<Vec<u8>>,
    study: &Study,
    records: &[Option<CaseRecord>],
    (case, record): (&Case, &CaseRecord),
    further: &[usize],
) -> csv::Result<()> {
    let reported = record.reported(&case.config, study.error_bars_of(record, records));
    let mut text = String::new();
    for column in summary::ALL {
        text.clear();
        if let Some(value) = column.value(&reported) {
            push(&mut text, value);
        }
        writer.write_field(&text)?;
        if column.has_time() {
            text.clear();
            if let Some(time) = column.time(&reported) {
                number::push(&mut text, time);
            }
            writer.write_field(&text)?;
        }
    }
    for &place in further {
        writer.write_field(swept(case, place))?;
    }
    writer.write_record(None::<&[u8]>)
}

fn push(cell: &mut String, value: Value) {
    match value {
        Value::Number(value) => number::push(cell, value),
        Value::Count(count) => cell.push_str(&count.to_string()),
        Value::Flag(flag) => cell.push_str(if flag { "true" } else { "false" }),
        Value::Text(text) => cell.push_str(&text),
    }
}

fn swept(case: &Case, place: usize) -> String {
    match case.assignments[place].as_deref() {
        None => String::new(),
        Some(toml::Value::String(text)) => text.clone(),
        Some(toml::Value::Float(value)) => number::text(*value),
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial;
    use super::*;
    use crate::simulation::{Failure, FailureKind};

    #[test]
    fn rows_are_in_grid_order_and_leave_out_what_is_not_there() {
        let text = "name = \"a\"\n[scene]\nseawall_mass_kg_per_m = 50\n[grid]\n\
            wall = [\"fixed\", \"movable\"]\nspring_stiffness_n_per_m = [0, 10]";
        let study = trial::of_file(text);
        let good = |case: usize| Some(trial::record(&study, &study.cases[case]));
        let detail = "first line\nsecond line".to_owned();
        let failure = Failure { kind: FailureKind::RunawaySpeed, time_s: 0.5, detail };
        let failed = CaseRecord::new(&study, &study.cases[1], &Err(failure), 1.0, "here");
        let records = [good(0), Some(failed), good(2)];
        let mut bytes = Vec::new();
        write_table(&mut bytes, &study, &records).unwrap();
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        let headers = reader.headers().unwrap().clone();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        let cell = |row: usize, name: &str| {
            rows[row][headers.iter().position(|header| header == name).unwrap()].to_owned()
        };
        assert_eq!(headers.iter().next_back(), Some("wall"));
        assert_eq!(
            ["spring_stiffness_n_per_m", "m_star", "displacement_max", "wall"]
                .map(|name| cell(0, name)),
            ["", "", "", "fixed"]
        );
        assert_eq!(
            ["status", "log10_k_star", "m_star", "force_max"].map(|name| cell(1, name)),
            ["failed", "", "1.25", ""]
        );
        assert_eq!(cell(1, "reason"), "runaway-speed at t = 0.5000 s: first line second line");
        assert_eq!(cell(2, "status"), "ok");
        let k_star: f64 = cell(2, "log10_k_star").parse().unwrap();
        assert!((10_f64.powf(k_star) - 10.0 / 392.4).abs() < 1e-12);
    }
}
