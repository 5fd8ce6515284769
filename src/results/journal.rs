//! The journal: the truth about a sweep, one line of JSON per finished case.
//!
//! The first line is the [`Header`]. Lines are only ever appended. A torn last line (the process or
//! the machine died) is cut off on reopening. A damaged line only affects its case: the line is set
//! aside, and the case runs again. Lines reach the disk in groups: within 0.2 s, or as soon as
//! there is no other work.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use super::atomic_file;
use super::entries::{self, Condition, Content, Entry, Header};
use super::error::SweepError;
use super::manifest::Manifest;
use super::record::CaseRecord;
use super::wanted::Wanted;
use crate::disk;
use crate::disk::names::JOURNAL;
use crate::keys::named;

/// Where damaged lines go.
const DAMAGED: &str = "journal.damaged";

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Its length in bytes, with those that were appended.
    length: u64,
    unsynced_since: Option<Instant>,
}

impl Journal {
    /// Starts a journal.
    pub fn create(directory: &Path, header: &Header) -> Result<Journal, SweepError> {
        let path = directory.join(JOURNAL);
        // Opened for appending: after a cut, writing at a fixed place would leave a hole.
        let file = disk::append(&path).map_err(SweepError::io(&path))?;
        let mut journal = Journal { path, file, length: 0, unsynced_since: None };
        journal.append(&Entry::<CaseRecord>::Header(header.clone()))?;
        journal.sync()?;
        atomic_file::sync(directory)?;
        Ok(journal)
    }

    /// Opens a journal with these contents, to go on with it. A torn last line is cut off, and
    /// damaged lines are set aside. If the first line is lost, `header` replaces it.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn resume(
        directory: &Path,
        content: &Content<impl Sized>,
        header: &Header,
    ) -> Result<Journal, SweepError> {
        let path = directory.join(JOURNAL);
        if content.condition == Condition::Damaged {
            let text = std::fs::read(&path).map_err(SweepError::io(&path))?;
            let [whole, damaged] = entries::sorted(&text);
            keep_damaged(directory, &damaged)?;
            let header = || Entry::<CaseRecord>::Header(header.clone()).line();
            let first = content.header.is_none().then(header);
            let text = [first.unwrap_or_default().as_bytes(), &whole].concat();
            atomic_file::write(&path, &text)?;
        }
        let file = disk::append(&path).map_err(SweepError::io(&path))?;
        if let Condition::Torn(whole) = content.condition {
            disk::cut(&path, whole).map_err(SweepError::io(&path))?;
        }
        let length = file.metadata().map_err(SweepError::io(&path))?.len();
        Ok(Journal { path, file, length, unsynced_since: None })
    }

    /// Appends a finished case.
    pub fn record(&mut self, record: &CaseRecord) -> Result<(), SweepError> {
        self.append(&Entry::Case(Box::new(record)))
    }

    fn append(&mut self, entry: &Entry<impl Serialize>) -> Result<(), SweepError> {
        let line = entry.line();
        disk::write(&self.file, line.as_bytes()).map_err(SweepError::io(&self.path))?;
        self.length += line.len() as u64;
        self.unsynced_since.get_or_insert_with(Instant::now);
        Ok(())
    }

    /// Its length, with all that was appended.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// Its number on its device.
    pub(super) fn number(&self) -> Result<u64, SweepError> {
        let file = self.file.metadata().map_err(SweepError::io(&self.path))?;
        let [_, number] = atomic_file::identity(&file);
        Ok(number)
    }

    /// Whether lines have waited for the disk for this long.
    pub fn waits(&self, time: Duration) -> bool {
        self.unsynced_since.is_some_and(|since| since.elapsed() >= time)
    }

    /// Puts all lines on the disk.
    pub fn sync(&mut self) -> Result<(), SweepError> {
        if self.unsynced_since.is_some() {
            disk::sync_data(&self.file).map_err(SweepError::io(&self.path))?;
            self.unsynced_since = None;
        }
        Ok(())
    }

    /// Lets another thread put the lines so far on the disk.
    pub(super) fn let_sync(&mut self) -> Result<Journal, SweepError> {
        let file = self.file.try_clone().map_err(SweepError::io(&self.path))?;
        let (path, unsynced_since) = (self.path.clone(), self.unsynced_since.take());
        Ok(Journal { path, file, length: self.length, unsynced_since })
    }

    /// Makes sure that the open file still has its name and its contents.
    ///
    /// # Errors
    /// The file was deleted, moved or cut, or the directory was moved.
    pub fn demand_in_place(&self) -> Result<(), SweepError> {
        let reason = if !atomic_file::is_same(&self.file, &self.path) {
            "was deleted, moved or replaced while the sweep ran; what finished since then is lost"
        } else if self.file.metadata().map_or(0, |file| file.len()) != self.length {
            "was cut or written to by somebody else while the sweep ran"
        } else {
            return Ok(());
        };
        Err(SweepError::Executor(format!("{}: {reason}", named(&self.path))))
    }
}

/// Adds lines to those that were set aside earlier.
fn keep_damaged(directory: &Path, lines: &[u8]) -> Result<(), SweepError> {
    if lines.is_empty() {
        return Ok(());
    }
    let path = directory.join(DAMAGED);
    let file = disk::append(&path);
    file.and_then(|file| disk::write(&file, lines)).map_err(SweepError::io(&path))
}

/// Only the header; `None` if its line is not intact.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub(super) fn read_header(directory: &Path) -> Result<Option<Header>, SweepError> {
    let path = directory.join(JOURNAL);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    let mut line = Vec::new();
    BufReader::new(file).read_until(b'\n', &mut line).map_err(SweepError::io(&path))?;
    Ok(entries::parse::<CaseRecord>(&path, &line[..])?.header)
}

/// The header of a directory's journal. If its line is lost, the manifest says the same.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn header_of(directory: &Path) -> Result<Option<Header>, SweepError> {
    let of_manifest = || {
        let manifest = Manifest::read(directory)?;
        let simd = manifest.simd_path()?;
        Some(Header::new(&manifest.name, &manifest.sweep, manifest.cases, simd))
    };
    Ok(read_header(directory)?.or_else(of_manifest))
}

/// Reads a journal without changing it, and passes on its records block by block. `R` has the
/// needed part of a record. For a large study the rest takes time and memory.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn read_in_blocks<R: Wanted>(
    directory: &Path,
    take: impl FnMut(Vec<R>),
) -> Result<Content<R>, SweepError> {
    let path = directory.join(JOURNAL);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    entries::parse_in_blocks(&path, BufReader::new(file), take)
}

/// Reads a journal without changing it.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn read_journal(directory: &Path) -> Result<Content, SweepError> {
    let path = directory.join(JOURNAL);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    entries::parse(&path, BufReader::new(file))
}

#[cfg(test)]
mod tests;
