//! Checksums of the files that are made last: `derived.json`.
//!
//! Journal, manifest and the files of cases have sums of their own, and `summary.csv` and
//! `energy.csv` are compared with the journal. This file is for the rest: page, figures, tables,
//! films, files for ParaView. Before they are made again, their seals are removed, and it is noted
//! that they are not finished. So a process that dies meanwhile leaves no false seals, and it shows.
//! Whoever calls a function here that writes holds [`Making`].

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind::NotFound;
use std::mem;
use std::ops::Not;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::making::Making;
use super::seal::Seal;
use super::{atomic_file, sealed};
use crate::disk;
use crate::disk::names::{ALL_HISTORIES, FIGURES, FILMS, MAX_ERROR, PAGE, TABLES, VTK};

const FILE_NAME: &str = "derived.json";
const FILES: [&str; 3] = [ALL_HISTORIES, MAX_ERROR, PAGE];
const FOLDERS: [&str; 4] = [FIGURES, TABLES, FILMS, VTK];
/// Those of a report.
const REPORTED: [&str; 2] = [FIGURES, TABLES];
/// Files that only a running case makes: starts of paths.
const MADE_BY_RUNS: &[&str] = &["films/", "vtk/"];
/// Files that a report alone does not make again.
pub const MADE_BY_SWEEPS: &[&str] = &["films/", "vtk/", MAX_ERROR];

/// The seals of a directory's derived files, by their paths in it.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Derived {
    files: BTreeMap<String, Seal>,
    /// The figures and tables of the last report. Only these are removed.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    reported: BTreeSet<String>,
    /// Whether a sweep has begun to run cases, but has not yet made the files that come after them.
    #[serde(default, skip_serializing_if = "Not::not")]
    owed: bool,
    /// Whether a report or sweep has begun to make page, figures and tables, and has not ended.
    #[serde(default, skip_serializing_if = "Not::not")]
    begun: bool,
}

impl Derived {
    /// The seals of a directory; none if the file is missing or damaged.
    fn read(directory: &Path) -> Derived {
        sealed::read(&directory.join(FILE_NAME)).unwrap_or_default()
    }

    fn write(&self, directory: &Path) -> Result<(), SweepError> {
        sealed::write(&directory.join(FILE_NAME), self)
    }

    /// A report is about to make all files again, except those that are kept with their seals. They
    /// are not finished until [`end`](Derived::end).
    pub fn begin(directory: &Path, kept: &[&str]) -> Result<(), SweepError> {
        Derived { begun: true, ..Derived::begun(directory, kept) }.write(directory)?;
        // What a killed process has left half-written.
        atomic_file::clean(&REPORTED.map(|folder| directory.join(folder)))
    }

    fn begun(directory: &Path, kept: &[&str]) -> Derived {
        let mut derived = Derived::read(directory);
        derived.files.retain(|name, _| kept.iter().any(|start| name.starts_with(start)));
        derived
    }

    /// The same for a sweep that has run its cases. It must still make all these files, until
    /// [`end`](Derived::end).
    pub fn owe(directory: &Path) -> Result<(), SweepError> {
        Derived { owed: true, begun: true, ..Derived::begun(directory, MADE_BY_RUNS) }
            .write(directory)?;
        atomic_file::clean(&REPORTED.map(|folder| directory.join(folder)))
    }

    /// The same for a sweep that is about to run cases. What is there stays whole until then.
    pub fn expect(directory: &Path) -> Result<(), SweepError> {
        Derived { owed: true, ..Derived::read(directory) }.write(directory)
    }

    /// Whether a sweep ended before it had made the files that come after its cases.
    pub fn is_owed(directory: &Path) -> bool {
        Derived::read(directory).owed
    }

    /// Whether a report ended before it had made all of its files. One that is still at work does
    /// not count.
    pub fn is_cut(directory: &Path) -> bool {
        Derived::read(directory).ended_early(directory)
    }

    fn ended_early(&self, directory: &Path) -> bool {
        self.begun && !Making::is_held(directory)
    }

