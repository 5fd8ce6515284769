//! The pressure, and how it and the walls' loads respond to the wall's acceleration.

use super::Isph;
use super::exact::ExactLaplacian;
use super::lists::Lists;
use super::options::Laplacian;
use super::project::Source;
use super::sums::Reaction;
use crate::math::simd::dispatch;
use crate::math::sparse::StopRule;
use crate::scheme::StepError;

/// A solve that takes more iterations than this has failed.
const MOST_ITERATIONS: u32 = 500;
/// Right-hand sides smaller than the weight of this share of a spacing of water, held over the
/// surface of every particle, count as zero.
const FLOOR: f64 = 1e-3;

/// The response is solved to this many times the pressure's tolerance: what it leaves of the
/// divergence is small by the wall's acceleration and taken up by the next step.
const RESPONSE_TOLERANCE: f64 = 10.0;

impl Isph {
    pub(super) fn rule(&self) -> StopRule {
        let options = &self.options;
        let height = options.density * options.acceleration * options.spacing;
        let entry = 2.0 * options.spacing * options.spacing * self.full_weight;
        StopRule {
            tolerance: options.solver_tolerance,
            size: None,
            floor: FLOOR * height * entry * (self.fluid.len() as f64).sqrt(),
            most_iterations: MOST_ITERATIONS,
        }
    }

    pub(super) fn solve(
        &mut self,
        right: &[f64],
        x: &mut [f64],
        rule: StopRule,
    ) -> Result<(), StepError> {
        let (path, matrix, preconditioner) = (self.path, &self.matrix, &mut self.preconditioner);
        let report = match self.options.laplacian {
            Laplacian::Exact => {
                let lists = Lists::new(&self.pairs, &self.weights, &self.points, &self.operators);
                let mut product = ExactLaplacian {
                    points: &self.points,
                    lists,
                    numbers: &mut self.numbers,
                    turned: &self.turned,
                    volume: &self.points.volume,
                    compact: self.options.compact_share,
                    exact: &mut self.exact,
                    matrix,
                    preconditioner,
                };
                self.krylov.conjugate(path, &mut product, (right, x), &rule)
            }
            Laplacian::Symmetric => {
                self.krylov.conjugate_gradients(path, matrix, preconditioner, (right, x), &rule)
            }
            Laplacian::Schwaiger => {
                self.krylov.bicgstab(path, matrix, preconditioner, (right, x), &rule)
            }
        };
        self.pending.solves += 1;
        self.pending.iterations += u64::from(report.iterations);
        self.pending.worst_residual = self.pending.worst_residual.max(report.residual);
        if report.converged {
            return Ok(());
        }
        Err(StepError::SolverDiverged {
            iterations: report.iterations,
            residual: report.residual,
            bound: rule.tolerance,
        })
    }

    /// Solves for the dynamic pressure with the responding wall's acceleration left out.
    ///
    /// The last step's pressure, carried along by its particles, makes a first velocity u* =
    /// u + Δt (g - ∇p/ρ); what is left of its divergence corrects that pressure (the incremental
    /// form of Liang et al. 2017, Eq. 11). The compact Laplacian of the matrix and the divergence of
    /// the gradient differ; their difference is then made up for from step to step, instead of
    /// pushing the water the same way for ever.
    pub(super) fn solve_pressure(&mut self, dt: f64) -> Result<(), StepError> {
        self.find_drag();
        if self.options.laplacian == Laplacian::Exact {
            return self.solve_exact(dt);
        }
        self.preconditioner.prepare(&self.matrix);
        // What is forgotten keeps modes from adding up that the gradient hardly feels.
        let memory = self.options.pressure_memory;
        self.pressure.clear();
        self.pressure.extend(self.carried.pressure.iter().map(|p| memory * p));
        self.accelerate(Source::Pressure);
        self.set_velocities_after(dt);
        self.diverge(|walls| walls.velocity);
        self.right_hand_side(dt, true);
        let carried = &self.carried;
        let mut change = std::mem::take(&mut self.change);
        change.clear();
        change.extend(
            (carried.pressure.iter().zip(&carried.older_pressure))
                .map(|(p, old)| (2.0 - memory) * p - old),
        );
        let right = std::mem::take(&mut self.right);
        let rule = self.rule();
        let solved = self.solve(&right, &mut change, rule);
        self.right = right;
        for (pressure, change) in self.pressure.iter_mut().zip(&change) {
            *pressure += change;
        }
        self.change = change;
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
            self.right.clear();
            let divergence = &self.operators.divergence;
            self.right
                .extend(divergence.iter().zip(&self.points.volume).map(|(d, v)| factor * v * d));
        } else {
            self.right_hand_side(dt, false);
        }
        let mut response = std::mem::take(&mut self.carried.response);
        response.resize(self.fluid.len(), 0.0);
        let rule = StopRule {
            tolerance: (RESPONSE_TOLERANCE * self.options.solver_tolerance).min(0.1),
            floor: 0.0,
            ..self.rule()
        };
        let right = std::mem::take(&mut self.right);
        let solved = self.solve(&right, &mut response, rule);
        self.right = right;
        self.carried.response = response;
        solved
    }

    /// Force of the water on every body along x by the momentum reaction, Liang et al. 2017,
    /// Eq. 14 with the corrected gradients of the momentum equation, over fluid i and images j:
    /// the force that the water itself feels, with the opposite sign. Needs the stresses of
    /// [`Isph::accelerate`].
    pub(super) fn reaction(&mut self) {
        let mut forces = std::mem::take(&mut self.forces);
        forces.fill(0.0);
        dispatch(
            self.path,
            Reaction {
                lists: self.lists(),
                pressure: &self.own_pressure,
                volume: &self.points.volume,
                numbers: &self.numbers,
                body: &self.points.body,
                forces: &mut forces,
            },
        );
        self.forces = forces;
    }
}
