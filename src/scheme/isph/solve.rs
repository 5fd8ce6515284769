//! The pressure, and how it and the walls' loads respond to the wall's acceleration.

use super::Isph;
use super::options::Laplacian;
use super::project::Source;
use crate::math::sparse::StopRule;
use crate::scheme::StepError;

/// The response is solved to this many times the pressure's tolerance: what it leaves of the
/// divergence is small by the wall's acceleration and taken up by the next step.
const RESPONSE_TOLERANCE: f64 = 10.0;

impl Isph {
    /// Solves for the dynamic pressure with the responding wall's acceleration left out.
    pub(super) fn solve_pressure(&mut self, dt: f64) -> Result<(), StepError> {
        self.find_drag();
        match self.options.laplacian {
            Laplacian::Exact => self.solve_exact(dt),
            Laplacian::Symmetric | Laplacian::Schwaiger => self.solve_compact(dt),
        }
    }

    /// Solves for the change of the pressure from a guess, and adds it.
    pub(super) fn settle(&mut self, mut change: Vec<f64>, rule: StopRule) -> Result<(), StepError> {
        let solved = self.solve(&mut change, &rule);
        for (pressure, change) in self.pressure.iter_mut().zip(&change) {
            *pressure += change;
        }
        self.system.change = change;
        solved
    }

    /// u + Δt (g + drag + the accelerations at hand).
    pub(super) fn set_velocities_after(&mut self, dt: f64) {
        let gravity = self.options.gravity;
        let (fluid, accelerations, drag) = (&self.fluid, &self.accelerations, &self.drag);
        self.velocities.clear();
        self.velocities.extend((0..fluid.len()).map(|i| {
            let [ax, ay] = [0, 1].map(|k| accelerations[i][k] + drag[i][k]);
            [fluid.vx[i] + dt * ax, fluid.vy[i] + dt * (ay - gravity)]
        }));
    }

    /// Solves for the pressure per unit acceleration of the responding wall, so that force and
    /// acceleration can be settled together: p = p0 + a p1.
    pub(super) fn solve_response(&mut self, dt: f64) -> Result<(), StepError> {
        self.accelerate(Source::Walls);
        self.velocities.clear();
        self.velocities.extend(self.accelerations.iter().map(|a| a.map(|a| dt * a)));
        self.diverge(|walls| walls.velocity_response);
        if self.options.laplacian == Laplacian::Exact {
            let factor = -self.options.density / dt;
            let divergences = self.divergence.iter().zip(&self.near.volume);
            self.system.right.clear();
            self.system.right.extend(divergences.map(|(d, v)| factor * v * d));
        } else {
            self.compact_right_hand_side(dt, 0.0);
        }
        let mut response = std::mem::take(&mut self.carried.response);
        response.resize(self.fluid.len(), 0.0);
        let tolerance = (RESPONSE_TOLERANCE * self.options.solver_tolerance).min(0.1);
        let rule = StopRule { tolerance, floor: 0.0, ..self.rule() };
        let solved = self.solve(&mut response, &rule);
        self.carried.response = response;
        solved
    }
}