    /// All files are made, with these figures and tables; `all` is whether a sweep has nothing left
    /// to make. Files with a seal keep it. Figures and tables of the last report that are not in
    /// this one are removed.
    pub fn end(directory: &Path, reported: &[String], all: bool) -> Result<(), SweepError> {
        let mut derived = Derived::read(directory);
        derived.owed &= !all;
        derived.begun = false;
        let before = mem::replace(&mut derived.reported, reported.iter().cloned().collect());
        for name in names(directory) {
            let path = directory.join(&name);
            if before.contains(&name) && !derived.reported.contains(&name) {
                disk::remove_file(&path).map_err(SweepError::io(&path))?;
            } else if let Entry::Vacant(place) = derived.files.entry(name) {
                place.insert(Seal::of_file(&path).map_err(SweepError::io(&path))?);
            }
        }
        derived.write(directory)
    }

    /// These files were made or removed. If something is in the way of a file, it keeps its seal,
    /// so that the fault shows.
    pub fn renew(directory: &Path, paths: &[PathBuf]) -> Result<(), SweepError> {
        let mut derived = Derived::read(directory);
        for path in paths {
            let Ok(name) = path.strip_prefix(directory) else { continue };
            let name = name.to_string_lossy().into_owned();
            if path.is_file() {
                let seal = Seal::of_file(path).map_err(SweepError::io(path))?;
                derived.files.insert(name, seal);
            } else if path.symlink_metadata().is_err_and(|error| error.kind() == NotFound) {
                derived.files.remove(&name);
            }
        }
        if derived.files.is_empty() && !directory.join(FILE_NAME).exists() {
            return Ok(());
        }
        derived.write(directory)
    }

    /// The same of all files in a folder of the directory.
    pub fn renew_folder(directory: &Path, folder: &str) -> Result<(), SweepError> {
        let known = Derived::read(directory).files.into_keys();
        let known = known.filter(|name| Path::new(name).starts_with(folder));
        let all: Vec<_> = known.chain(inside(directory, folder)).collect();
        Derived::renew(directory, &all.iter().map(|name| directory.join(name)).collect::<Vec<_>>())
    }

    /// Whether any of these files has changed since it was made.
    pub fn is_damaged(directory: &Path, paths: &[PathBuf]) -> bool {
        let derived = Derived::read(directory);
        paths.iter().any(|path| {
            let name = path.strip_prefix(directory).unwrap_or(path).to_string_lossy();
            derived.files.get(&*name).is_some_and(|seal| seal.damage(path).is_some())
        })
    }
}

/// The files that have changed since they were made, in words.
pub(super) fn damage(directory: &Path) -> Vec<String> {
    let path = directory.join(FILE_NAME);
    let what = match fs::read(&path) {
        Ok(text) => (!sealed::is_whole(&text)).then_some("is damaged"),
        Err(_) if path.is_dir() => Some("is a directory"),
        // A run leaves no files of this kind.
        Err(_) => (!names(directory).is_empty()).then_some("is missing"),
    };
    if let Some(what) = what {
        return vec![format!(
            "{FILE_NAME} {what}: nothing tells what page, figures, tables and films were; `seawall report` makes it again"
        )];
    }
    let derived = Derived::read(directory);
    let told = derived.files.iter().filter_map(|(name, seal)| {
        seal.damage(&directory.join(name)).map(|what| format!("{name} {what}"))
    });
    told.chain(derived.ended_early(directory).then(|| CUT.to_owned())).collect()
}

/// What a report has not finished, or has not begun to make of the cases.
pub(super) const CUT: &str =
    "page, figures and tables were not finished: `seawall report` makes them again";

/// The derived files that exist.
fn names(directory: &Path) -> Vec<String> {
    let files = FILES.iter().filter(|name| directory.join(name).is_file());
    let files = files.map(|name| (*name).to_owned());
    files.chain(FOLDERS.iter().flat_map(|folder| inside(directory, folder))).collect()
}

/// All files in a folder of a directory, and in its folders. A link to nothing does not count.
fn inside(directory: &Path, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(directory.join(folder)).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| {
        let name = format!("{folder}/{}", entry.file_name().into_string().ok()?);
        let is_file = entry.path().is_file();
        Some(if is_file { vec![name] } else { inside(directory, &name) })
    });
    names.flatten().collect()
}

#[cfg(test)]
mod tests;
