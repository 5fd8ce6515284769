//! What a run keeps of itself, now and then, so that hours of work outlive their process: all that changes, as
//! bytes.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::Monitor;
use super::state::RunState;
use crate::body::Wall;
use crate::scene::CaseConfig;

/// Keeps the states of one run. [`super::Monitor::keeper`] hands it over.
pub trait Keeper: Sync {
    /// The state that was kept last, where there is one.
    fn last(&self) -> Option<Vec<u8>>;

    /// Whether to keep the state now. Asked ahead of every step in which that can be done, and with
    /// `stopping` before a run ends because it was told to.
    fn is_due(&self, stopping: bool) -> bool;

    /// Takes a state.
    fn keep(&self, state: Vec<u8>);

    /// The state that was kept last cannot be gone on from: the run starts over.
    fn refuse(&self, why: &str);
}

/// Which attempt at its case a run is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Attempt {
    /// How many have failed before it.
    pub retry: u32,
    /// What became of the last of them.
    pub told: Option<String>,
}

impl Attempt {
    /// What it runs: each retry has half the time step of the one before.
    pub fn config(&self, case: &CaseConfig) -> CaseConfig {
        match self.retry {
            0 => case.clone(),
            retry => case.with_time_step_scaled(0.5_f64.powi(retry as i32)),
        }
    }
}

/// Everything that changes in a run.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Kept {
    /// Of the configuration that is run.
    pub hash: [u8; 32],
    pub attempt: Attempt,
    pub state: RunState,
    pub wall: Wall,
    /// What the observer of the scene remembers.
    pub watch: Vec<u8>,
}

impl Kept {
    /// The state that a monitor has of an earlier run of this case.
    pub fn of(case: &CaseConfig, monitor: &dyn Monitor) -> Option<Kept> {
        let keeper = monitor.keeper()?;
        let bytes = keeper.last()?;
        match postcard::from_bytes::<Kept>(&bytes) {
            Ok(kept) if kept.hash == hash(&kept.attempt.config(case)) => Some(kept),
            Ok(_) => {
                keeper.refuse("it belongs to another case");
                None
            }
            Err(error) => {
                keeper.refuse(&error.to_string());
                None
            }
        }
    }
}

/// Names a configuration.
pub(super) fn hash(config: &CaseConfig) -> [u8; 32] {
    let text = serde_json::to_vec(&config.without_error_bars());
    Sha256::digest(text.expect("a configuration always serialises")).into()
}
