//! The events and commands of the manager.

use serde::{Deserialize, Serialize};

/// A piece of work, by its place in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Work {
    /// A trunk, which leaves a checkpoint on the rank that runs it.
    Trunk(usize),
    /// A case.
    Case(usize),
}

/// An event.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// A rank can take work.
    Ready { rank: usize },
    /// A trunk ended, or a case ended and is recorded. A trunk that is `ok` has left a checkpoint.
    Done { rank: usize, work: Work, ok: bool },
    /// A rank returned work because it had to stop.
    GivenBack { rank: usize, work: Work },
    /// The user wants to stop.
    Interrupted,
}

/// The place of a branch's checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Held {
    /// The trunk.
    pub trunk: usize,
    /// A rank that holds its checkpoint.
    pub holder: usize,
}

/// A command.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Do a piece of work. A case starts from the checkpoint, or from rest without one.
    Run { rank: usize, work: Work, from: Option<Held> },
    /// Forget a checkpoint.
    Drop { rank: usize, trunk: usize },
    /// Stop all running work and return it.
    Cancel,
}
