//! `energy.csv`: the energy budget of every successful case, joules per metre of width.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, number, rows};
use crate::disk::Writer;
use crate::disk::names::ENERGY;
use crate::quantities::{energy, summary};
use crate::simulation::{EnergyBudget, Outcome};
use crate::study::CaseId;

/// Bytes written to the file at once.
const BUFFER: usize = 1 << 20;

/// Writes the budgets of the finished cases, in grid order.
pub(super) fn write(directory: &Path, records: &[Option<CaseRecord>]) -> Result<(), SweepError> {
    let path = directory.join(ENERGY);
    atomic_file::write_with(&path, |file| {
        write_table(Writer(file), records).map_err(SweepError::io(&path))
    })
}

/// Writes the whole table.
pub(super) fn write_table(into: impl Write, records: &[Option<CaseRecord>]) -> std::io::Result<()> {
    // The gap keeps its place after the terms of the first version.
    let (first, later) = energy::ALL.split_at(energy::FIRST_VERSION);
    let [first_names, later_names] = [first, later].map(|terms| terms.iter().map(|term| term.name));
    let names = [summary::CASE_ID.name].into_iter().chain(first_names);
    let names = names.chain([summary::ENERGY_GAP.name]).chain(later_names);
    let text = |rows: &[(CaseId, &EnergyBudget, &Outcome)]| {
        let mut text = String::new();
        for &(id, budget, outcome) in rows {
            text.push_str(&id.to_string());
            let [first, later] =
                [first, later].map(|terms| terms.iter().map(|term| (term.read)(budget)));
            for value in first.chain([outcome.energy_gap_percent]).chain(later) {
                text.push(',');
                number::push(&mut text, value);
            }
            text.push('\n');
        }
        text.into_bytes()
    };
    let mut file = BufWriter::with_capacity(BUFFER, into);
    file.write_all((names.collect::<Vec<_>>().join(",") + "\n").as_bytes())?;
    rows::write(&mut file, records.iter().flatten().filter_map(budget), text)?;
    file.flush()
}

/// The data of a row; none for a failed case.
fn budget(record: &CaseRecord) -> Option<(CaseId, &EnergyBudget, &Outcome)> {
    Some((record.id, record.energy.as_ref()?, record.outcome.as_ref()?))
}
