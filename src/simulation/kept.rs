//! The state that a run stores from time to time, as bytes. It has all that changes. So hours of
//! work are not lost with their process.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::Monitor;
use super::state::RunState;
use crate::body::Wall;
use crate::scene::CaseConfig;

/// Stores the states of one run. It comes from [`super::Monitor::keeper`].
pub trait Keeper: Sync {
    /// The last stored state, if there is one.
    fn last(&self) -> Option<Vec<u8>>;

    /// Whether to store the state now. Asked before every step in which that is possible, and with
    /// `stopping` before a run ends on request.
    fn is_due(&self, stopping: bool) -> bool;

    /// Stores a state.
    fn keep(&self, state: Vec<u8>);

    /// The last stored state cannot be used, so the run starts again.
    fn refuse(&self, why: &str);
}

/// The number of this attempt at a case.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Attempt {
    /// How many attempts have failed before it.
    pub retry: u32,
    /// The reason of the last failure.
    pub told: Option<String>,
}

impl Attempt {
    /// The configuration that it runs: each retry has half the time step of the one before.
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
    /// Hash of the configuration that is run.
    pub hash: [u8; 32],
    pub attempt: Attempt,
    pub state: RunState,
    pub wall: Wall,
    /// The memory of the scene's observer.
    pub watch: Vec<u8>,
}

impl Kept {
    /// The state that a monitor has from an earlier run of this case.
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

/// The hash of a configuration.
pub(super) fn hash(config: &CaseConfig) -> [u8; 32] {
    let text = serde_json::to_vec(&config.without_error_bars());
    Sha256::digest(text.expect("a configuration always serialises")).into()
}
