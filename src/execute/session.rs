//! One process's work on an output directory, and how it ended.

use super::interrupt::Interrupt;
use super::progress::Progress;
use crate::results::{Directory, Load, RankInfo, Savings};
use crate::schedule::Work;
use crate::study::{CaseId, Plan, Study};

/// How a session ended.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Ending {
    /// Every case is done or has failed.
    Finished,
    /// The user stopped it; cases are left.
    #[default]
    Interrupted,
}

/// What a session has done.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Worked {
    /// How it ended.
    pub ending: Ending,
    /// What branching has saved.
    pub savings: Savings,
    /// How busy each rank was.
    pub load: Load,
}

/// One process's work on an output directory.
pub struct Session<'a> {
    /// The study.
    pub study: &'a Study,
    /// What of it has still to run.
    pub plan: &'a Plan,
    /// Where results go.
    pub directory: &'a mut Directory,
    /// Who works.
    pub ranks: &'a [RankInfo],
    /// The user's wish to stop.
    pub interrupt: &'a Interrupt,
    /// How progress is shown.
    pub progress: Progress,
}

impl Session<'_> {
    /// A trunk's id is that of the case whose wall stays fixed.
    pub(super) fn id(&self, work: Work) -> CaseId {
        match work {
            Work::Trunk(trunk) => CaseId::of(&self.plan.trunks[trunk].config),
            Work::Case(case) => self.study.run(self.plan.cases[case].index).id,
        }
    }

    /// A shared stretch has ended its process: from rest its cases do the same.
    pub(super) fn suspect_branches(&mut self, trunk: usize) {
        let cases = self.plan.cases.iter().filter(|case| case.trunk == Some(trunk));
        for id in cases.map(|case| self.study.run(case.index).id) {
            self.directory.attempts().suspect(id);
        }
    }
}
