//! A group of cases on its way to the disk, on a thread of its own.

use std::thread::JoinHandle;

use super::error::SweepError;
use crate::study::CaseId;

/// Cases that will be on the disk when their thread has ended.
#[derive(Debug)]
pub(super) struct Group {
    cases: Vec<CaseId>,
    thread: JoinHandle<Result<(), SweepError>>,
}

impl Group {
    /// Begins; `sync` puts everything that these cases have left on the disk.
    pub(super) fn start(
        cases: Vec<CaseId>,
        sync: impl FnOnce() -> Result<(), SweepError> + Send + 'static,
    ) -> Group {
        Group { cases, thread: std::thread::spawn(sync) }
    }

    /// Whether the disk has answered.
    pub(super) fn is_ended(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the disk; what is on it now.
    pub(super) fn end(self) -> Result<Vec<CaseId>, SweepError> {
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
