//! What the manager is told, and what it tells.

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// A rank can take work.
    Ready {
        /// The rank.
        rank: usize,
    },
    /// A trunk ended; its checkpoint, if any, stays on the rank.
    TrunkDone {
        /// The rank that ran it.
        rank: usize,
        /// Its place in the plan.
        trunk: usize,
        /// Whether there is a checkpoint.
        ok: bool,
    },
    /// A case ended, well or not, and is recorded.
    CaseDone {
        /// The rank that ran it.
        rank: usize,
        /// Its place in the plan.
        case: usize,
    },
    /// A rank gave a task back because it was told to stop.
    GivenBack {
        /// The rank.
        rank: usize,
        /// The task.
        task: Task,
    },
    /// The user wants to stop.
    Interrupted,
}

/// Where a branch finds its checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Source {
    /// The trunk.
    pub trunk: usize,
    /// A rank that holds its checkpoint.
    pub holder: usize,
}

/// What is to be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Run a trunk and keep its checkpoint.
    RunTrunk {
        /// Where.
        rank: usize,
        /// Which.
        trunk: usize,
    },
    /// Run a case.
    RunCase {
        /// Where.
        rank: usize,
        /// Which.
        case: usize,
        /// From this checkpoint, or from rest.
        from: Option<Source>,
    },
    /// Forget a checkpoint.
    Drop {
        /// Where.
        rank: usize,
        /// Which.
        trunk: usize,
    },
    /// Stop all running tasks and give them back.
    Cancel,
}

/// A piece of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// A trunk, by its place in the plan.
    Trunk(usize),
    /// A case, by its place in the plan.
    Case(usize),
}
