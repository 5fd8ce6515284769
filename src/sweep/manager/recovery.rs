//! Losing a rank, and what has to be done again then.

use super::queue::Entry;
use super::trunk::Phase;
use super::{Manager, Task};

impl Manager {
    /// A rank is gone: its tasks wait again, and trunks that only it held are computed again.
    pub(super) fn lose(&mut self, rank: usize) {
        let Some(tasks) = self.ranks.leave(rank) else { return };
        for trunk in 0..self.trunks.len() {
            let state = &mut self.trunks[trunk];
            state.holders.remove(&rank);
            if state.origin == rank {
                state.origin = state.holders.first().copied().unwrap_or(rank);
            }
            if state.phase == Phase::Held && state.holders.is_empty() && !state.pending.is_empty() {
                self.held_branches -= state.pending.len();
                self.wait_again(trunk);
            }
        }
        for task in tasks {
            match task {
                Task::Trunk(trunk) => self.wait_again(trunk),
                Task::Case(case) => self.requeue(case),
            }
        }
    }

    fn wait_again(&mut self, trunk: usize) {
        let state = &mut self.trunks[trunk];
        state.phase = Phase::Waiting;
        self.open -= 1;
        self.waiting.push(Entry::new(state.chain(), trunk));
    }

    fn requeue(&mut self, case: usize) {
        let planned = self.cases[case];
        let Some(trunk) = planned.trunk else {
            self.solo.push(Entry::new(planned.cost, case));
            return;
        };
        let state = &mut self.trunks[trunk];
        state.pending.push(Entry::new(planned.branch_cost, case));
        if state.phase != Phase::Held {
            return;
        }
        if state.holders.is_empty() {
            self.wait_again(trunk);
            return;
        }
        self.held_branches += 1;
        let branch = Entry::new(state.dearest(), trunk);
        self.held.push(branch);
        for &holder in &state.holders {
            self.ranks.keep(holder, branch);
        }
    }
}
