//! The pressure, and how it and the walls' loads respond to the wall's acceleration.

use super::Isph;
use super::images::NO_BODY;
use super::options::Laplacian;
use super::project::Source;
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
    fn rule(&self) -> StopRule {
        let options = &self.options;
        let height = options.density * options.gravity * options.spacing;
        let entry = 2.0 * options.spacing * options.spacing * self.full_weight;
        StopRule {
            tolerance: options.solver_tolerance,
            floor: FLOOR * height * entry * (self.fluid.len() as f64).sqrt(),
            most_iterations: MOST_ITERATIONS,
        }
    }

    fn solve(&mut self, right: &[f64], x: &mut [f64], rule: StopRule) -> Result<(), StepError> {
        let (path, matrix, preconditioner) = (self.path, &self.matrix, &mut self.preconditioner);
        let report = match self.options.laplacian {
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
        let n = self.fluid.len();
        self.preconditioner.prepare(&self.matrix);
        // What is forgotten keeps modes from adding up that the gradient hardly feels.
        let memory = self.options.pressure_memory;
        self.pressure.clear();
        self.pressure.extend(self.carried.pressure.iter().map(|p| memory * p));
        self.accelerate(Source::Pressure);
        let gravity = self.options.gravity;
        let star: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let [ax, ay] = self.accelerations[i];
                [self.fluid.vx[i] + dt * ax, self.fluid.vy[i] + dt * (ay - gravity)]
            })
            .collect();
        self.diverge(&star, |walls| walls.velocity);
        self.check(dt);
        self.right_hand_side(dt, true);
        let carried = &self.carried;
        let mut change: Vec<f64> = (carried.pressure.iter().zip(&carried.older_pressure))
            .map(|(p, old)| (2.0 - memory) * p - old)
            .collect();
        let right = std::mem::take(&mut self.right);
        let rule = self.rule();
        let solved = self.solve(&right, &mut change, rule);
        self.right = right;
        for (pressure, change) in self.pressure.iter_mut().zip(&change) {
            *pressure += change;
        }
        solved
    }

    /// Solves for the pressure per unit acceleration of the responding wall, so that force and
    /// acceleration can be settled together: p = p0 + a p1.
    pub(super) fn solve_response(&mut self, dt: f64) -> Result<(), StepError> {
        self.accelerate(Source::Walls);
        let star: Vec<[f64; 2]> = self.accelerations.iter().map(|a| a.map(|a| dt * a)).collect();
        self.diverge(&star, |walls| walls.velocity_response);
        self.right_hand_side(dt, false);
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
    pub(super) fn reaction(&self) -> Vec<f64> {
        let mut forces = vec![0.0; self.bodies];
        for &i in &self.at_walls {
            let i = i as usize;
            let [px, py] = self.loose[i].place;
            let volume = self.fluid.mass[i] / self.options.density;
            let [own_xx, own_xy, _] = self.own_stress[i];
            for neighbour in self.neighbours(i) {
                let e = neighbour.point as usize;
                let body = self.points.body[e];
                if body != NO_BODY {
                    let [xx, xy, _] = self.stress[e];
                    let (dx, dy) = (self.points.x[e] - px, self.points.y[e] - py);
                    forces[body as usize] +=
                        volume * neighbour.weight * ((xx + own_xx) * dx + (xy + own_xy) * dy);
                }
            }
        }
        forces
    }
}
