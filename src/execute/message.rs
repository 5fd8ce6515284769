//! What coordinator and workers say to each other.

use serde::{Deserialize, Serialize};

use crate::schedule::{Held, Work};
use crate::simulation::{CaseResult, Stopped};

/// From the coordinator to a worker.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Order {
    /// Do a piece of work.
    Run {
        /// Which.
        work: Work,
        /// Its configuration in JSON, which carries every bit.
        config: String,
        /// The checkpoint to start from.
        from: Option<Held>,
    },
    /// Forget a checkpoint.
    Drop {
        /// The trunk.
        trunk: usize,
    },
    /// Stop what is running and give it back.
    Cancel,
}

/// From a worker to the coordinator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Report {
    /// A trunk ended; its checkpoint stays where it is.
    TrunkDone {
        /// Its place in the plan.
        trunk: usize,
        /// Steps taken, or why not.
        result: Result<u64, Stopped>,
    },
    /// A case ended.
    CaseDone {
        /// Its place in the plan.
        case: usize,
        /// Its result, or why there is none.
        result: Result<Box<CaseResult>, Stopped>,
        /// Wall time, seconds.
        wall_time_s: f64,
        /// Processor time, seconds, where the system tells it.
        cpu_time_s: Option<f64>,
    },
    /// This rank received a signal to stop.
    Interrupted,
}
