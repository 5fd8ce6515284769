//! Reasons for which a case could not be finished.

use serde::{Deserialize, Serialize};

use crate::math::name::name_of;

/// The kind of a failure, stable text in `summary.csv` and the journal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FailureKind {
    /// A velocity, density or force is not a number.
    NotANumber,
    /// A particle is faster than any wave of the scene could make it.
    RunawaySpeed,
    /// The density left its bound.
    DensityOutOfBounds,
    /// Too many particles left the tank.
    ParticlesLost,
    /// Energy came from nowhere.
    EnergyGrowth,
    /// Force and pressure on the wall's face differed for long: voids at the wall.
    ForceGap,
    /// Particles have formed clusters.
    Clustering,
    /// The wall's motion diverged.
    WallUnstable,
    /// The pressure equation was not solved.
    SolverDiverged,
    /// The scene cannot be built from its values.
    InvalidScene,
    /// A checkpoint could not be read back.
    CheckpointUnreadable,
    /// The program itself failed (a caught panic).
    Internal,
    /// The process that ran it was ended: out of memory, a stack overflow, a signal.
    EndedTheProcess,
    /// It takes more than `[limits]` allows.
    OverLimit,
}

impl FailureKind {
    /// Whether smaller time steps may help: true if the computation became unstable, false if the
    /// program failed.
    pub fn is_instability(self) -> bool {
        !matches!(
            self,
            FailureKind::InvalidScene
                | FailureKind::CheckpointUnreadable
                | FailureKind::Internal
                | FailureKind::EndedTheProcess
                | FailureKind::OverLimit
        )
    }
}

/// A case that failed: what happened, when, and where.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[error("{} at t = {time_s:.4} s: {detail}", name_of(kind))]
pub struct Failure {
    /// What happened.
    pub kind: FailureKind,
    /// Simulated time, seconds.
    pub time_s: f64,
    /// One line for a human: the particle, the value, the bound.
    pub detail: String,
}

/// Why a run ended without a result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum Stopped {
    /// The case itself failed.
    #[error(transparent)]
    Failed(#[from] Failure),
    /// The caller asked to stop. Nothing is wrong with the case.
    #[error("interrupted")]
    Interrupted,
}
