//! The ranks, and the work of each.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use super::protocol::Work;
use super::queue::{Queue, Ranked};

#[derive(Debug)]
struct Rank {
    /// The number of tasks that it runs at once.
    capacity: usize,
    joined: bool,
    tasks: Vec<Work>,
    /// Trunks held here, by the most expensive pending branch when last checked.
    local: Queue,
}

/// All ranks, with the tasks that they were given.
#[derive(Debug)]
pub(super) struct Ranks {
    all: Vec<Rank>,
    /// Ranks with free places, the emptiest first.
    free: BTreeSet<(Reverse<usize>, usize)>,
    capacity: usize,
    in_flight: usize,
}

impl Ranks {
    /// Ranks that have not joined yet, with these numbers of tasks at once.
    pub fn new(capacities: &[usize]) -> Ranks {
        let rank = |&capacity: &usize| Rank {
            capacity: capacity.max(1),
            joined: false,
            tasks: Vec::new(),
            local: Queue::default(),
        };
        let all: Vec<Rank> = capacities.iter().map(rank).collect();
        let capacity = all.iter().map(|rank| rank.capacity).sum();
        Ranks { all, free: BTreeSet::new(), capacity, in_flight: 0 }
    }

    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// How many tasks can run at once.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Works given out and not yet reported.
    pub fn in_flight(&self) -> usize {
        self.in_flight
    }

    /// A rank can take work.
    pub fn join(&mut self, rank: usize) {
        self.all[rank].joined = true;
        self.offer(rank);
    }

    /// The rank with the most free places.
    pub fn emptiest(&self) -> Option<usize> {
        self.free.first().map(|&(_, rank)| rank)
    }

    /// Whether a rank that has joined has fewer tasks than it can run plus `more`.
    pub fn has_room(&self, rank: usize, more: usize) -> bool {
        let state = &self.all[rank];
        state.joined && state.tasks.len() < state.capacity + more
    }

    pub fn take(&mut self, rank: usize, work: Work) {
        self.withdraw(rank);
        self.in_flight += 1;
        self.all[rank].tasks.push(work);
        self.offer(rank);
    }

    pub fn release(&mut self, rank: usize, work: Work) {
        self.withdraw(rank);
        let tasks = &mut self.all[rank].tasks;
        let place = tasks.iter().position(|&held| held == work);
        tasks.swap_remove(place.expect("a rank reports only tasks that it was given"));
        self.in_flight -= 1;
        self.offer(rank);
    }

    /// A rank holds a trunk's checkpoint. `branch` is its most expensive pending branch.
    pub fn keep(&mut self, rank: usize, branch: Ranked) {
        self.all[rank].local.push(branch);
    }

    /// The trunks that a rank holds.
    pub fn local(&mut self, rank: usize) -> &mut Queue {
        &mut self.all[rank].local
    }

    fn offer(&mut self, rank: usize) {
        if self.has_room(rank, 0) {
            self.free.insert(self.place(rank));
        }
    }

    fn withdraw(&mut self, rank: usize) {
        self.free.remove(&self.place(rank));
    }

    fn place(&self, rank: usize) -> (Reverse<usize>, usize) {
        let state = &self.all[rank];
        (Reverse(state.capacity.saturating_sub(state.tasks.len())), rank)
    }
}
