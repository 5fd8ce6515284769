//! A list on disk of the work that has begun and not ended. It shows which work a process died of.
//!
//! A line `+<id>` is written before a case or a trunk starts, `-<id>` when it has ended. Work that
//! has begun and not ended when a directory is opened is a suspect: its process may have died of
//! it. A suspect runs in a process of its own, so that only the suspect fails if that process dies.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::atomic_file;
use super::error::SweepError;
use crate::disk;
use crate::study::CaseId;

const FILE_NAME: &str = "running";

/// An open list of running work.
#[derive(Debug)]
pub struct Attempts {
    path: PathBuf,
    file: Option<File>,
    running: BTreeSet<CaseId>,
    suspects: BTreeSet<CaseId>,
}

impl Attempts {
    /// Reads which work an earlier process had begun and not ended.
    pub(super) fn open(directory: &Path) -> Result<Attempts, SweepError> {
        let path = directory.join(FILE_NAME);
        let bytes = if path.exists() { fs::read(&path) } else { Ok(Vec::new()) };
        let bytes = bytes.map_err(SweepError::io(&path))?;
        let suspects = begun(&String::from_utf8_lossy(&bytes));
        Ok(Attempts { path, file: None, running: suspects.clone(), suspects })
    }

    /// Whether a process may have died of this case or trunk.
    pub fn is_suspect(&self, id: CaseId) -> bool {
        self.suspects.contains(&id)
    }

    /// Makes this case a suspect too.
    pub fn suspect(&mut self, id: CaseId) {
        self.suspects.insert(id);
    }

    /// How many suspects there are.
    pub fn suspects(&self) -> usize {
        self.suspects.len()
    }

    /// One piece of work has ended, and others are about to start: a single system call for all.
    pub fn turn(&mut self, ended: Option<CaseId>, begun: &[CaseId]) -> Result<(), SweepError> {
        let mut lines = String::new();
        let mut add = |sign: char, id: CaseId| {
            // A line before it may be torn, and must not spoil this one.
            lines.push_str(&format!("\n{sign}{id}\n"));
        };
        if let Some(id) = ended {
            self.suspects.remove(&id);
            if self.running.remove(&id) {
                add('-', id);
            }
        }
        begun.iter().filter(|&&id| self.running.insert(id)).for_each(|&id| add('+', id));
        if lines.is_empty() { Ok(()) } else { self.append(&lines) }
    }

    /// All work has ended in order.
    pub fn close(&mut self) -> Result<(), SweepError> {
        self.running.clear();
        self.file = None;
        atomic_file::remove(&self.path)
    }

    fn append(&mut self, lines: &str) -> Result<(), SweepError> {
        let file = match &mut self.file {
            Some(file) => Ok(file),
            none => disk::append(&self.path).map(|file| none.insert(file)),
        };
        let written = file.and_then(|file| disk::write(file, lines.as_bytes()));
        written.map_err(SweepError::io(&self.path))
    }
}

/// The work that has begun and not ended in a list. Invalid lines are ignored.
fn begun(text: &str) -> BTreeSet<CaseId> {
    let mut ids = BTreeSet::new();
    for line in text.lines() {
        let id = |rest: &str| rest.parse::<CaseId>().ok();
        if let Some(id) = line.strip_prefix('+').and_then(id) {
            ids.insert(id);
        } else if let Some(id) = line.strip_prefix('-').and_then(id) {
            ids.remove(&id);
        }
    }
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    fn id(number: u64) -> CaseId {
        format!("{number:016x}").parse().unwrap()
    }

    #[test]
    fn what_has_begun_and_not_ended_is_a_suspect() {
        let directory = tempfile::tempdir().unwrap();
        let mut first = Attempts::open(directory.path()).unwrap();
        first.turn(None, &[id(1)]).unwrap();
        first.turn(None, &[id(2)]).unwrap();
        first.turn(Some(id(1)), &[]).unwrap();
        drop(first); // as a killed process would
        let mut second = Attempts::open(directory.path()).unwrap();
        assert!(second.is_suspect(id(2)) && !second.is_suspect(id(1)));
        second.turn(None, &[id(2)]).unwrap();
        drop(second);
        let mut third = Attempts::open(directory.path()).unwrap();
        assert!(third.is_suspect(id(2)));
        third.turn(Some(id(2)), &[id(3), id(4)]).unwrap();
        third.turn(Some(id(4)), &[]).unwrap();
        let fourth = Attempts::open(directory.path()).unwrap();
        assert_eq!(fourth.suspects, BTreeSet::from([id(3)]));
        third.turn(Some(id(3)), &[]).unwrap();
        assert!(!Attempts::open(directory.path()).unwrap().is_suspect(id(2)));
        third.close().unwrap();
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    }

    #[test]
    fn torn_and_foreign_lines_count_for_nothing() {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join(FILE_NAME), "+00000000").unwrap();
        Attempts::open(directory.path()).unwrap().turn(None, &[id(2)]).unwrap();
        assert!(Attempts::open(directory.path()).unwrap().is_suspect(id(2)));
        assert_eq!(begun("+0000000000000001\nhello\n-\n+00000000"), BTreeSet::from([id(1)]));
    }
}
