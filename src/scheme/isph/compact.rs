//! The paper's own pressure equation, with a compact Laplacian: for comparison.
//!
//! The incremental form of Liang et al. 2017, Eq. 11. The last step's pressure, which particles
//! carry with them, gives a first velocity u* = u + Δt (g - ∇p/ρ). The remaining divergence of u*
//! corrects that pressure. The compact Laplacian differs from the divergence of the gradient. The
//! next steps correct the difference, so that it does not push the water the same way for ever.

use super::Isph;
use super::project::Source;
use super::solve::MEMORY;
use crate::scheme::StepError;

/// A support less complete than this gets the largest κ.
const POOREST: f64 = 0.25;

impl Isph {
    /// Prepares what all solves of a step share.
    pub(super) fn prepare_compact(&mut self) {
        self.system.preconditioner.prepare(&self.system.matrix);
        self.exact.aim.clear();
        self.exact.aim.resize(self.fluid.len(), 0.0);
        self.aim_at_volume();
    }

    /// Solves V 2 Σ F (p_i - p_j) + grip p_i = -V (ρ/Δt) ∇·u*/κ for the change of the dynamic
    /// pressure.
    pub(super) fn solve_compact(&mut self, dt: f64) -> Result<(), StepError> {
        self.pressure.clear();
        self.pressure.extend(self.carried.pressure.iter().map(|p| MEMORY * p));
        self.accelerate(Source::Pressure);
        self.set_velocities_after(dt);
        self.diverge(|walls| walls.velocity);
        for (divergence, restored) in self.divergence.iter_mut().zip(&self.exact.restored) {
            *divergence -= restored;
        }
        self.compact_right_hand_side(dt);
        let mut change = std::mem::take(&mut self.system.change);
        change.clear();
        let carried = self.carried.pressure.iter().zip(&self.carried.older_pressure);
        change.extend(carried.map(|(p, old)| (2.0 - MEMORY) * p - old));
        self.refine(change, self.rule())
    }

    /// -V (ρ/Δt) ∇·u / κ for the divergence at hand.
    pub(super) fn compact_right_hand_side(&mut self, dt: f64) {
        let (options, operators) = (&self.options, &self.operators);
        let (mass, divergence) = (&self.fluid.mass, &self.divergence);
        self.system.right.clear();
        self.system.right.extend((0..divergence.len()).map(|i| {
            let volume = mass[i] / options.density;
            -volume * options.density * divergence[i] / (dt * operators.kappa(i, POOREST))
        }));
    }
}
