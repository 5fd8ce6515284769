//! The files that cases have left: whether they are still there when a sweep ends.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::ended::Ended;
use super::error::SweepError;
use super::files::{self, FOLDERS};
use super::seal::Seals;
use crate::keys::named;
use crate::math::words::counted;
use crate::study::CaseId;

/// Folders that hold a file of a case, a bit each.
pub(super) type Folders = u8;

/// Those of a case that has ended well. It has a history, whatever else it has.
pub(super) fn folders(seals: &Seals) -> Folders {
    let bit = |(at, folder): (usize, &&str)| {
        let is_there = at == 0 || seals.contains_key(*folder);
        Folders::from(is_there) << at
    };
    FOLDERS.iter().enumerate().map(bit).sum()
}

/// The same of all cases of a study, by their places.
#[derive(Debug)]
pub(super) struct Places(Vec<Folders>);

impl Places {
    /// So many cases, none of which has left anything yet.
    pub(super) fn new(cases: usize) -> Places {
        Places(vec![0; cases])
    }

    /// This run has left files, if it is a case.
    pub(super) fn set(&mut self, index: usize, folders: Folders) {
        if let Some(place) = self.0.get_mut(index) {
            *place = folders;
        }
    }

    /// What those have left that have ended well.
    pub(super) fn of(&self, cases: &[Option<Ended>]) -> Left {
        let case = |(case, &folders): (&Option<Ended>, &Folders)| {
            case.filter(|case| case.is_ok).map(|case| (case.id, folders))
        };
        Left(cases.iter().zip(&self.0).filter_map(case).collect())
    }
}

/// The cases that have ended well, and where their files are.
#[derive(Debug)]
pub struct Left(Vec<(CaseId, Folders)>);

impl Left {
    /// Makes sure that all files are there. What they hold is not looked at: folders are listed, of a million files
    /// in a second.
    ///
    /// # Errors
    /// Somebody has deleted or moved one.
    pub fn demand(&self, directory: &Path) -> Result<(), SweepError> {
        let lost = FOLDERS.iter().enumerate().flat_map(|(at, folder)| {
            let there = listed(&directory.join(folder));
            let of = self.0.iter().filter(move |(_, folders)| folders >> at & 1 == 1);
            let missing = of.filter(move |(id, _)| !there.contains(id));
            missing.map(move |(id, _)| files::path(directory, folder, id))
        });
        // A list may be older than a file, where the directory is on another machine.
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

/// The cases of which there is a file in a folder.
fn listed(folder: &Path) -> HashSet<CaseId> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let case = |entry: fs::DirEntry| {
        entry.file_name().to_str()?.strip_suffix(".csv")?.parse::<CaseId>().ok()
    };
    entries.filter_map(case).collect()
}
