//! The projection whose Laplacian is the divergence of the gradient that moves the water.

use super::Isph;
use super::laplacian::ExactLaplacian;
use super::project::Source;
use crate::math::sparse::StopRule;
use crate::scheme::StepError;
use crate::water::Slack;

/// A support below this completeness is wholly spray.
const SPRAY: f64 = 0.15;
/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.30, SPRAY], tension: [0.5, 0.3] };
/// The largest share of a divergence that a particle may keep instead of taking a pressure.
const SOFTEST: f64 = 0.99;

/// What the products of the exact Laplacian need and leave, an entry per particle.
#[derive(Debug, Clone, Default)]
pub(super) struct Exact {
    /// ∇p of every particle.
    pub slope: Vec<[f64; 2]>,
    /// C: how far a particle gives way instead of taking a pressure.
    pub softness: Vec<f64>,
    /// κ^(-1/2), κ what takes the compact Laplacian to the size of the exact one.
    pub scale: Vec<f64>,
    pub scaled: Vec<f64>,
    pub compact: Vec<f64>,
    /// Divergence at mid-step that this step aims at, 1/s.
    pub aim: Vec<f64>,
}

impl Isph {
    /// Solves -V D G p + C (p + ρ g (level - y)) + ε A (p - m p_old) = -(ρ/Δt) V (D u* - t), u* =
    /// u + Δt (g + drag), for the dynamic pressure; p_old is the last step's, m `pressure_memory`.
    ///
    /// D stands at mid-step, t is its [aim](Isph::aim_divergence). Solved for is the change from an
    /// extrapolated pressure.
    pub(super) fn solve_exact(&mut self, dt: f64) -> Result<(), StepError> {
        self.soften();
        self.system.preconditioner.prepare(&self.system.matrix);
        // Relative to what this divergence asks for is the solve's tolerance.
        let size = self.aim_divergence() / dt;
        let carried = self.carried.pressure.iter().zip(&self.carried.older_pressure);
        self.pressure.clear();
        self.pressure.extend(carried.map(|(p, old)| 2.0 * p - old));
        self.accelerate(Source::Pressure);
        self.set_velocities_after(dt);
        self.diverge(|walls| walls.velocity);
        let (options, operators, exact) = (&self.options, &self.operators, &mut self.exact);
        let memory = options.pressure_memory;
        exact.scaled.clear();
        let pressures = self.pressure.iter().zip(&self.carried.pressure);
        exact.scaled.extend(pressures.map(|(p, old)| p - memory * old));
        self.system.matrix.multiply(self.path, &exact.scaled, &mut exact.compact);
        let (factor, relax) = (-options.density / dt, options.volume_relaxation / dt);
        self.system.right.clear();
        self.system.right.extend((0..self.pressure.len()).map(|i| {
            let aimed = self.divergence[i] - exact.aim[i];
            let divergence = aimed - relax * operators.crowding(i, &self.even);
            factor * self.near.volume[i] * divergence
                - exact.softness[i] * self.own_pressure[i]
                - options.compact_share * exact.compact[i]
        }));
        let mut change = std::mem::take(&mut self.system.change);
        change.clear();
        change.resize(self.pressure.len(), 0.0);
        self.settle(change, StopRule { size: Some(size), ..self.rule() })
    }

    /// The divergence at mid-step that makes the velocity at the step's end divergence-free there.
    ///
    /// Between the middles of two steps the operator D itself moves on, and takes the divergence of
    /// a velocity from the last step's aim t to D u; half as much is still to come until the end of
    /// this one: t' = -½ (D u - t). Pressure then does no work over a step, to second order: with an
    /// aim of zero it took out energy in proportion to Δt.
    /// Returns |ρ V (D u - t')|.
    fn aim_divergence(&mut self) -> f64 {
        let (now, aim) = (&self.divergence, &mut self.exact.aim);
        aim.clear();
        aim.extend(now.iter().zip(&self.carried.aim).map(|(now, old)| -0.5 * (now - old)));
        if self.tally.steps == 0 {
            // Nothing has moved yet: all of the divergence is to go.
            aim.fill(0.0);
        }
        let asked = now.iter().zip(&*aim).zip(&self.near.volume);
        let square: f64 = asked.map(|((now, aim), volume)| (volume * (now - aim)).powi(2)).sum();
        self.options.density * square.sqrt()
    }

    /// Particles that give way instead of taking a pressure: spray, which has too few neighbours to
    /// feel one, and water near the surface that was under tension in the last step. A share s of
    /// the divergence stays with them: C = s/(1 - s) times the diagonal.
    pub(super) fn soften(&mut self) {
        let (options, n) = (&self.options, self.fluid.len());
        let gravity = options.density * options.gravity;
        let diagonal = &mut self.system.matrix.diagonal;
        let exact = &mut self.exact;
        exact.softness.clear();
        exact.scale.clear();
        for (i, diagonal) in diagonal.iter_mut().enumerate() {
            let still = gravity * (options.still_level - self.near.places[1][i]);
            let tense = self.carried.pressure[i] + still < 0.0;
            let completeness = self.operators.completeness[i];
            let share = SLACK.share(completeness, tense).clamp(0.0, SOFTEST);
            let kappa = self.operators.kappa(i, SPRAY);
            let softness = share / (1.0 - share) * *diagonal;
            exact.softness.push(softness * kappa);
            exact.scale.push(1.0 / kappa.sqrt());
            *diagonal += softness;
        }
        exact.slope.resize(n, [0.0; 2]);
        exact.scaled.resize(n, 0.0);
        exact.compact.resize(n, 0.0);
    }

    /// The matrix of [`Isph::solve_exact`], by its products.
    pub(super) fn exact_laplacian(&mut self) -> ExactLaplacian<'_> {
        ExactLaplacian {
            path: self.path,
            near: &mut self.near,
            points: &self.points,
            operators: &self.operators,
            turned: &self.turned,
            compact: self.options.compact_share,
            exact: &mut self.exact,
            matrix: &self.system.matrix,
            preconditioner: &mut self.system.preconditioner,
        }
    }
}
