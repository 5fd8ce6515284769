//! The files of cases: whether they still exist when a sweep ends.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::ended::Ended;
use super::error::SweepError;
use super::seal::Seals;
use crate::disk::names::{CASE_FOLDERS, of_case};
use crate::keys::named;
use crate::math::words::counted;
use crate::study::CaseId;

/// Folders that hold a file of a case, a bit each.
pub(super) type Folders = u8;

/// Those of a successful case. It always has a history.
pub(super) fn folders(seals: &Seals) -> Folders {
    let bit = |(at, folder): (usize, &&str)| {
        let is_there = at == 0 || seals.contains_key(*folder);
        Folders::from(is_there) << at
    };
    CASE_FOLDERS.iter().enumerate().map(bit).sum()
}

/// The same for all cases of a study, by index.
#[derive(Debug)]
pub(super) struct Places(Vec<Folders>);

impl Places {
    /// For this many cases without files.
    pub(super) fn new(cases: usize) -> Places {
        Places(vec![0; cases])
    }

    /// This run has written files, if it is a case.
    pub(super) fn set(&mut self, index: usize, folders: Folders) {
        if let Some(place) = self.0.get_mut(index) {
            *place = folders;
        }
    }

    /// The files of the successful cases.
    pub(super) fn of(&self, cases: &[Option<Ended>]) -> Left {
        let case = |(case, &folders): (&Option<Ended>, &Folders)| {
            case.filter(|case| case.is_ok).map(|case| (case.id, folders))
        };
        Left(cases.iter().zip(&self.0).filter_map(case).collect())
    }
}

/// The successful cases, and the folders of their files.
#[derive(Debug)]
pub struct Left(Vec<(CaseId, Folders)>);

impl Left {
    /// Makes sure that all files exist. Their contents are not checked. The folders are listed,
    /// which takes a second for a million files.
    ///
    /// # Errors
    /// A file was deleted or moved.
    pub fn demand(&self, directory: &Path) -> Result<(), SweepError> {
        let lost = CASE_FOLDERS.iter().enumerate().flat_map(|(at, folder)| {
            let there = listed(&directory.join(folder));
            let of = self.0.iter().filter(move |(_, folders)| folders >> at & 1 == 1);
            let missing = of.filter(move |(id, _)| !there.contains(id));
            missing.map(move |(id, _)| of_case(directory, folder, id))
        });
        // If the directory is on another machine, a list may be older than a file.
        let lost: Vec<PathBuf> = lost.filter(|path| !path.is_file()).collect();
        let Some(first) = lost.first() else { return Ok(()) };
        let others = match lost.len() - 1 {
            0 => String::new(),
            others => format!(" and {}", counted(others, "other file")),
        };
        Err(SweepError::Executor(format!(
            "{}{others} went away while the sweep ran; the same command runs what left them again",
            named(first)
        )))
    }
}

/// The cases with a file in a folder.
fn listed(folder: &Path) -> HashSet<CaseId> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let case = |entry: fs::DirEntry| {
        entry.file_name().to_str()?.strip_suffix(".csv")?.parse::<CaseId>().ok()
    };
    entries.filter_map(case).collect()
}
