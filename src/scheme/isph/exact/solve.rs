//! The pressure that leaves the water divergence-free.

use super::super::Isph;
use super::super::project::Source;
use crate::math::sparse::StopRule;
use crate::scheme::StepError;

/// Volume errors count only where the support is at least this complete.
const INSIDE: f64 = 0.9;

impl Isph {
    /// Solves -V D G p + C (p + ρ g (level - y)) + ε A (p - m p_old) = -(ρ/Δt) V (D u* - t), u* =
    /// u + Δt (g + drag), for the dynamic pressure; p_old is the last step's, m `pressure_memory`.
    ///
    /// D stands at mid-step, t is its [aim](Isph::aim_divergence). Solved for is the change from an
    /// extrapolated pressure.
    pub(in super::super) fn solve_exact(&mut self, dt: f64) -> Result<(), StepError> {
        let n = self.fluid.len();
        self.prepare_exact();
        self.soften();
        self.preconditioner.prepare(&self.matrix);
        // Relative to what this divergence asks for is the solve's tolerance.
        let size = self.aim_divergence() / dt;
        let options = self.options;
        let carried = &self.carried;
        self.pressure.clear();
        self.pressure.extend(
            carried.pressure.iter().zip(&carried.older_pressure).map(|(p, old)| 2.0 * p - old),
        );
        self.accelerate(Source::Pressure);
        self.set_velocities_after(dt);
        self.diverge(|walls| walls.velocity);
        let exact = &mut self.exact;
        let memory = options.pressure_memory;
        exact.scaled.clear();
        exact.scaled.extend(
            self.pressure.iter().zip(&self.carried.pressure).map(|(p, old)| p - memory * old),
        );
        self.matrix.multiply(self.path, &exact.scaled, &mut exact.compact);
        let (factor, relax) = (-options.density / dt, options.volume_relaxation / dt);
        let operators = &self.operators;
        self.right.clear();
        self.right.extend((0..n).map(|i| {
            let mut divergence = operators.divergence[i] - exact.aim[i];
            if operators.completeness[i] > INSIDE && operators.grip[i] == 0.0 {
                divergence -= relax * (operators.coverage[i] - self.full_coverage);
            }
            factor * self.points.volume[i] * divergence
                - exact.softness[i] * self.own_pressure[i]
                - options.compact_share * exact.compact[i]
        }));
        let rule = StopRule { size: Some(size), ..self.rule() };
        let (right, mut change) =
            (std::mem::take(&mut self.right), std::mem::take(&mut self.change));
        change.clear();
        change.resize(n, 0.0);
        let solved = self.solve(&right, &mut change, rule);
        for (pressure, change) in self.pressure.iter_mut().zip(&change) {
            *pressure += change;
        }
        (self.right, self.change) = (right, change);
        solved
    }

    /// The divergence at mid-step that makes the velocity at the step's end divergence-free there.
    ///
    /// Between the middles of two steps the operator D itself moves on, and takes the divergence of
    /// a velocity from the last step's aim t to D u; half as much is still to come until the end of
    /// this one: t' = -½ (D u - t). Pressure then does no work over a step, to second order: with an
    /// aim of zero it took out energy in proportion to Δt.
    /// Returns |ρ V (D u - t')|.
    fn aim_divergence(&mut self) -> f64 {
        let now = &self.operators.divergence;
        let aim = &mut self.exact.aim;
        aim.clear();
        aim.extend(now.iter().zip(&self.carried.aim).map(|(now, old)| -0.5 * (now - old)));
        if self.tally.steps == 0 {
            // Nothing has moved yet: all of the divergence is to go.
            aim.fill(0.0);
        }
        let asked = now.iter().zip(&*aim).zip(&self.points.volume);
        let square: f64 = asked.map(|((now, aim), volume)| (volume * (now - aim)).powi(2)).sum();
        self.options.density * square.sqrt()
    }
}
