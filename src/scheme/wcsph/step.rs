//! The two halves of a time step.

use std::time::Instant;

use super::Wcsph;
use crate::body::BodyMotion;
use crate::scheme::{Dissipation, StepWalls};

/// Losses within a step, per metre of width.
struct Lost {
    /// Power of density diffusion, where it was asked for, W.
    diffusion_power: f64,
    /// Energy lost by settling at the surface and by holding water inside, J.
    on_the_way: f64,
}

impl Wcsph {
    /// First half: forces at the current places. `bodies` are the motions at the start of the step.
    /// The acceleration of the responding body is not used. The forces of an acoustic step are
    /// known already, from the motions and the length that [`Wcsph::finish`] was given before.
    pub fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) {
        if self.substep > 0 {
            debug_assert_eq!(self.bulk_time, self.options.bulk_damping * dt, "another step");
            debug_assert!(
                bodies.iter().zip(&self.held_bodies).all(|(a, b)| a.acceleration == b.acceleration),
                "other motions than were told"
            );
            return;
        }
        self.bulk_time = self.options.bulk_damping * dt;
        self.lead = 0.5 * dt * f64::from(self.options.acoustic_substeps - 1);
        let mut clock = Instant::now();
        let at_start = !self.pairs.are_listed();
        self.refresh_lists(bodies);
        self.phases.lap("neighbours", &mut clock);
        for (held, body) in self.held_bodies.iter_mut().zip(bodies) {
            *held = BodyMotion { offset: body.offset + self.lead * body.velocity, ..*body };
        }
        self.find_forces(dt);
        if at_start {
            // The first step has no correction from a step before: it takes its own. It has
            // predicted positions from rest. A run that goes on from a trunk that ends here must do
            // the same.
            self.hand_on();
            self.work.carried.last_acceleration_x.fill(0.0);
            self.work.carried.last_acceleration_y.fill(0.0);
            // Counted once, as in a run that goes on from a state stored here.
            self.pairs.take_force_pairs();
            self.find_forces(dt);
        }
    }

    /// The pass of a full step of `dt` seconds, with all its inputs.
    fn find_forces(&mut self, dt: f64) {
        let mut clock = Instant::now();
        self.pack();
        self.phases.lap("integration", &mut clock);
        let (fluid_records, ghost_records) = self.records.split_at_mut(self.fluid.padded_len());
        let fluid = self.work.water(fluid_records, self.options.corrected_gradients);
        let bodies = &self.held_bodies;
        self.exchange.weigh(self.pairs.path, &self.ghosts, bodies, fluid);
        self.exchange.fill(self.pairs.path, &self.ghosts, bodies, self.responds, ghost_records);
        let beds = (&self.ghosts, &**bodies);
        self.exchange.find_fluxes(self.pairs.path, beds, [fluid.records, ghost_records]);
        self.phases.lap("ghosts", &mut clock);
        self.last_viscous_power = self.momentum_pass(dt);
        self.find_diffused_shares();
        self.phases.lap("momentum", &mut clock);
        if self.options.kinematic_viscosity > 0.0 {
            self.last_viscous_power += self.laminar_pass(dt);
            self.phases.lap("viscosity", &mut clock);
        }
    }

    /// Second half: velocities from the forces of [`Wcsph::prepare`], densities from the new
    /// velocities, then places. If an acoustic step is next, also its forces: new pressures over
    /// the pairs of the last full step. With `sample` the power of density diffusion is summed.
    ///
    /// Shifting comes after a full step and its acoustic steps. It moves a particle by δr = -A h U
    /// Δt ∇C with ∇C = Σ V_j ∇W. U is the difference of the flow's velocity across the support.
    /// Shifting fades out where the support is incomplete, and towards walls. The density changes
    /// with the place: δρ = δr·∇ρ. The gradient is that of density diffusion (hydrostatic or
    /// renormalised, zero for the others).
    pub fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation {
        let mut clock = Instant::now();
        // Of this step. Those of the next step come below.
        let forces = self.pairs.take_force_pairs();
        self.bulk_time = self.options.bulk_damping * walls.next.dt;
        self.hold_offsets(walls);
        self.move_planes(dt, walls.bodies);
        self.complete_accelerations(walls.acceleration);
        let acoustic_is_next = self.substep + 1 < self.options.acoustic_substeps;
        let lost = self.go_through(dt, walls.bodies, sample, acoustic_is_next, &mut clock);
        self.since_full += dt;
        self.count_pairs(forces);
        self.substep = (self.substep + 1) % self.options.acoustic_substeps;
        let mut shifting_work = lost.on_the_way;
        if self.substep == 0 {
            if let Some(fades_in) = self.options.shifting.fades_in() {
                self.phases.lap("integration", &mut clock);
                shifting_work += self.shift(fades_in);
                self.phases.lap("shifting", &mut clock);
            }
            shifting_work += self.restore_volume();
            shifting_work += self.hold_inside(walls.bodies);
            self.since_full = 0.0;
            self.hand_on();
        }
        self.phases.lap("integration", &mut clock);
        Dissipation {
            viscous_power: -self.last_viscous_power,
            diffusion_power: -lost.diffusion_power,
            shifting_work,
        }
    }

    /// Takes the water through a step of `dt` seconds with the present accelerations: velocities,
    /// rates of change of density, places. With `forces` it also finds the accelerations of the
    /// next step.
    fn go_through(
        &mut self,
        dt: f64,
        bodies: &[BodyMotion],
        sample: bool,
        forces: bool,
        clock: &mut Instant,
    ) -> Lost {
        self.kick(dt);
        self.phases.lap("integration", clock);
        self.mirror_ghosts();
        self.phases.lap("ghosts", clock);
        let diffusion_power = self.continuity_pass(dt, sample);
        self.phases.lap("continuity", clock);
        let on_the_way = self.drift(dt, bodies, forces);
        self.phases.lap("integration", clock);
        if forces {
            self.press_ghosts();
            self.phases.lap("ghosts", clock);
            self.acoustic_pass();
            self.phases.lap("momentum", clock);
        }
        Lost { diffusion_power, on_the_way }
    }

    /// Hands on what the last pass has found to the coming full step.
    fn hand_on(&mut self) {
        self.work.take_next_correction(self.options.extrapolated_correction);
        self.set_tension();
        let work = &mut self.work;
        std::mem::swap(&mut work.acceleration_x, &mut work.carried.last_acceleration_x);
        std::mem::swap(&mut work.acceleration_y, &mut work.carried.last_acceleration_y);
    }

    /// Takes the bodies' velocities over this step and their accelerations in the next. Offsets
    /// stay: like the pairs, ghosts stay at their places of the last full step.
    fn hold_offsets(&mut self, walls: &StepWalls<'_>) {
        let motions = walls.bodies.iter().zip(walls.next.bodies);
        for (held, (body, next)) in self.held_bodies.iter_mut().zip(motions) {
            (held.velocity, held.acceleration) = (body.velocity, next.acceleration);
        }
    }

    /// Counts the pairs of this step; `forces` of them were for its forces.
    fn count_pairs(&mut self, forces: u64) {
        self.pair_evaluations += forces + self.pairs.take_flow_pairs() + self.exchange.pairs();
        if self.substep == 0 {
            // Weights are found only in full steps.
            self.boundary_fallbacks += self.exchange.fallbacks();
        }
    }
}
