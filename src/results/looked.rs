//! Up to where the files of a large study are known to be on the disk: `looked.json`.
//!
//! To read every file of a million cases takes minutes. While a large study runs, it notes now and then how many lines
//! of its journal are on the disk with the files of their cases. Whoever goes on reads the files of later lines. Of
//! those before it asks the system for length and time of the last change: a file that has changed since the note is
//! read, too. A bit that has flipped on the disk changes neither, and is found by [`super::verify`].

use std::fs::{self, File, Metadata};
use std::path::Path;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::closing::Closing;
use super::error::SweepError;
use super::{disk, sealed};

const FILE_NAME: &str = "looked.json";
/// A note is made so often at most.
const EVERY: Duration = Duration::from_secs(10);

/// What such a note says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Looked {
    /// So many lines of cases at the journal's beginning.
    pub lines: usize,
    /// When it was made, by the disk's own clock.
    #[serde(skip)]
    pub at: Change,
}

/// A time of the last change, seconds and nanoseconds.
pub(super) type Change = (i64, i64);

impl Looked {
    /// The note of a directory, where there is one.
    pub fn read(directory: &Path) -> Option<Looked> {
        let path = directory.join(FILE_NAME);
        let looked: Looked = sealed::read(&path)?;
        Some(Looked { at: changed(&fs::metadata(&path).ok()?)?, ..looked })
    }

    /// Removes it: all is done, or something is damaged.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget(directory: &Path) -> Result<(), SweepError> {
        let path = directory.join(FILE_NAME);
        if path.exists() { disk::remove_file(&path).map_err(SweepError::io(&path)) } else { Ok(()) }
    }
}

/// Makes such notes.
#[derive(Debug)]
pub(super) struct Notes {
    /// Lines that were there when the directory was opened; `None` where something was damaged then.
    found: Option<usize>,
    /// Lines of the last note.
    noted: usize,
    last: Option<Instant>,
}

impl Notes {
    /// Of a journal that has so many lines of cases, whose files were all `whole`. Else there is no note any more.
    ///
    /// # Errors
    /// A file that cannot be written or removed.
    pub fn of(directory: &Path, found: usize, whole: bool) -> Result<Notes, SweepError> {
        let mut notes = Notes { found: whole.then_some(found), noted: 0, last: None };
        if !whole {
            Looked::forget(directory)?;
        } else if found > Closing::ABOVE
            && File::open(directory).is_ok_and(|it| disk::sync_all(&it))
        {
            // A process that was killed may have left files that are not on the disk yet.
            notes.take(directory, 0)?;
        }
        Ok(notes)
    }

    /// So many more lines are on the disk now, with their cases' files.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn take(&mut self, directory: &Path, more: usize) -> Result<(), SweepError> {
        let Some(lines) = self.found.map(|found| found + more) else { return Ok(()) };
        let due = self.last.is_none_or(|last| last.elapsed() >= EVERY);
        if lines <= Closing::ABOVE || lines == self.noted || !due {
            return Ok(());
        }
        (self.noted, self.last) = (lines, Some(Instant::now()));
        sealed::write(&directory.join(FILE_NAME), &Looked { lines, at: Change::default() })
    }
}

/// When a file, or its name, was last changed.
#[cfg(unix)]
pub(super) fn changed(file: &Metadata) -> Option<Change> {
    use std::os::unix::fs::MetadataExt;
    Some((file.ctime(), file.ctime_nsec()))
}

/// Elsewhere the system does not tell that of a name: every file is read.
#[cfg(not(unix))]
pub(super) fn changed(_file: &Metadata) -> Option<Change> {
    None
}
