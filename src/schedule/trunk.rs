//! The state of a trunk, and its remaining branches.

use std::collections::BTreeSet;

use super::queue::{Queue, Ranked};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    Waiting,
    Running,
    Held,
    Closed,
}

#[derive(Debug)]
pub(super) struct Trunk {
    pub(super) phase: Phase,
    pub(super) cost: u64,
    /// Branches not yet handed out.
    pub(super) pending: Queue,
    /// Branches not yet done.
    pub(super) unfinished: usize,
    /// The rank that ran it.
    pub(super) origin: usize,
    pub(super) holders: BTreeSet<usize>,
}

impl Trunk {
    /// One that has not started.
    pub fn new(cost: u64, branches: impl IntoIterator<Item = Ranked>) -> Trunk {
        let pending: Queue = branches.into_iter().collect();
        let unfinished = pending.len();
        let phase = Phase::Waiting;
        Trunk { phase, cost, pending, unfinished, origin: 0, holders: BTreeSet::new() }
    }

    /// Its own cost and that of its dearest branch.
    pub fn chain(&self) -> u64 {
        self.cost.saturating_add(self.dearest())
    }

    /// The cost of its most expensive pending branch.
    pub fn dearest(&self) -> u64 {
        self.pending.peek().map_or(0, |branch| branch.priority)
    }
}
