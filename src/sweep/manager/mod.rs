//! The scheduler: a pure state machine, events in and commands out, without clocks or files.
//!
//! - A task's priority is its longest remaining chain: a trunk counts with its dearest branch, so
//!   trunks start early and branches of a finished trunk run beside other trunks.
//! - A rank takes a branch of a trunk whose checkpoint it holds. Towards the end of the sweep it takes
//!   one from elsewhere if that is clearly dearer: the dearest go first, so that all ranks end
//!   together. Checkpoints are dropped when their last branch is done. A case whose trunk failed
//!   runs from rest instead.
//! - The number of trunks open at once is bounded by the number of places where work can run.
//! - Each rank gets one task beyond its capacity while there is more than enough for everybody.
//!
//! Every event costs the logarithm of the number of tasks.

mod protocol;
mod queue;
mod recovery;
#[cfg(test)]
mod tests;

use std::cmp::Reverse;
use std::collections::BTreeSet;

use super::plan::Plan;
pub use protocol::{Command, Event, Source, Task};
use queue::{Entry, Queue};

/// A branch elsewhere is worth another copy of a checkpoint where it is dearer by more than this
/// part of its cost: neighbouring wave heights of the study differ by two percent or so.
const CLEARLY_DEARER: u64 = 64;
/// The end of a sweep begins with so many cases left per place: enough for such differences to be
/// evened out, and few enough for the copies.
const NEAR_THE_END: usize = 32;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Waiting,
    Running,
    Held,
    Closed,
}

#[derive(Debug)]
struct Trunk {
    phase: Phase,
    cost: u64,
    /// Branches not yet handed out.
    pending: Queue,
    /// Branches not yet done.
    unfinished: usize,
    /// The rank that ran it, while that rank is there.
    origin: usize,
    holders: BTreeSet<usize>,
}

impl Trunk {
    fn chain(&self) -> u64 {
        self.cost.saturating_add(self.pending.top().map_or(0, |branch| branch.priority))
    }
}

#[derive(Debug)]
struct Rank {
    capacity: usize,
    alive: bool,
    tasks: Vec<Task>,
    /// Trunks held here, by their dearest pending branch when last looked at.
    local: Queue,
}

/// Decides what runs where and when.
#[derive(Debug)]
pub struct Manager {
    trunks: Vec<Trunk>,
    cases: Vec<super::plan::PlannedCase>,
    ranks: Vec<Rank>,
    /// Trunks not yet started.
    waiting: Queue,
    /// Cases that run from rest.
    solo: Queue,
    /// Trunks with a checkpoint and pending branches, by their dearest one when last looked at.
    held: Queue,
    /// Pending branches of the trunks in `held`.
    held_branches: usize,
    /// Ranks with free places, the emptiest first.
    free: BTreeSet<(Reverse<usize>, usize)>,
    capacity: usize,
    open: usize,
    unfinished: usize,
    in_flight: usize,
    interrupted: bool,
}

impl Manager {
    /// A manager for a plan and for ranks that each run so many tasks at once.
    pub fn new(plan: &Plan, capacities: &[usize]) -> Manager {
        let mut waiting = Vec::with_capacity(plan.trunks.len());
        let mut trunks = Vec::with_capacity(plan.trunks.len());
        for (place, planned) in plan.trunks.iter().enumerate() {
            let branch = |&case: &usize| Entry::new(plan.cases[case].branch_cost, case);
            let pending: Queue = planned.branches.iter().map(branch).collect();
            let unfinished = planned.branches.len();
            let (origin, holders) = (0, BTreeSet::new());
            let phase = Phase::Waiting;
            let trunk = Trunk { phase, cost: planned.cost, pending, unfinished, origin, holders };
            waiting.push(Entry::new(trunk.chain(), place));
            trunks.push(trunk);
        }
        let from_rest = plan.cases.iter().enumerate().filter(|(_, case)| case.trunk.is_none());
        let rank = |&capacity: &usize| Rank {
            capacity: capacity.max(1),
            alive: false,
            tasks: Vec::new(),
            local: Queue::default(),
        };
        Manager {
            trunks,
            solo: from_rest.map(|(place, case)| Entry::new(case.cost, place)).collect(),
            cases: plan.cases.clone(),
            ranks: capacities.iter().map(rank).collect(),
            waiting: waiting.into_iter().collect(),
            held: Queue::default(),
            held_branches: 0,
            free: BTreeSet::new(),
            capacity: capacities.iter().map(|&capacity| capacity.max(1)).sum(),
            open: 0,
            unfinished: plan.cases.len(),
            in_flight: 0,
            interrupted: false,
        }
    }

