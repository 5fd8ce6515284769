//! What the manager is told, and what it tells.

use serde::{Deserialize, Serialize};

/// A piece of work, by its place in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Work {
    /// A trunk, which leaves a checkpoint on the rank that runs it.
    Trunk(usize),
    /// A case.
    Case(usize),
}

/// What happened.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// A rank can take work.
    Ready { rank: usize },
    /// A trunk ended, or a case ended and is recorded. A trunk that is `ok` has left a checkpoint.
    Done { rank: usize, work: Work, ok: bool },
    /// A rank gave work back because it was told to stop.
    GivenBack { rank: usize, work: Work },
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
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Do a piece of work; a case starts from the checkpoint, or from rest where there is none.
    Run { rank: usize, work: Work, from: Option<Held> },
    /// Forget a checkpoint.
    Drop { rank: usize, trunk: usize },
    /// Stop all that runs and give it back.
    Cancel,
}
