//! Up to where the files of a large study are known to be on the disk: `looked.json`.
//!
//! To read every file of a million cases takes minutes. A large study makes a note every few seconds. It says how much of the
//! journal is on the disk with the files of its cases. It also says what the system tells of these files. Whoever goes on
//! asks the system for the same, and reads the files of later lines alone. Where anything differs, all files are read. A bit
//! that has flipped on the disk changes nothing that the system tells. It is found by [`super::verify`].

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::closing::Closing;
use super::error::SweepError;
use super::journal::{self, Journal};
use super::unsynced::Unsynced;
use super::{atomic_file, sealed};

const FILE_NAME: &str = "looked.json";
const VERSION: u32 = 1;
/// Studies of more cases make notes.
pub(super) const ABOVE: usize = if cfg!(test) { 2 } else { Closing::ABOVE };
/// A note is made so often at most.
const EVERY: Duration = if cfg!(test) { Duration::ZERO } else { Duration::from_secs(5) };

/// What a note says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Looked {
    /// Version of the note's own format.
    version: u32,
    /// The journal's inode number: that of a copy is another one. Disks of a network have another number on each machine.
    journal: u64,
    /// So long the journal was.
    bytes: u64,
    /// So many lines of cases there were.
    pub lines: usize,
    /// A sum over what the system told of their files.
    pub files: u64,
}

impl Looked {
    /// The note of a directory, where there is one that fits its journal.
    pub fn read(directory: &Path) -> Option<Looked> {
        let looked: Looked = sealed::read(&directory.join(FILE_NAME))?;
        let journal = fs::metadata(directory.join(journal::FILE_NAME)).ok()?;
        let [_, number] = atomic_file::identity(&journal);
        let is_it = looked.journal == number;
        (looked.version == VERSION && is_it && looked.bytes <= journal.len()).then_some(looked)
    }

    /// Removes it: all is done, or something is damaged.
    pub fn forget(directory: &Path) -> Result<(), SweepError> {
        atomic_file::remove(&directory.join(FILE_NAME))
    }
}

/// Makes such notes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Notes {
    /// What the next one says; `None` where none is made.
    next: Option<Looked>,
    last: Option<Instant>,
}

impl Notes {
    /// Notes of a study whose journal has so many lines of cases already. `stamps` is the sum over what the system tells of
    /// their files. Without it none are made.
    ///
    /// # Errors
    /// A journal of which the system tells nothing.
    pub fn of(journal: &Journal, lines: usize, stamps: Option<u64>) -> Result<Notes, SweepError> {
        let (bytes, journal) = (journal.length(), journal.number()?);
        let looked = |files| Looked { version: VERSION, journal, bytes, lines, files };
        Ok(Notes { next: stamps.map(looked), last: None })
    }

    /// None are made.
    pub fn none() -> Notes {
        Notes { next: None, last: None }
    }

    /// So many lines more are on the disk, with all before them and with these files. The journal is so long with them.
    pub fn add(self, directory: &Path, files: &Unsynced, lines: usize, bytes: u64) -> Notes {
        let more = |known: Looked| {
            let files = known.files.wrapping_add(files.stamp(directory)?);
            Some(Looked { bytes, lines: known.lines + lines, files, ..known })
        };
        Notes { next: self.next.and_then(more), ..self }
    }

    /// Writes the next one, if it is time to.
    pub fn write(self, directory: &Path) -> Result<Notes, SweepError> {
        let is_due = self.last.is_none_or(|last| last.elapsed() >= EVERY);
        let Some(next) = self.next.filter(|_| is_due) else { return Ok(self) };
        sealed::write(&directory.join(FILE_NAME), &next)?;
        Ok(Notes { last: Some(Instant::now()), ..self })
    }
}

#[cfg(test)]
mod tests;
