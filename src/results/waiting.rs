//! What is recorded and waits to be put on the disk.

use std::path::Path;
use std::thread::JoinHandle;
use std::time::Duration;

use super::checkpoints;
use super::error::SweepError;
use super::files::Unsynced;
use super::journal::Journal;
use super::seal::Seals;
use crate::study::CaseId;

/// Lines and files are on the disk after this time at most.
pub(super) const LONGEST: Duration = Duration::from_millis(200);

/// Lines and files that may not be on the disk yet.
#[derive(Debug)]
pub(super) struct Waiting {
    files: Unsynced,
    /// The cases of the lines.
    lines: Vec<CaseId>,
    /// What goes to the disk just now.
    group: Option<Group>,
}

impl Waiting {
    /// Nothing of this directory yet.
    pub(super) fn new(directory: &Path) -> Result<Waiting, SweepError> {
        Ok(Waiting { files: Unsynced::new(directory)?, lines: Vec::new(), group: None })
    }

    /// A case has left its files.
    pub(super) fn add_files(&mut self, directory: &Path, id: CaseId, seals: &Seals) {
        self.files.add(directory, id, seals);
    }

    /// A case has a line in the journal.
    pub(super) fn add_line(&mut self, id: CaseId) {
        self.lines.push(id);
    }

    /// Whether nothing waits.
    #[cfg(test)]
    pub(super) fn is_over(&self) -> bool {
        self.group.is_none() && self.lines.is_empty()
    }

    /// Puts everything on the disk: if `now`, before it returns; otherwise what has waited long enough,
    /// beside everything else. A case that is on the disk needs its checkpoint no more.
    pub(super) fn sync(
        &mut self,
        directory: &Path,
        journal: &mut Journal,
        now: bool,
    ) -> Result<(), SweepError> {
        if let Some(group) = self.group.take_if(|group| now || group.is_ended()) {
            checkpoints::remove(directory, group.end()?)?;
        }
        if !journal.waits(if now { Duration::ZERO } else { LONGEST }) || self.group.is_some() {
            return Ok(());
        }
        journal.demand_in_place()?;
        if now {
            self.files.take().sync(directory)?;
            journal.sync()?;
            return checkpoints::remove(directory, self.lines.drain(..));
        }
        let mut journal = journal.let_sync()?;
        let (path, files) = (directory.to_owned(), self.files.take());
        self.group = Some(Group::start(std::mem::take(&mut self.lines), move || {
            files.sync(&path)?;
            journal.sync()
        }));
        Ok(())
    }
}

/// A group of cases on its way to the disk, on a thread of its own.
#[derive(Debug)]
struct Group {
    cases: Vec<CaseId>,
    thread: JoinHandle<Result<(), SweepError>>,
}

impl Group {
    /// Begins; `sync` puts everything that these cases have left on the disk.
    fn start(
        cases: Vec<CaseId>,
        sync: impl FnOnce() -> Result<(), SweepError> + Send + 'static,
    ) -> Group {
        Group { cases, thread: std::thread::spawn(sync) }
    }

    /// Whether the disk has answered.
    fn is_ended(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the disk; what is on it now.
    fn end(self) -> Result<Vec<CaseId>, SweepError> {
        let panicked = |_| SweepError::Executor("writing to the disk ended in a panic".to_owned());
        self.thread.join().unwrap_or_else(|panic| Err(panicked(panic)))?;
        Ok(self.cases)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_disk_refuses_is_told() {
        let case = "0000000000000001".parse::<CaseId>().unwrap();
        assert_eq!(Group::start(vec![case], || Ok(())).end().unwrap(), [case]);
        let full = || Err(SweepError::Executor("the disk is full".to_owned()));
        assert!(Group::start(vec![case], full).end().is_err());
        assert!(Group::start(vec![case], || panic!("lost it")).end().is_err());
    }
}
