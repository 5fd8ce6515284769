//! The scheduler: a pure state machine, events in and commands out, without clocks or files.
//!
//! - A task's priority is its longest remaining chain. For a trunk it includes the most expensive
//!   branch. So trunks start early, and branches of a finished trunk run beside other trunks.
//! - A rank takes a branch of a trunk whose checkpoint it holds. Near the end of the sweep it takes
//!   one of another trunk if that is clearly more expensive. The most expensive go first, so that
//!   all ranks end together. Checkpoints are dropped when their last branch is done. A case whose
//!   trunk failed runs from rest.
//! - The number of trunks that are open at once is at most the number of places where work can run.
//! - Each rank gets one task more than it can run, as long as there is more than enough for all.
//!
//! Every event costs time in proportion to the logarithm of the number of tasks.

mod protocol;
mod queue;
mod ranks;
#[cfg(test)]
mod tests;
mod trunk;

use std::collections::BTreeSet;

use crate::study::{Plan, PlannedCase, PlannedTrunk};
pub use protocol::{Command, Event, Held, Work};
use queue::{Queue, Ranked};
use ranks::Ranks;
use trunk::{Phase, Trunk};

/// A branch elsewhere is worth another copy of a checkpoint if it costs more by one part in this
/// many. Neighbouring wave heights of the study differ by some two percent.
const CLEARLY_DEARER: u64 = 64;
/// A sweep is near its end with this many cases left per place. They are enough to even such
/// differences out, and few enough for the copies.
const NEAR_THE_END: usize = 32;

/// Decides what runs where and when.
#[derive(Debug)]
pub struct Manager {
    trunks: Vec<Trunk>,
    cases: Vec<PlannedCase>,
    ranks: Ranks,
    /// Trunks not yet started.
    waiting: Queue,
    /// Cases that run from rest.
    solo: Queue,
    /// Trunks with a checkpoint and pending branches, by the most expensive branch when last
    /// checked.
    held: Queue,
    /// Pending branches of the trunks in `held`.
    held_branches: usize,
    open: usize,
    unfinished: usize,
    interrupted: bool,
}

impl Manager {
    /// A manager for a plan, and for ranks with these numbers of tasks at once.
    pub fn new(plan: &Plan, capacities: &[usize]) -> Manager {
        let branch = |&case: &usize| Ranked::new(plan.cases[case].branch_cost, case);
        let trunk =
            |planned: &PlannedTrunk| Trunk::new(planned.cost, planned.branches.iter().map(branch));
        let trunks: Vec<Trunk> = plan.trunks.iter().map(trunk).collect();
        let chain = |(place, trunk): (usize, &Trunk)| Ranked::new(trunk.chain(), place);
        let from_rest = plan.cases.iter().enumerate().filter(|(_, case)| case.trunk.is_none());
        Manager {
            waiting: trunks.iter().enumerate().map(chain).collect(),
            trunks,
            solo: from_rest.map(|(place, case)| Ranked::new(case.cost, place)).collect(),
            cases: plan.cases.clone(),
            ranks: Ranks::new(capacities),
            held: Queue::default(),
            held_branches: 0,
            open: 0,
            unfinished: plan.cases.len(),
            interrupted: false,
        }
    }

    /// True when nothing is running and nothing more will be started.
    pub fn finished(&self) -> bool {
        self.ranks.in_flight() == 0 && (self.unfinished == 0 || self.interrupted)
    }

    /// Cases neither done nor failed.
    pub fn unfinished(&self) -> usize {
        self.unfinished
    }

    /// Takes an event and appends what follows from it.
    pub fn on(&mut self, event: Event, commands: &mut Vec<Command>) {
        let first = match event {
            Event::Ready { rank } => {
                self.ranks.join(rank);
                Some(rank)
            }
            Event::Done { rank, work, ok } => {
                self.ranks.release(rank, work);
                match work {
                    Work::Trunk(trunk) if ok => self.hold(rank, trunk),
                    Work::Trunk(trunk) => self.give_up(trunk),
                    Work::Case(case) => self.count(case, commands),
                }
                Some(rank)
            }
            Event::GivenBack { rank, work } => {
                self.ranks.release(rank, work);
                self.interrupt(commands);
                None
            }
            Event::Interrupted => {
                self.interrupt(commands);
                None
            }
        };
        if !self.interrupted {
            self.dispatch(first, commands);
        }
    }

    /// Gives work out: first to the rank that asked, then to any rank with a free place.
    fn dispatch(&mut self, first: Option<usize>, commands: &mut Vec<Command>) {
        if let Some(rank) = first {
            while self.ranks.has_room(rank, 0) && self.assign(rank, commands) {}
        }
        while let Some(rank) = self.ranks.emptiest() {
            if !self.assign(rank, commands) {
                break;
            }
        }
        let left = self.waiting.len() + self.solo.len() + self.held_branches;
        let plenty = left > self.ranks.capacity();
        if let Some(rank) = first.filter(|&rank| plenty && self.ranks.has_room(rank, 1)) {
            self.assign(rank, commands);
        }
    }

