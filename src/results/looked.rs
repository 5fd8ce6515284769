//! Notes on how far the files of a large study are known to be on the disk: `looked.json`.
//!
//! Reading every file of a million cases takes minutes. So a large study writes a note every few
//! seconds. It says how much of the journal is on the disk with the files of its cases, and has the
//! system's data on these files. A resuming process asks the system for the same data, and only
//! reads the files of later lines. If anything differs, all files are read. A flipped bit on the
//! disk does not change the system's data. It is found by [`mod@super::verify`].

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::closing::Closing;
use super::error::SweepError;
use super::journal::Journal;
use super::unsynced::Unsynced;
use super::{atomic_file, sealed};
use crate::disk::names::JOURNAL;

const FILE_NAME: &str = "looked.json";
const VERSION: u32 = 1;
/// Studies with more cases than this write notes.
pub(super) const ABOVE: usize = if cfg!(test) { 2 } else { Closing::ABOVE };
/// Shortest time between notes.
const EVERY: Duration = if cfg!(test) { Duration::ZERO } else { Duration::from_secs(5) };

/// The contents of a note.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Looked {
    /// Version of the note's own format.
    version: u32,
    /// The journal's inode number, which a copy does not have. Network disks have another number on
    /// each machine.
    journal: u64,
    /// Length of the journal.
    bytes: u64,
    /// Number of case lines.
    pub lines: usize,
    /// A sum over the system's data on their files.
    pub files: u64,
}

impl Looked {
    /// The note of a directory, if there is one that fits its journal.
    pub fn read(directory: &Path) -> Option<Looked> {
        let looked: Looked = sealed::read(&directory.join(FILE_NAME))?;
        let journal = fs::metadata(directory.join(JOURNAL)).ok()?;
        let [_, number] = atomic_file::identity(&journal);
        let is_it = looked.journal == number;
        (looked.version == VERSION && is_it && looked.bytes <= journal.len()).then_some(looked)
    }

    /// Removes it, because all is done or something is damaged.
    pub fn forget(directory: &Path) -> Result<(), SweepError> {
        atomic_file::remove(&directory.join(FILE_NAME))
    }
}

/// Writes such notes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Notes {
    /// The next note; `None` if none is written.
    next: Option<Looked>,
    last: Option<Instant>,
}

impl Notes {
    /// Notes of a study whose journal already has this many case lines. `stamps` is the sum over
    /// the system's data on their files. Without it no notes are written.
    ///
    /// # Errors
    /// A journal without data from the system.
    pub fn of(journal: &Journal, lines: usize, stamps: Option<u64>) -> Result<Notes, SweepError> {
        let (bytes, journal) = (journal.length(), journal.number()?);
        let looked = |files| Looked { version: VERSION, journal, bytes, lines, files };
        Ok(Notes { next: stamps.map(looked), last: None })
    }

    /// No notes.
    pub fn none() -> Notes {
        Notes { next: None, last: None }
    }

    /// This many more lines are on the disk, with all before them and with these files. The journal
    /// then has this length.
    pub fn add(self, directory: &Path, files: &Unsynced, lines: usize, bytes: u64) -> Notes {
        let more = |known: Looked| {
            let files = known.files.wrapping_add(files.stamp(directory)?);
            Some(Looked { bytes, lines: known.lines + lines, files, ..known })
        };
        Notes { next: self.next.and_then(more), ..self }
    }

    /// Writes the next note if it is time.
    pub fn write(self, directory: &Path) -> Result<Notes, SweepError> {
        let is_due = self.last.is_none_or(|last| last.elapsed() >= EVERY);
        let Some(next) = self.next.filter(|_| is_due) else { return Ok(self) };
        sealed::write(&directory.join(FILE_NAME), &next)?;
        Ok(Notes { last: Some(Instant::now()), ..self })
    }
}

#[cfg(test)]
mod tests;
