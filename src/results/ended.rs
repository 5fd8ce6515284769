//! The data that a process keeps of each finished run: its id and whether it is ok. For a million
//! cases the rest would take a gigabyte, and half of the time of resuming.

use serde::Deserialize;

use super::seal::Seals;
use super::wanted::Wanted;
use crate::simulation::FailureKind;
use crate::study::CaseId;

/// A finished run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ended {
    /// Its id.
    pub id: CaseId,
    /// Whether it has ended well.
    pub is_ok: bool,
}

/// A journal line, as far as it is needed.
pub(super) trait Line: Wanted {
    /// The part that is kept.
    type Held: Clone + Send;

    /// The id, and how the run ended.
    fn ended(&self) -> Ended;

    /// The part that is kept, with its index in the study, and the seals of the case's files.
    fn split(self, index: usize) -> (Self::Held, Seals);
}

/// A journal line, as far as a study needs it to go on.
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

#[cfg(test)]
mod tests {
    use super::super::record::HeldLine;
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