    /// Gives the best task to a rank; false if there is none.
    fn assign(&mut self, rank: usize, commands: &mut Vec<Command>) -> bool {
        let may_open = self.open <= self.ranks.capacity() + self.ranks.len();
        let trunk = self.waiting.peek().copied().filter(|_| may_open);
        let solo = self.solo.peek().copied();
        let branch = top_held(&mut self.held, &self.trunks);
        let best = [trunk, solo, branch].into_iter().flatten().map(|entry| entry.priority).max();
        let Some(best) = best else { return false };
        if let Some(entry) = branch.filter(|entry| entry.priority == best) {
            let near_the_end = self.unfinished <= NEAR_THE_END * self.ranks.capacity();
            let enough = if near_the_end { best - best / CLEARLY_DEARER } else { 0 };
            let local = top_held(self.ranks.local(rank), &self.trunks)
                .filter(|local| local.priority >= enough);
            self.assign_branch(rank, local.unwrap_or(entry).place(), commands);
        } else if trunk.is_some_and(|entry| entry.priority == best) {
            let trunk = self.waiting.pop().expect("it was just looked at").place();
            self.trunks[trunk].phase = Phase::Running;
            self.open += 1;
            self.run(rank, Work::Trunk(trunk), None, commands);
        } else {
            let case = self.solo.pop().expect("it was just looked at").place();
            self.run(rank, Work::Case(case), None, commands);
        }
        true
    }

    fn assign_branch(&mut self, rank: usize, trunk: usize, commands: &mut Vec<Command>) {
        let state = &mut self.trunks[trunk];
        let case = state.pending.pop().expect("held trunks have pending branches").place();
        self.held_branches -= 1;
        let holder = if state.holders.contains(&rank) { rank } else { state.origin };
        if state.holders.insert(rank) {
            self.ranks.keep(rank, Ranked::new(state.dearest(), trunk));
        }
        self.run(rank, Work::Case(case), Some(Held { trunk, holder }), commands);
    }

    fn run(&mut self, rank: usize, work: Work, from: Option<Held>, commands: &mut Vec<Command>) {
        self.ranks.take(rank, work);
        commands.push(Command::Run { rank, work, from });
    }

    /// A trunk's checkpoint is there, so its branches may run.
    fn hold(&mut self, rank: usize, trunk: usize) {
        let state = &mut self.trunks[trunk];
        state.phase = Phase::Held;
        state.origin = rank;
        state.holders = BTreeSet::from([rank]);
        self.held_branches += state.pending.len();
        if let Some(branch) = state.pending.peek() {
            self.held.push(Ranked::new(branch.priority, trunk));
            self.ranks.keep(rank, Ranked::new(branch.priority, trunk));
        }
    }

    /// A trunk failed, so its cases run from rest.
    fn give_up(&mut self, trunk: usize) {
        let state = &mut self.trunks[trunk];
        state.phase = Phase::Closed;
        self.open -= 1;
        while let Some(branch) = state.pending.pop() {
            self.cases[branch.place()].trunk = None;
            self.solo.push(Ranked::new(self.cases[branch.place()].cost, branch.place()));
        }
    }

    /// A case has ended. The last branch closes its trunk.
    fn count(&mut self, case: usize, commands: &mut Vec<Command>) {
        self.unfinished -= 1;
        let Some(trunk) = self.cases[case].trunk else { return };
        let state = &mut self.trunks[trunk];
        state.unfinished -= 1;
        if state.unfinished == 0 && state.phase == Phase::Held {
            state.phase = Phase::Closed;
            self.open -= 1;
            let holders = std::mem::take(&mut state.holders);
            commands.extend(holders.into_iter().map(|rank| Command::Drop { rank, trunk }));
        }
    }

    fn interrupt(&mut self, commands: &mut Vec<Command>) {
        if !self.interrupted {
            self.interrupted = true;
            commands.push(Command::Cancel);
        }
    }
}

/// The held trunk with the most expensive pending branch. Entries are corrected when they come to
/// the top, because a trunk's most expensive branch can only become cheaper.
fn top_held(queue: &mut Queue, trunks: &[Trunk]) -> Option<Ranked> {
    while let Some(entry) = queue.peek().copied() {
        let trunk = &trunks[entry.place()];
        let dearest = trunk.pending.peek().filter(|_| trunk.phase == Phase::Held);
        match dearest {
            Some(branch) if branch.priority == entry.priority => return Some(entry),
            Some(branch) => {
                queue.pop();
                queue.push(Ranked::new(branch.priority, entry.place()));
            }
            None => {
                queue.pop();
            }
        }
    }
    None
}
