//! Per-case files: histories, probes, readings, envelopes and waves.

use std::fs;
use std::path::{Path, PathBuf};

use super::atomic_file;
use super::case_tables::{envelope_table, history, probe_table, reading_table, wave_table};
use super::error::SweepError;
use super::making::Making;
use super::seal::{Seal, Seals};
use crate::disk;
use crate::disk::names::{CASE_FOLDERS, ENVELOPES, HISTORIES, PROBES, READINGS, WAVES, of_case};
use crate::simulation::CaseResult;
use crate::study::CaseId;

/// The files of a case besides its journal line: their folders and texts.
pub(super) fn texts(result: &CaseResult) -> Vec<(&'static str, String)> {
    let mut texts = vec![(HISTORIES, history(&result.history))];
    if let Some(probes) = &result.probes {
        texts.push((PROBES, probe_table(probes)));
    }
    if !result.readings.is_empty() {
        texts.push((READINGS, reading_table(&result.readings)));
    }
    if !result.envelope.is_empty() {
        texts.push((ENVELOPES, envelope_table(&result.envelope)));
    }
    if !result.waves.is_empty() {
        texts.push((WAVES, wave_table(&result.waves)));
    }
    texts
}

/// Writes the files of a case; with `durable` onto the disk itself.
pub(super) fn write(
    directory: &Path,
    id: CaseId,
    result: &CaseResult,
    durable: bool,
) -> Result<Seals, SweepError> {
    let put = if durable { atomic_file::write } else { atomic_file::write_unsynced };
    let mut seals = Seals::new();
    for (name, text) in texts(result) {
        let path = of_case(directory, name, id);
        // The folder nearly always exists, so it is only made after a failure.
        if let Err(error) = put(&path, text.as_bytes()) {
            let folder = directory.join(name);
            if folder.is_dir() {
                return Err(error);
            }
            disk::create_folder_in(&folder).map_err(SweepError::io(&folder))?;
            put(&path, text.as_bytes())?;
        }
        seals.insert(name.to_owned(), Seal::of(text.as_bytes()));
    }
    Ok(seals)
}

/// The files of a case that have changed since they were written: their paths, and the faults.
pub(super) fn damage(directory: &Path, id: CaseId, seals: &Seals) -> Vec<(PathBuf, &'static str)> {
    let look = |(name, seal): (&String, &Seal)| {
        let path = of_case(directory, name, id);
        seal.damage(&path).map(|what| (path, what))
    };
    let mut damage: Vec<_> = seals.iter().filter_map(look).collect();
    let history = history_path(directory, id);
    if !seals.contains_key(HISTORIES) && !history.is_file() {
        damage.push((history, "is missing"));
    }
    damage
}

/// Whether a case has left probes.
pub(super) fn has_probes(seals: &Seals) -> bool {
    seals.contains_key(PROBES)
}

/// Whether there is any history.
pub(super) fn any(directory: &Path) -> bool {
    fs::read_dir(directory.join(HISTORIES)).is_ok_and(|mut entries| entries.next().is_some())
}

/// Removes half-written files of a killed process.
pub(super) fn clean(directory: &Path) -> Result<(), SweepError> {
    // Those beside the journal may be of a report that is at work.
    let alone = (!Making::is_held(directory)).then(|| Making::hold(directory, || {}));
    let own = alone.iter().map(|_| directory.to_owned());
    let folders = CASE_FOLDERS.iter().map(|name| directory.join(name));
    atomic_file::clean(&own.chain(folders).collect::<Vec<_>>())
}

/// The path of a case's history.
pub(super) fn history_path(directory: &Path, id: impl std::fmt::Display) -> PathBuf {
    of_case(directory, HISTORIES, id)
}

/// The name in sentences of a file in a folder.
pub(super) fn name(folder: &str) -> &str {
    match folder {
        HISTORIES => "history",
        other => other.strip_suffix('s').unwrap_or(other),
    }
}
