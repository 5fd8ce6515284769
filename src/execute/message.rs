//! What coordinator and workers say to each other.

use serde::{Deserialize, Serialize};

use crate::schedule::Source;
use crate::simulation::{CaseResult, Stopped};

/// From the coordinator to a worker. Configurations travel as JSON, which carries every bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Order {
    /// Run a trunk and keep its checkpoint.
    RunTrunk {
        /// Its place in the plan.
        trunk: usize,
        /// The configuration.
        config: String,
    },
    /// Run a case.
    RunCase {
        /// Its place in the plan.
        case: usize,
        /// The configuration.
        config: String,
        /// The checkpoint to start from: the trunk, and a rank that holds it.
        from: Option<(usize, usize)>,
    },
    /// Forget a checkpoint.
    Drop {
        /// The trunk.
        trunk: usize,
    },
    /// Stop what is running and give it back.
    Cancel,
}

impl Order {
    /// An order to run a case.
    pub fn run_case(case: usize, config: String, from: Option<Source>) -> Order {
        Order::RunCase { case, config, from: from.map(|source| (source.trunk, source.holder)) }
    }
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
