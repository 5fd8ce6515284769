//! How a run stores its state, and goes on from one.

use super::Monitor;
use super::absorption::Absorption;
use super::failure::{Failure, FailureKind};
use super::kept::{Kept, hash};
use super::run::Run;
use super::state::RunState;
use crate::body::BodyMotion;

impl Run {
    /// Goes back to a stored state in which the wall has not moved.
    pub fn restore(&mut self, state: RunState) {
        self.tank.water.restore(state.water);
        self.clock = state.clock;
        self.logbook = state.logbook;
        self.tank.added =
            self.logbook.absorption.as_ref().map_or(BodyMotion::default(), Absorption::added);
    }

    /// Goes on from the state that an earlier run of the same case has stored.
    pub fn take_up(&mut self, kept: Kept) -> Result<(), Failure> {
        self.restore(kept.state);
        self.tank.wall = kept.wall;
        let recalled = self.watch.as_mut().map_or(Ok(()), |watch| watch.recall(&kept.watch));
        recalled.map_err(|error| self.failure(FailureKind::CheckpointUnreadable, error.to_string()))
    }

    /// The state that is needed to go on while the wall has not moved.
    pub fn state(&self) -> RunState {
        RunState {
            water: self.tank.water.state(),
            clock: self.clock,
            logbook: self.logbook.clone(),
        }
    }

    /// Stores the state if that is due.
    pub fn keep(&self, monitor: &dyn Monitor, stopping: bool) {
        let Some(keeper) = monitor.keeper() else { return };
        if !self.tank.water.can_be_kept() || !keeper.is_due(stopping) {
            return;
        }
        let kept = Kept {
            hash: hash(&self.config),
            attempt: self.attempt.clone(),
            state: self.state(),
            wall: self.tank.wall,
            watch: self.watch.as_ref().map_or_else(Vec::new, |watch| watch.memory()),
        };
        keeper.keep(postcard::to_stdvec(&kept).expect("a state always serialises"));
    }
}
