//! One case from start to end: [`run_case`], or its shared first stretch: [`run_trunk`].

mod failure;
mod outcome;

pub use failure::{Failure, FailureKind, Stopped};
pub use outcome::{
    CaseResult, EnergyBudget, HistoryRow, Maximum, Outcome, PhaseShare, ProbeTable, TrunkResult,
};

use crate::math::simd::SimdPath;
use crate::scene::CaseConfig;

/// Watches a run and may end it.
pub trait Monitor: Sync {
    /// Called every few steps with the share of the simulated time done, 0 to 1.
    fn progress(&self, _share: f64) {}
    /// True when the run should stop at the next step.
    fn cancelled(&self) -> bool {
        false
    }
}

/// A monitor that never interferes.
pub struct Unwatched;

impl Monitor for Unwatched {}

/// What a case will take, estimated before it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Fluid particles.
    pub particles: u64,
    /// Steps from rest to the end.
    pub steps: u64,
    /// Share of the steps before the wall can move (0 where the scene does not branch).
    pub trunk_share: f64,
    /// Peak memory of a run, bytes.
    pub memory_bytes: u64,
}

/// Estimates a case's cost.
pub fn cost(_config: &CaseConfig) -> Cost {
    todo!()
}

/// Runs a case to its end, from rest or from its trunk's checkpoint: the same bits either way.
pub fn run_case(
    _config: &CaseConfig,
    _checkpoint: Option<&[u8]>,
    _simd: SimdPath,
    _monitor: &dyn Monitor,
) -> Result<CaseResult, Stopped> {
    todo!()
}

/// Runs a trunk ([`CaseConfig::trunk`]) to the last step before the force first exceeds the
/// threshold.
pub fn run_trunk(
    _config: &CaseConfig,
    _simd: SimdPath,
    _monitor: &dyn Monitor,
) -> Result<TrunkResult, Stopped> {
    todo!()
}
