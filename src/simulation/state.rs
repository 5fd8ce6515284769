//! What changes in a run while its wall stands.

use serde::{Deserialize, Serialize};

use super::logbook::Logbook;
use super::looks::Looks;
use crate::scheme::SchemeState;

/// Everything that changes in a trunk. It ends before its wall moves, so the wall is not among it; `Kept` has
/// what else a case keeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RunState {
    pub(super) water: SchemeState,
    pub(super) clock: Clock,
    pub(super) logbook: Logbook,
}

impl RunState {
    /// Simulated seconds and steps so far.
    pub fn progress(&self) -> (f64, u64) {
        (self.clock.time, self.clock.steps)
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    pub(super) time: f64,
    pub(super) steps: u64,
    /// Of the history.
    pub(super) samples: u64,
    /// At the water's health.
    pub(super) looks: Looks,
}
