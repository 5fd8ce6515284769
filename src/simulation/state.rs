//! The state of a run while its wall stands, also as a checkpoint: bytes that belong to one trunk.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::failure::{Failure, FailureKind};
use super::logbook::Logbook;
use super::looks::Looks;
use crate::scene::CaseConfig;
use crate::scheme::SchemeState;

/// All that changes in a trunk. A trunk ends before its wall moves, so the wall is not part of it.
/// `Kept` has the rest of a case's state.
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
    /// Number of history samples.
    pub(super) samples: u64,
    /// Looks at the water's health.
    pub(super) looks: Looks,
}

/// Length of a hash.
const HASH: usize = 32;

/// The bytes of a state, behind the hash of its trunk and their own. Their layout is that of the
/// build: files of other builds are refused by what stands before the state, and ranks all have one
/// build.
pub(super) fn encode(state: &RunState, config: &CaseConfig) -> Vec<u8> {
    let room = [trunk_hash(config), [0; HASH]].concat();
    let mut bytes = postcard::to_extend(state, room).expect("a state always serialises");
    let (marks, state) = bytes.split_at_mut(2 * HASH);
    marks[HASH..].copy_from_slice(&Sha256::digest(state));
    bytes
}

/// Reads a state back.
///
/// # Errors
/// Another trunk, or damaged bytes.
pub(super) fn decode(bytes: &[u8], config: &CaseConfig) -> Result<RunState, Failure> {
    let unreadable = |detail: &str| Failure {
        kind: FailureKind::CheckpointUnreadable,
        time_s: 0.0,
        detail: detail.to_owned(),
    };
    let (marks, state) = bytes
        .split_at_checked(2 * HASH)
        .ok_or_else(|| unreadable("the checkpoint is cut short"))?;
    let (trunk, own) = marks.split_at(HASH);
    if trunk != trunk_hash(config) {
        return Err(unreadable("the checkpoint belongs to another trunk"));
    }
    // A state that does not fit together would end the process.
    if own != Sha256::digest(state).as_slice() {
        return Err(unreadable("the checkpoint is damaged"));
    }
    postcard::from_bytes(state).map_err(|error| unreadable(&error.to_string()))
}

fn trunk_hash(config: &CaseConfig) -> [u8; HASH] {
    let trunk = config.trunk().unwrap_or_else(|| config.clone());
    let text = serde_json::to_vec(&trunk).expect("a configuration always serialises");
    Sha256::digest(text).into()
}
