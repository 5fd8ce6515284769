//! Recorded data that wait to be put on the disk.

use std::collections::BTreeSet;
use std::path::Path;
use std::thread::JoinHandle;
use std::time::Duration;

use super::checkpoints;
use super::error::SweepError;
use super::journal::Journal;
use super::looked::Notes;
use super::stamp::CaseFiles;
use super::unsynced::Unsynced;
use crate::study::CaseId;

/// Longest time until lines and files are on the disk.
pub(super) const LONGEST: Duration = Duration::from_millis(200);

/// Lines and files that may not be on the disk yet.
#[derive(Debug)]
pub(super) struct Waiting {
    files: Unsynced,
    /// The cases of the lines.
    lines: Vec<CaseId>,
    /// The data that go to the disk at present.
    group: Option<Group>,
    /// Notes on the data on the disk.
    notes: Notes,
    /// Cases that have lost files. No notes are written before they have run again.
    owed: BTreeSet<CaseId>,
}

impl Waiting {
    /// The state found in this directory. The files of these cases may not be on the disk yet.
    /// Those of `owed` are damaged or missing.
    pub(super) fn new(
        directory: &Path,
        found: Vec<CaseFiles>,
        notes: Notes,
        owed: BTreeSet<CaseId>,
    ) -> Result<Waiting, SweepError> {
        let files = Unsynced::new(directory, found)?;
        Ok(Waiting { files, lines: Vec::new(), group: None, notes, owed })
    }

    /// A case has written its files. They may be on the disk already.
    pub(super) fn add_files(&mut self, files: CaseFiles, on_disk: bool) {
        self.files.add(files, on_disk);
    }

    /// A case has a line in the journal.
    pub(super) fn add_line(&mut self, id: CaseId) {
        self.owed.remove(&id);
        self.lines.push(id);
    }

    /// Whether nothing waits.
    #[cfg(test)]
    pub(super) fn is_over(&self) -> bool {
        self.group.is_none() && self.lines.is_empty()
    }

    /// Puts everything on the disk. With `now` it waits for that. Otherwise only data that have
    /// waited long enough go, in parallel with other work. A case on the disk needs no checkpoint
    /// any more.
    pub(super) fn sync(
        &mut self,
        directory: &Path,
        journal: &mut Journal,
        now: bool,
    ) -> Result<(), SweepError> {
        if let Some(group) = self.group.take_if(|group| now || group.is_ended()) {
            let (cases, notes) = group.end()?;
            self.notes = notes;
            checkpoints::remove(directory, cases)?;
        }
        if !journal.waits(if now { Duration::ZERO } else { LONGEST }) || self.group.is_some() {
            return Ok(());
        }
        journal.demand_in_place()?;
        let (path, files, notes) = (directory.to_owned(), self.files.take(), self.notes);
        let (lines, bytes) = (self.lines.len(), journal.length());
        let is_whole = self.owed.is_empty();
        let put = move |journal: &mut Journal| {
            let with_found = files.sync(&path)?;
            journal.sync()?;
            // A note is written after all data that it covers.
            let notes = if with_found { notes } else { Notes::none() };
            let notes = notes.add(&path, &files, lines, bytes);
            if is_whole { notes.write(&path) } else { Ok(notes) }
        };
        if now {
            self.notes = put(journal)?;
            return checkpoints::remove(directory, self.lines.drain(..));
        }
        let mut journal = journal.let_sync()?;
        let lines = std::mem::take(&mut self.lines);
        self.group = Some(Group::start(lines, move || put(&mut journal)));
        Ok(())
    }
}

/// A group of cases on its way to the disk, on a thread of its own.
#[derive(Debug)]
struct Group {
    cases: Vec<CaseId>,
    thread: JoinHandle<Result<Notes, SweepError>>,
}

impl Group {
    /// Starts it. `sync` puts all files of these cases on the disk, and writes the notes.
    fn start(
        cases: Vec<CaseId>,
        sync: impl FnOnce() -> Result<Notes, SweepError> + Send + 'static,
    ) -> Group {
        Group { cases, thread: std::thread::spawn(sync) }
    }

    /// Whether the disk has finished.
    fn is_ended(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the disk. Returns the cases on it, and the notes.
    fn end(self) -> Result<(Vec<CaseId>, Notes), SweepError> {
        let panicked = |_| SweepError::Executor("writing to the disk ended in a panic".to_owned());
        let notes = self.thread.join().unwrap_or_else(|panic| Err(panicked(panic)))?;
        Ok((self.cases, notes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_disk_refuses_is_told() {
        let case = "0000000000000001".parse::<CaseId>().unwrap();
        assert_eq!(Group::start(vec![case], || Ok(Notes::none())).end().unwrap().0, [case]);
        let full = || Err(SweepError::Executor("the disk is full".to_owned()));
        assert!(Group::start(vec![case], full).end().is_err());
        assert!(Group::start(vec![case], || panic!("lost it")).end().is_err());
    }
}
