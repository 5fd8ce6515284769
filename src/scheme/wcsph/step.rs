//! The two halves of a time step.

use std::time::Instant;

use super::Wcsph;
use crate::body::BodyMotion;
use crate::math::simd::LANES;
use crate::scheme::{Dissipation, StepWalls};

impl Wcsph {
    /// First half: forces at the current places. `bodies` are the motions at this instant; the
    /// acceleration of the responding body is not used. With `sample` the viscous power is summed.
    pub fn prepare(&mut self, bodies: &[BodyMotion], sample: bool) -> &[[f64; 2]] {
        let start = Instant::now();
        self.refresh_lists(bodies);
        let listed = Instant::now();
        self.timings.neighbours += (listed - start).as_secs_f64();
        self.pack();
        let packed = Instant::now();
        self.timings.integration += (packed - listed).as_secs_f64();
        let (fluid_records, ghost_records) = self.records.split_at_mut(self.fluid.padded_len());
        let fluid = self.work.water(fluid_records, self.options.corrected_gradients);
        self.exchange.weigh(self.path, &self.ghosts, bodies, fluid);
        self.exchange.fill(&self.ghosts, bodies, self.responds, ghost_records);
        let filled = Instant::now();
        self.timings.ghosts += (filled - packed).as_secs_f64();
        self.last_viscous_power = self.momentum_pass(sample);
        self.timings.momentum += filled.elapsed().as_secs_f64();
        &self.work.loads
    }

    /// Second half: velocities with the forces of [`Wcsph::prepare`], densities with the new
    /// velocities, then places. With `sample` the power of density diffusion is summed.
    ///
    /// Shifting moves a particle by δr = -A h |u| Δt ∇C, ∇C = Σ V_j ∇W, faded out where the
    /// support is incomplete and across walls, and takes its density along: δρ = δr·∇ρ, with the
    /// gradient that density diffusion uses (hydrostatic or renormalised, zero for the others).
    pub fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation {
        let start = Instant::now();
        self.kick(dt, walls.acceleration);
        let kicked = Instant::now();
        self.timings.integration += (kicked - start).as_secs_f64();
        let records = self.records.split_at_mut(self.fluid.padded_len());
        let records = (&*records.0, records.1);
        self.exchange.refresh_velocities(self.path, &self.ghosts, walls.bodies, records);
        let mirrored = Instant::now();
        self.timings.ghosts += (mirrored - kicked).as_secs_f64();
        let diffusion_power = -self.continuity_pass(sample);
        let counted = Instant::now();
        self.timings.continuity += (counted - mirrored).as_secs_f64();
        let shifting_work = self.drift(dt, walls.bodies);
        self.take_next_correction();
        self.timings.integration += counted.elapsed().as_secs_f64();
        self.boundary_fallbacks += self.exchange.fallbacks();
        self.pair_evaluations += (LANES * (2 * self.pairs.len() + self.exchange.pairs())) as u64;
        Dissipation { viscous_power: -self.last_viscous_power, diffusion_power, shifting_work }
    }
}
