//! Per-case files: histories and probes.

use std::fs;
use std::path::Path;

use super::atomic_file;
use super::case::CaseId;
use super::error::SweepError;
use super::number;
use crate::simulation::{CaseResult, HistoryRow, ProbeTable};

const HISTORIES: &str = "histories";
const PROBES: &str = "probes";

/// Writes what a case leaves besides its journal line.
pub(super) fn write(directory: &Path, id: CaseId, result: &CaseResult) -> Result<(), SweepError> {
    write_one(&directory.join(HISTORIES), id, &history(&result.history))?;
    if let Some(probes) = &result.probes {
        write_one(&directory.join(PROBES), id, &probe_table(probes))?;
    }
    Ok(())
}

/// Whether a case that the journal calls well has its history.
pub(super) fn is_there(directory: &Path, id: CaseId) -> bool {
    directory.join(HISTORIES).join(format!("{id}.csv")).is_file()
}

/// Makes the files of all cases durable.
pub(super) fn sync(directory: &Path) -> Result<(), SweepError> {
    for folder in [HISTORIES, PROBES] {
        let path = directory.join(folder);
        if path.is_dir() {
            atomic_file::sync_directory(&path)?;
        }
    }
    Ok(())
}

/// Removes what a killed process left half written.
pub(super) fn clean(directory: &Path) -> Result<(), SweepError> {
    for path in [directory.to_owned(), directory.join(HISTORIES), directory.join(PROBES)] {
        let Ok(entries) = fs::read_dir(&path) else { continue };
        for entry in entries.flatten() {
            if entry.file_name().to_string_lossy().ends_with(atomic_file::TEMPORARY) {
                fs::remove_file(entry.path()).map_err(SweepError::io(&entry.path()))?;
            }
        }
    }
    Ok(())
}

fn write_one(folder: &Path, id: CaseId, text: &str) -> Result<(), SweepError> {
    fs::create_dir_all(folder).map_err(SweepError::io(folder))?;
    atomic_file::write(&folder.join(format!("{id}.csv")), text.as_bytes())
}

fn history(rows: &[HistoryRow]) -> String {
    let mut text = "time_s,force,runup,displacement,wall_velocity_m_per_s\n".to_owned();
    for row in rows {
        let values =
            [row.time_s, row.force, row.runup, row.displacement, row.wall_velocity_m_per_s];
        push_row(&mut text, values);
    }
    text
}

fn probe_table(probes: &ProbeTable) -> String {
    let mut text = "time_s".to_owned();
    for name in &probes.names {
        text.push(',');
        text.push_str(name);
    }
    text.push('\n');
    for (time, row) in probes.time_s.iter().zip(&probes.rows) {
        push_row(&mut text, std::iter::once(*time).chain(row.iter().copied()));
    }
    text
}

fn push_row(text: &mut String, values: impl IntoIterator<Item = f64>) {
    for (column, value) in values.into_iter().enumerate() {
        if column > 0 {
            text.push(',');
        }
        text.push_str(&number::text(value));
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probes_have_a_column_each() {
        let probes = ProbeTable {
            names: vec!["p1".into(), "level".into()],
            time_s: vec![0.0, 0.005],
            rows: vec![vec![1.5, 0.1], vec![2.0, 0.30000000000000004]],
        };
        let text = probe_table(&probes);
        assert_eq!(text, "time_s,p1,level\n0,1.5,0.1\n0.005,2,0.30000000000000004\n");
    }
}
