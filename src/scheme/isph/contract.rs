//! Incompressible SPH behind the contract of all schemes.

use std::time::Instant;

use super::Isph;
use super::project::Source;
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::pairs::Fluid;
use crate::scheme::{Dissipation, Load, Scheme, SchemeState, StateEquation, StepError, StepWalls};

/// Divergence and volume are looked at once in this many steps.
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
        &self.total
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

    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError> {
        let start = Instant::now();
        self.pending = self.tally;
        self.sort(dt);
        self.face_offsets.clear();
        let ahead = 0.5 * dt;
        self.face_offsets.extend(bodies.iter().enumerate().map(|(body, motion)| {
            let known = if body == self.responds { 0.0 } else { motion.acceleration };
            motion.offset + ahead * (motion.velocity + 0.5 * ahead * known)
        }));
        self.list_points(bodies, dt);
        self.list_neighbours();
        let listed = Instant::now();
        self.gather();
        self.turn_corrections();
        self.find_surface();
        let gathered = Instant::now();
        self.assemble();
        let assembled = Instant::now();
        self.responded = false;
        self.solve_pressure(dt)?;
        let solved = Instant::now();
        self.accelerate(Source::Pressure);
        self.settled.clone_from(&self.accelerations);
        if self.tally.steps.is_multiple_of(STEPS_PER_CHECK) {
            self.set_velocities_after(dt);
            self.diverge(|walls| walls.velocity);
            self.check(dt);
        }
        self.reaction();
        for ((load, force), drag) in
            self.loads.iter_mut().zip(&self.forces).zip(&self.drag_on_bodies)
        {
            *load = Load { force: force + drag, added_mass: 0.0 };
        }
        let (gravity, level) =
            (self.options.density * self.options.gravity, self.options.still_level);
        self.total.clear();
        self.total.extend(
            (self.pressure.iter().zip(&self.points.y)).map(|(p, y)| p + gravity * (level - y)),
        );
        let timings = &mut self.timings;
        timings.neighbours += (listed - start).as_secs_f64();
        timings.operators += (gathered - listed).as_secs_f64();
        timings.assembly += (assembled - gathered).as_secs_f64();
        timings.solver += (solved - assembled).as_secs_f64();
        timings.integration += solved.elapsed().as_secs_f64();
        Ok(())
    }

    fn respond(&mut self, dt: f64) -> Result<(), StepError> {
        let start = Instant::now();
        self.solve_response(dt)?;
        self.responded = true;
        self.timings.solver += start.elapsed().as_secs_f64();
        self.accelerate(Source::Response);
        self.reaction();
        for (load, force) in self.loads.iter_mut().zip(&self.forces) {
            load.added_mass = -force;
        }
        Ok(())
    }

    fn kicks(&self) -> bool {
        false
    }

    fn load(&self, body: usize) -> Load {
        self.loads[body]
    }

    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, _sample: bool) -> Dissipation {
        let start = Instant::now();
        let losses = self.advance(dt, walls);
        self.pending.steps += 1;
        self.tally = self.pending;
        std::mem::swap(&mut self.carried.aim, &mut self.exact.aim);
        std::mem::swap(&mut self.carried.pressure, &mut self.carried.older_pressure);
        std::mem::swap(&mut self.carried.pressure, &mut self.pressure);
        self.timings.integration += start.elapsed().as_secs_f64();
        losses
    }

    fn level_at(&self, body: usize) -> f64 {
        self.face_line(body).map_or(0.0, |line| self.level_along(line, 0.0))
    }

    fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
        self.level_along(|y| [x, y], from)
    }

    fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        self.pressure_on(body, motion)
    }

    fn state(&self) -> SchemeState {
        SchemeState::Isph(Box::new(self.kept()))
    }

    fn restore(&mut self, state: SchemeState) {
        let SchemeState::Isph(state) = state else {
            unreachable!("a checkpoint is bound to its scheme")
        };
        self.go_back(*state);
    }

    fn pair_evaluations(&self) -> u64 {
        self.tally.pair_evaluations
    }

    fn phases(&self) -> Vec<(&'static str, f64)> {
        let t = &self.timings;
        vec![
            ("neighbours", t.neighbours),
            ("operators", t.operators),
            ("assembly", t.assembly),
            ("solver", t.solver),
            ("integration", t.integration),
        ]
    }

    fn solver(&self) -> Option<crate::scheme::SolverSummary> {
        let tally = &self.tally;
        Some(crate::scheme::SolverSummary {
            iterations_per_step: tally.iterations as f64 / tally.steps.max(1) as f64,
            worst_residual: tally.worst_residual,
            worst_divergence: tally.worst_divergence,
            worst_volume_drift: tally.worst_volume_drift,
        })
    }
}

impl Isph {
    /// Notes how far the water is from divergence-free and from its own volume.
    pub(super) fn check(&mut self, dt: f64) {
        let (mut count, mut squares, mut drift) = (0.0_f64, 0.0, 0.0);
        for i in 0..self.fluid.len() {
            if self.operators.grip[i] == 0.0 && self.operators.completeness[i] > 0.8 {
                let divergence = dt * self.operators.divergence[i];
                count += 1.0;
                squares += divergence * divergence;
                drift += self.operators.coverage[i] - self.full_coverage;
            }
        }
        let count = count.max(1.0);
        let tally = &mut self.pending;
        tally.worst_divergence = tally.worst_divergence.max((squares / count).sqrt());
        let drift = (drift / count).abs();
        if drift > tally.worst_volume_drift {
            tally.worst_volume_drift = drift;
        }
    }
}
