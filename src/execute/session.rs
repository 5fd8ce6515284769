//! The work of one process on an output directory, and how it ended.

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
    /// The user stopped it, and cases are left.
    #[default]
    Interrupted,
}

/// The result of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Worked {
    /// How it ended.
    pub ending: Ending,
    /// The work saved by branching.
    pub savings: Savings,
    /// The load of each rank.
    pub load: Load,
}

/// The work of one process on an output directory.
pub struct Session<'a> {
    /// The study.
    pub study: &'a Study,
    /// The work that is left.
    pub plan: &'a Plan,
    /// Where results go.
    pub directory: &'a mut Directory,
    /// The ranks.
    pub ranks: &'a [RankInfo],
    /// The user's request to stop.
    pub interrupt: &'a Interrupt,
    /// How progress is shown.
    pub progress: Progress,
}

impl Session<'_> {
    /// A trunk's id is that of the case with a fixed wall.
    pub(super) fn id(&self, work: Work) -> CaseId {
        match work {
            Work::Trunk(trunk) => CaseId::of(&self.plan.trunks[trunk].config),
            Work::Case(case) => self.study.run(self.plan.cases[case].index).id,
        }
    }

    /// A trunk has ended its process. From rest its cases would do the same.
    pub(super) fn suspect_branches(&mut self, trunk: usize) {
        let cases = self.plan.cases.iter().filter(|case| case.trunk == Some(trunk));
        for id in cases.map(|case| self.study.run(case.index).id) {
            self.directory.attempts().suspect(id);
        }
    }
}
