//! What the manager is told, and what it tells.

use serde::{Deserialize, Serialize};

/// A piece of work, by its place in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Work {
    /// A trunk, which leaves a checkpoint on the rank that runs it.
    Trunk(usize),
    /// A case.
    Case(usize),
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// A rank can take work.
    Ready {
        /// The rank.
        rank: usize,
    },
    /// A trunk ended, or a case ended and is recorded.
    Done {
        /// The rank.
        rank: usize,
        /// The work.
        work: Work,
        /// Whether it went well: a trunk has a checkpoint then.
        ok: bool,
    },
    /// A rank gave work back because it was told to stop.
    GivenBack {
        /// The rank.
        rank: usize,
        /// The work.
        work: Work,
    },
    /// The user wants to stop.
    Interrupted,
}

/// Where a branch finds its checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Held {
    /// The trunk.
    pub trunk: usize,
    /// A rank that holds its checkpoint.
    pub holder: usize,
}

/// What is to be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Do a piece of work.
    Run {
        /// Where.
        rank: usize,
        /// Which.
        work: Work,
        /// The checkpoint that a case starts from; it starts from rest where there is none.
        from: Option<Held>,
    },
    /// Forget a checkpoint.
    Drop {
        /// Where.
        rank: usize,
        /// Which.
        trunk: usize,
    },
    /// Stop all that runs and give it back.
    Cancel,
}
