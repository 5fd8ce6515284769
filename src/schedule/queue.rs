//! A priority queue of places in the plan, the dearest first, then in grid order.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ranked {
    pub(super) priority: u64,
    pub(super) place: usize,
}

impl Ranked {
    pub(super) fn new(priority: u64, place: usize) -> Ranked {
        Ranked { priority, place }
    }
}

/// Entries by priority, then by place.
#[derive(Debug, Default)]
pub(super) struct Queue(BinaryHeap<(u64, Reverse<usize>)>);

impl Queue {
    pub(super) fn push(&mut self, entry: Ranked) {
        self.0.push((entry.priority, Reverse(entry.place)));
    }

    pub(super) fn top(&self) -> Option<Ranked> {
        self.0.peek().map(|&(priority, Reverse(place))| Ranked { priority, place })
    }

    pub(super) fn pop(&mut self) -> Option<Ranked> {
        self.0.pop().map(|(priority, Reverse(place))| Ranked { priority, place })
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }
}

impl FromIterator<Ranked> for Queue {
    fn from_iter<T: IntoIterator<Item = Ranked>>(entries: T) -> Queue {
        let pairs = entries.into_iter().map(|entry| (entry.priority, Reverse(entry.place)));
        Queue(pairs.collect())
    }
}
