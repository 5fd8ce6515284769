//! Incompressible SPH behind the contract of all schemes.

use std::time::Instant;

use super::gradient::reaction;
use super::project::Source;
use super::{Isph, IsphState};
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::math::team::{Growing, Team};
use crate::pairs::Fluid;
use crate::scheme::{
    Dissipation, Load, Scheme, SchemeState, SolverSummary, StateEquation, StepError, StepWalls,
};

/// Divergence and volume are checked once in this many steps.
const STEPS_PER_CHECK: u64 = 10;

impl Scheme for Isph {
    fn fluid(&self) -> &Fluid {
        &self.fluid
    }

    fn walls(&self) -> &Ghosts {
        &self.ghosts
    }

    fn kernel(&self) -> (KernelChoice, f64) {
        (self.options.kernel, self.options.support_radius)
    }

    fn pressures(&self) -> &[f64] {
        &self.whole
    }

    fn state_equation(&self) -> Option<&StateEquation> {
        None
    }

    fn step_limit(&self) -> f64 {
        let n = self.fluid.len();
        let speeds = self.fluid.vx[..n].iter().zip(&self.fluid.vy[..n]);
        let fastest = speeds.map(|(vx, vy)| vx * vx + vy * vy).fold(0.0, f64::max).sqrt();
        self.options.courant_number * self.options.spacing / fastest
    }

    fn take_on(&mut self, team: &Team) {
        self.near.take_on(team);
        self.growing = Growing::of(team);
    }

    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError> {
        let mut clock = Instant::now();
        self.pending = self.tally;
        self.list(bodies, dt);
        self.phases.lap("neighbours", &mut clock);
        self.find_operators();
        self.pending.pair_evaluations += self.near.pairs() as u64;
        self.phases.lap("operators", &mut clock);
        self.assemble();
        self.phases.lap("assembly", &mut clock);
        self.responded = false;
        self.solve_pressure(dt)?;
        self.phases.lap("solver", &mut clock);
        self.accelerate(Source::Pressure);
        self.settled.clone_from(&self.accelerations);
        if self.tally.steps.is_multiple_of(STEPS_PER_CHECK) {
            self.set_velocities_after(dt);
            self.diverge(|walls| walls.velocity);
            self.check(dt);
        }
        reaction(&self.near, &self.points, &mut self.forces);
        let forces = self.forces.iter().zip(&self.drag_on_bodies);
        for (load, (force, drag)) in self.loads.iter_mut().zip(forces) {
            *load = Load { force: force + drag, added_mass: 0.0 };
        }
        self.settle(0.0);
        self.phases.lap("integration", &mut clock);
        Ok(())
    }

    fn respond(&mut self, dt: f64) -> Result<(), StepError> {
        let mut clock = Instant::now();
        self.solve_response(dt)?;
        self.responded = true;
        self.phases.lap("solver", &mut clock);
        self.accelerate(Source::Response);
        reaction(&self.near, &self.points, &mut self.forces);
        for (load, force) in self.loads.iter_mut().zip(&self.forces) {
            load.added_mass = -force;
        }
        Ok(())
    }

    fn settle(&mut self, acceleration: f64) {
        self.answer = if self.responded { acceleration } else { 0.0 };
        self.settle_pressures();
    }

    fn kicks(&self) -> bool {
        false
    }

    fn load(&self, body: usize) -> Load {
        self.loads[body]
    }

    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, _sample: bool) -> Dissipation {
        let mut clock = Instant::now();
        let losses = self.advance(dt, walls);
        self.pending.steps += 1;
        self.tally = self.pending;
        std::mem::swap(&mut self.carried.aim, &mut self.exact.aim);
        std::mem::swap(&mut self.carried.pressure, &mut self.carried.older_pressure);
        std::mem::swap(&mut self.carried.pressure, &mut self.dynamic);
        self.phases.lap("integration", &mut clock);
        losses
    }

    fn level_at(&self, body: usize) -> f64 {
        self.face_line(body).map_or(0.0, |line| self.level_along(line, 0.0))
    }

    fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
        self.level_along(|y| [x, y], from)
    }

    fn face_force(&mut self, body: usize, _: &BodyMotion) -> f64 {
        self.pressure_on(body)
    }

    fn face_pressures(&mut self, body: usize, _: &BodyMotion, pressures: &mut Vec<f64>) {
        self.pressures_along(body, pressures);
    }

    fn state(&self) -> SchemeState {
        let (fluid, carried) = (self.fluid.clone(), self.carried.clone());
        SchemeState::Isph(Box::new(IsphState { fluid, carried, tally: self.tally }))
    }

    fn restore(&mut self, state: SchemeState) {
        let SchemeState::Isph(state) = state else {
            unreachable!("a checkpoint is bound to its scheme")
        };
        let IsphState { fluid, carried, tally } = *state;
        (self.fluid, self.carried, self.tally) = (fluid, carried, tally);
    }

    fn pair_evaluations(&self) -> u64 {
        self.tally.pair_evaluations
    }

    fn phases(&self) -> Vec<(&'static str, f64)> {
        self.phases.seconds_by_name()
    }

    fn solver(&self) -> Option<SolverSummary> {
        let tally = &self.tally;
        Some(SolverSummary {
            iterations_per_step: tally.iterations as f64 / tally.steps.max(1) as f64,
            worst_residual: tally.worst_residual,
            worst_divergence: tally.worst_divergence,
            worst_volume_drift: tally.worst_volume_drift,
        })
    }
}

impl Isph {
    /// Records how far the water is from divergence-free and from its own volume.
    fn check(&mut self, dt: f64) {
        let (mut count, mut squares, mut drift) = (0.0_f64, 0.0, 0.0);
        for i in 0..self.fluid.len() {
            if self.operators.grip[i] == 0.0 && self.operators.completeness[i] > 0.8 {
                let divergence = dt * self.divergence[i];
                count += 1.0;
                squares += divergence * divergence;
                drift += self.operators.coverage[i] - self.even.coverage;
            }
        }
        let count = count.max(1.0);
        let tally = &mut self.pending;
        tally.worst_divergence = tally.worst_divergence.max((squares / count).sqrt());
        tally.worst_volume_drift = tally.worst_volume_drift.max((drift / count).abs());
    }
}
