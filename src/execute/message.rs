//! What coordinator and workers say to each other.

use serde::{Deserialize, Serialize};

use crate::results::Delivery;
use crate::schedule::{Held, Work};
use crate::simulation::{Limits, Stopped};
use crate::study::CaseId;

/// From the coordinator to a worker.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Order {
    /// Do a piece of work. Its configuration is JSON, which carries every bit; the last is the
    /// checkpoint to start from. `apart`: in a process of its own, as an earlier one may have died of it.
    /// `files`: the name of the files that it leaves; a companion leaves none.
    Run {
        work: Work,
        config: String,
        from: Option<Held>,
        apart: bool,
        limits: Limits,
        files: Option<CaseId>,
    },
    /// Forget a checkpoint.
    Drop { trunk: usize },
    /// Stop what is running and give it back.
    Cancel,
}

/// From a worker to the coordinator; numbers are places in the plan.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Report {
    /// A trunk ended, after so many steps or why not; its checkpoint stays where it is.
    TrunkDone { trunk: usize, result: Result<u64, Stopped>, wall_time_s: f64 },
    /// A case ended; its processor time is there where the system tells it.
    CaseDone {
        case: usize,
        result: Result<Delivery, Stopped>,
        wall_time_s: f64,
        cpu_time_s: Option<f64>,
    },
    /// This rank received a signal to stop.
    Interrupted,
}

impl Report {
    /// What has ended.
    pub fn work(&self) -> Option<Work> {
        match *self {
            Report::TrunkDone { trunk, .. } => Some(Work::Trunk(trunk)),
            Report::CaseDone { case, .. } => Some(Work::Case(case)),
            Report::Interrupted => None,
        }
    }
}
