//! A priority queue of indices in the plan: the most expensive first, then in grid order.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Entries by priority, then by place.
pub(super) type Queue = BinaryHeap<Ranked>;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ranked {
    pub(super) priority: u64,
    place: Reverse<usize>,
}

impl Ranked {
    pub(super) fn new(priority: u64, place: usize) -> Ranked {
        Ranked { priority, place: Reverse(place) }
    }

    pub(super) fn place(self) -> usize {
        self.place.0
    }
}
