//! `energy.csv`: the energy budget of every case that went well, joules per metre of width.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::disk::Writer;
use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, number};
use crate::quantities::{energy, summary};

/// Bytes that go to the file in one go.
const BUFFER: usize = 1 << 20;

/// Writes the budgets of the finished cases, in grid order.
pub(super) fn write(directory: &Path, records: &[Option<CaseRecord>]) -> Result<(), SweepError> {
    // The gap keeps its place behind the terms of the first version.
    let (first, later) = energy::ALL.split_at(energy::FIRST_VERSION);
    let [first_names, later_names] = [first, later].map(|terms| terms.iter().map(|term| term.name));
    let names = [summary::CASE_ID.name].into_iter().chain(first_names);
    let names = names.chain([summary::ENERGY_GAP.name]).chain(later_names);
    let path = directory.join("energy.csv");
    let header = names.collect::<Vec<_>>().join(",") + "\n";
    atomic_file::write_with(&path, |file| {
        let mut file = BufWriter::with_capacity(BUFFER, Writer(file));
        let mut text = header;
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
            file.write_all(text.as_bytes()).map_err(SweepError::io(&path))?;
            text.clear();
        }
        file.write_all(text.as_bytes()).map_err(SweepError::io(&path))?;
        file.flush().map_err(SweepError::io(&path))
    })
}
