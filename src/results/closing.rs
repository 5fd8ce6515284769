//! The end of a large study: `closing.json`.
//!
//! Reading every file of a million cases takes a minute. So a large study is closed once all of it
//! is done and on the disk. As long as its directory has not changed since, nothing must be read
//! again: not the journal, not the cases' files, not the grid. A change shows in the length or the
//! last change of any file or folder in the directory. A folder changes when a file in it is made,
//! replaced or removed. A flipped bit in a file changes neither, and is found by [`super::verify`].

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::{lock, making, sealed};

const FILE_NAME: &str = "closing.json";

/// The end of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Closing {
    /// The request: a sum over the build, the sweep file and the settings of the command line.
    pub asked: String,
    /// The cases to be filmed.
    pub films: Vec<String>,
    /// Number of failed cases.
    pub failed: usize,
    /// The report on the cases.
    pub told: String,
    /// Length and last change, in nanoseconds, of all files in the directory.
    found: BTreeMap<String, (u64, u64)>,
}

impl Closing {
    /// Studies with more cases than this are closed. Smaller ones are read whole whenever they are
    /// opened.
    pub const ABOVE: usize = 10_000;

    /// A study that has just ended.
    pub fn new(asked: &str, films: &[String], failed: usize, told: String) -> Closing {
        let found = BTreeMap::new();
        Closing { asked: asked.to_owned(), films: films.to_vec(), failed, told, found }
    }

    /// Closes a directory in its present state. All of it must be on the disk.
    ///
    /// # Errors
    /// A file that cannot be written, a folder that cannot be read.
    pub fn write(self, directory: &Path) -> Result<(), SweepError> {
        let found = look(directory).map_err(SweepError::io(directory))?;
        sealed::write(&directory.join(FILE_NAME), &Closing { found, ..self })
    }

    /// How a directory was closed. `None` if it was not closed, has changed since, or the file is
    /// damaged.
    pub fn read(directory: &Path) -> Option<Closing> {
        let closing: Closing = sealed::read(&directory.join(FILE_NAME))?;
        (look(directory).ok()? == closing.found).then_some(closing)
    }
}

/// The files of a directory, without this file and the locks.
fn look(directory: &Path) -> std::io::Result<BTreeMap<String, (u64, u64)>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if [FILE_NAME, lock::FILE_NAME, making::FILE_NAME].contains(&&*name) {
            continue;
        }
        let entry = fs::metadata(entry.path())?;
        let changed = entry.modified()?.duration_since(UNIX_EPOCH).unwrap_or_default();
        let changed = u64::try_from(changed.as_nanos()).unwrap_or(u64::MAX);
        found.insert(name, (entry.len(), changed));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::super::atomic_file;
    use super::*;

    #[test]
    fn a_directory_stays_closed_until_anything_in_it_changes() {
        let root = tempfile::tempdir().unwrap();
        let (directory, history) = (root.path(), root.path().join("histories/a.csv"));
        let pause = || std::thread::sleep(std::time::Duration::from_millis(20));
        let close = || {
            let closing = Closing::new("sum", &[], 3, "told".to_owned());
            closing.write(directory).unwrap();
            pause();
            let read = Closing::read(directory).unwrap();
            assert_eq!((&*read.asked, read.failed, &*read.told), ("sum", 3, "told"));
        };
        fs::create_dir(directory.join("histories")).unwrap();
        fs::write(&history, "1").unwrap();
        fs::write(directory.join("journal.jsonl"), "line\n").unwrap();
        assert_eq!(Closing::read(directory), None);
        close();
        for lock in [lock::FILE_NAME, making::FILE_NAME] {
            fs::write(directory.join(lock), "").unwrap();
        }
        assert!(Closing::read(directory).is_some());
        let changes: [&dyn Fn(); 6] = [
            &|| fs::write(directory.join("journal.jsonl"), "enil\n").unwrap(),
            &|| fs::write(directory.join("journal.jsonl"), "line\nline\n").unwrap(),
            &|| fs::write(directory.join("summary.csv"), "").unwrap(),
            &|| atomic_file::write(&history, b"2").unwrap(),
            &|| fs::remove_file(&history).unwrap(),
            &|| fs::remove_dir(directory.join("histories")).unwrap(),
        ];
        for (number, change) in changes.iter().enumerate() {
            change();
            assert_eq!(Closing::read(directory), None, "change {number}");
            close();
        }
    }
}
