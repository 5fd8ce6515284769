//! What a process holds of each run that has ended: whose it is and how, and no more. Of a million cases the rest
//! would be a gigabyte, and half of the time that it takes to go on with them.

use serde::Deserialize;

use super::record::{CaseRecord, HeldLine};
use super::seal::Seals;
use super::wanted::Wanted;
use crate::simulation::FailureKind;
use crate::study::CaseId;

/// A run that has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ended {
    /// Whose it is.
    pub id: CaseId,
    /// Whether it has ended well.
    pub is_ok: bool,
}

/// A journal line as far as somebody wants it.
pub(super) trait Line: Wanted {
    /// What is held of it.
    type Held: Clone + Send;

    /// Whose line it is, and how the run ended.
    fn ended(&self) -> Ended;

    /// What is held of it, which has its place in the study, and the seals of the case's files.
    fn split(self, index: usize) -> (Self::Held, Seals);
}

/// A journal line as far as a study needs it to go on.
#[derive(Debug, Deserialize)]
pub(super) struct EndedLine {
    id: CaseId,
    failure: Option<FailureKind>,
    #[serde(default)]
    files: Seals,
}

impl Wanted for EndedLine {
    const UNWANTED: Option<[&'static str; 2]> = Some([",\"reason\":", ",\"files\":"]);
}

impl Line for EndedLine {
    type Held = Ended;

    fn ended(&self) -> Ended {
        Ended { id: self.id, is_ok: self.failure.is_none() }
    }

    fn split(self, _: usize) -> (Ended, Seals) {
        (self.ended(), self.files)
    }
}

impl Line for HeldLine {
    type Held = CaseRecord;

    fn ended(&self) -> Ended {
        Ended { id: self.id(), is_ok: self.is_ok() }
    }

    fn split(self, index: usize) -> (CaseRecord, Seals) {
        HeldLine::split(self, index)
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial;
    use super::*;

    #[test]
    fn little_is_held_of_a_run() {
        let study = trial::study("0.2");
        let line = serde_json::to_string(&trial::record(&study, &study.cases[0])).unwrap();
        let brief: EndedLine = serde_json::from_str(&line).unwrap();
        let whole: HeldLine = serde_json::from_str(&line).unwrap();
        assert_eq!(brief.ended(), Ended { id: study.cases[0].id, is_ok: true });
        assert_eq!(Line::ended(&whole), brief.ended());
        let bytes = std::mem::size_of::<Option<Ended>>();
        assert!(bytes <= 16, "{bytes} bytes for each run");
    }
}
