//! What of the particles must be kept to go on later.

use serde::{Deserialize, Serialize};

use super::state::Isph;
use crate::pairs::Fluid;

/// What the solver has done so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    pub steps: u64,
    pub solves: u64,
    pub iterations: u64,
    pub worst_residual: f64,
    pub pair_evaluations: u64,
    /// Largest root mean square of Δt ∇·u over a step's interior particles.
    pub worst_divergence: f64,
    /// Largest mean of |Σ V W - 1| over a step's interior particles.
    pub worst_volume_drift: f64,
}

/// Fields that one step hands to the next, besides the fluid itself.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Carried {
    /// Dynamic pressure of the last step, Pa, and of the one before.
    pub pressure: Vec<f64>,
    pub older_pressure: Vec<f64>,
    /// Divergence at mid-step that the last step aimed at, 1/s.
    pub aim: Vec<f64>,
    /// Response of the pressure to the wall's acceleration; empty until it was asked for.
    pub response: Vec<f64>,
}

/// What must be kept to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IsphState {
    fluid: Fluid,
    carried: Carried,
    tally: Tally,
}

impl Isph {
    pub(super) fn kept(&self) -> IsphState {
        IsphState { fluid: self.fluid.clone(), carried: self.carried.clone(), tally: self.tally }
    }

    pub(super) fn go_back(&mut self, state: IsphState) {
        self.fluid = state.fluid;
        self.carried = state.carried;
        self.tally = state.tally;
    }
}