    /// True when nothing is running and nothing more will be started.
    pub fn finished(&self) -> bool {
        self.in_flight == 0 && (self.unfinished == 0 || self.interrupted)
    }

    /// Cases neither done nor failed.
    pub fn unfinished(&self) -> usize {
        self.unfinished
    }

    /// Trunks that are running or whose checkpoint is held.
    pub fn open_trunks(&self) -> usize {
        self.open
    }

    /// Takes an event and appends what follows from it.
    pub fn on(&mut self, event: Event, commands: &mut Vec<Command>) {
        let first = match event {
            Event::Ready { rank } => {
                self.ranks[rank].alive = true;
                self.refresh(rank);
                Some(rank)
            }
            Event::TrunkDone { rank, trunk, ok } => {
                self.release(rank, Task::Trunk(trunk));
                if ok {
                    self.hold(rank, trunk)
                } else {
                    self.give_up(trunk)
                }
                Some(rank)
            }
            Event::CaseDone { rank, case } => {
                self.release(rank, Task::Case(case));
                self.unfinished -= 1;
                self.count_branch(case, commands);
                Some(rank)
            }
            Event::GivenBack { rank, task } => {
                self.release(rank, task);
                self.interrupt(commands);
                None
            }
            Event::Lost { rank } => {
                self.lose(rank);
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

    /// Gives work out: first to the rank that asked, then to whoever has a free place.
    fn dispatch(&mut self, first: Option<usize>, commands: &mut Vec<Command>) {
        if let Some(rank) = first {
            let places = self.ranks[rank].capacity;
            while self.ranks[rank].tasks.len() < places && self.assign(rank, commands) {}
        }
        while let Some(&(_, rank)) = self.free.first() {
            if !self.assign(rank, commands) {
                break;
            }
        }
        if let Some(rank) = first {
            let places = self.ranks[rank].capacity + 1;
            let plenty = self.waiting.len() + self.solo.len() + self.held_branches > self.capacity;
            if plenty && self.ranks[rank].tasks.len() < places {
                self.assign(rank, commands);
            }
        }
    }

    /// Hands the best task to a rank; false where there is none.
    fn assign(&mut self, rank: usize, commands: &mut Vec<Command>) -> bool {
        if !self.ranks[rank].alive {
            return false;
        }
        let may_open = self.open <= self.capacity + self.ranks.len();
        let trunk = self.waiting.top().filter(|_| may_open);
        let solo = self.solo.top();
        let branch = top_held(&mut self.held, &self.trunks);
        let best = [trunk, solo, branch].into_iter().flatten().map(|entry| entry.priority).max();
        let Some(best) = best else { return false };
        if let Some(entry) = branch.filter(|entry| entry.priority == best) {
            let near_the_end = self.unfinished <= NEAR_THE_END * self.capacity;
            let enough = if near_the_end { best - best / CLEARLY_DEARER } else { 0 };
            let local = top_held(&mut self.ranks[rank].local, &self.trunks)
                .filter(|local| local.priority >= enough);
            self.assign_branch(rank, local.unwrap_or(entry).place, commands);
        } else if trunk.is_some_and(|entry| entry.priority == best) {
            let trunk = self.waiting.pop().expect("it was just looked at").place;
            self.trunks[trunk].phase = Phase::Running;
            self.open += 1;
            self.take(rank, Task::Trunk(trunk));
            commands.push(Command::RunTrunk { rank, trunk });
        } else {
            let case = self.solo.pop().expect("it was just looked at").place;
            self.take(rank, Task::Case(case));
            commands.push(Command::RunCase { rank, case, from: None });
        }
        true
    }

    fn assign_branch(&mut self, rank: usize, trunk: usize, commands: &mut Vec<Command>) {
        let state = &mut self.trunks[trunk];
        let case = state.pending.pop().expect("held trunks have pending branches").place;
        self.held_branches -= 1;
        let holder = if state.holders.contains(&rank) { rank } else { state.origin };
        if state.holders.insert(rank) {
            let chain = state.pending.top().map_or(0, |entry| entry.priority);
            self.ranks[rank].local.push(Entry::new(chain, trunk));
        }
        self.take(rank, Task::Case(case));
        commands.push(Command::RunCase { rank, case, from: Some(Source { trunk, holder }) });
    }

    fn take(&mut self, rank: usize, task: Task) {
        self.in_flight += 1;
        self.forget_free(rank);
        self.ranks[rank].tasks.push(task);
        self.refresh(rank);
    }

    fn release(&mut self, rank: usize, task: Task) {
        let tasks = &mut self.ranks[rank].tasks;
        let place = tasks.iter().position(|&held| held == task);
        let place = place.expect("a rank reports only tasks that it was given");
        self.forget_free(rank);
        self.ranks[rank].tasks.swap_remove(place);
        self.in_flight -= 1;
        self.refresh(rank);
    }

    fn forget_free(&mut self, rank: usize) {
        let state = &self.ranks[rank];
        let places = state.capacity.saturating_sub(state.tasks.len());
        self.free.remove(&(Reverse(places), rank));
    }

    fn refresh(&mut self, rank: usize) {
        let state = &self.ranks[rank];
        let places = state.capacity.saturating_sub(state.tasks.len());
        if state.alive && places > 0 {
            self.free.insert((Reverse(places), rank));
        }
    }

    /// A trunk's checkpoint is there: its branches may run.
    fn hold(&mut self, rank: usize, trunk: usize) {
        let state = &mut self.trunks[trunk];
        state.phase = Phase::Held;
        state.origin = rank;
        state.holders = BTreeSet::from([rank]);
        self.held_branches += state.pending.len();
        if let Some(branch) = state.pending.top() {
            self.held.push(Entry::new(branch.priority, trunk));
            self.ranks[rank].local.push(Entry::new(branch.priority, trunk));
        }
    }

    /// A trunk failed: its cases run from rest, each to its own end.
    fn give_up(&mut self, trunk: usize) {
        let state = &mut self.trunks[trunk];
        state.phase = Phase::Closed;
        self.open -= 1;
        while let Some(branch) = state.pending.pop() {
            self.cases[branch.place].trunk = None;
            self.solo.push(Entry::new(self.cases[branch.place].cost, branch.place));
        }
    }

    /// One branch less: the last one closes its trunk.
    fn count_branch(&mut self, case: usize, commands: &mut Vec<Command>) {
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

/// The held trunk with the dearest pending branch. Entries are put right when they come to the
/// top: a trunk's dearest branch only gets cheaper, except where a requeued one brings a new entry.
fn top_held(queue: &mut Queue, trunks: &[Trunk]) -> Option<Entry> {
    while let Some(entry) = queue.top() {
        let trunk = &trunks[entry.place];
        let dearest = trunk.pending.top().filter(|_| trunk.phase == Phase::Held);
        match dearest {
            Some(branch) if branch.priority == entry.priority => return Some(entry),
            Some(branch) => {
                queue.pop();
                queue.push(Entry::new(branch.priority, entry.place));
            }
            None => {
                queue.pop();
            }
        }
    }
    None
}
