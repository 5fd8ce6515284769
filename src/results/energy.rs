//! `energy.csv`: the energy budget of every case that went well, joules per metre of width.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::disk::Writer;
use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, number};
use crate::quantities::{energy, summary};

pub(super) const FILE_NAME: &str = "energy.csv";
/// Bytes that go to the file in one go.
const BUFFER: usize = 1 << 20;

/// Writes the budgets of the finished cases, in grid order.
pub(super) fn write(directory: &Path, records: &[Option<CaseRecord>]) -> Result<(), SweepError> {
    let path = directory.join(FILE_NAME);
    atomic_file::write_with(&path, |file| {
        write_table(Writer(file), records).map_err(SweepError::io(&path))
    })
}

/// Writes the whole table.
pub(super) fn write_table(into: impl Write, records: &[Option<CaseRecord>]) -> std::io::Result<()> {
    // The gap keeps its place behind the terms of the first version.
    let (first, later) = energy::ALL.split_at(energy::FIRST_VERSION);
    let [first_names, later_names] = [first, later].map(|terms| terms.iter().map(|term| term.name));
    let names = [summary::CASE_ID.name].into_iter().chain(first_names);
    let names = names.chain([summary::ENERGY_GAP.name]).chain(later_names);
    let mut file = BufWriter::with_capacity(BUFFER, into);
    let mut text = names.collect::<Vec<_>>().join(",") + "\n";
    for record in records.iter().flatten() {
        let (Some(budget), Some(outcome)) = (&record.energy, &record.outcome) else { continue };
        text.push_str(&record.id.to_string());
        let [first, later] =
            [first, later].map(|terms| terms.iter().map(|term| (term.read)(budget)));
        for value in first.chain([outcome.energy_gap_percent]).chain(later) {
            text.push(',');
            number::push(&mut text, value);
        }
        text.push('\n');
        file.write_all(text.as_bytes())?;
        text.clear();
    }
    file.write_all(text.as_bytes())?;
    file.flush()
}
