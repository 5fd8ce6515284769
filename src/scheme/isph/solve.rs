//! The pressure equation, and the response of the pressure to the wall's acceleration.

use super::Isph;
use super::laplacian::ExactLaplacian;
use super::options::Laplacian;
use super::project::Source;
use super::system::System;
use crate::math::sparse::{StopRule, Stored};
use crate::pairs::Field;
use crate::scheme::StepError;

/// A solve that takes more iterations than this has failed.
const MOST_ITERATIONS: u32 = 500;
/// Share of the last step's dynamic pressure from which the next step starts. Without this loss,
/// modes that the gradient hardly feels would add up.
pub(super) const MEMORY: f64 = 0.98;
/// The first step is solved at most this many times.
const FIRST_SOLVES: u32 = 50;
/// Right-hand sides smaller than this count as zero: the weight of this share of a spacing of
/// water, held over the surface of every particle.
const FLOOR: f64 = 1e-3;
/// The response is solved to this many times the pressure's tolerance. The remaining divergence is
/// a small part of what the wall's acceleration causes. The next step removes it.
const RESPONSE_TOLERANCE: f64 = 10.0;

impl Isph {
    /// Solves for the dynamic pressure without the responding wall's acceleration.
    ///
    /// A step starts from the last one's pressure. The first step has none, so it is solved again
    /// from its own result until that no longer changes. Otherwise the force on still water would
    /// rise by 0.1 % at ten rows, within five steps.
    pub(super) fn solve_pressure(&mut self, dt: f64) -> Result<(), StepError> {
        let starts = self.tally.steps == 0;
        if starts {
            // A trunk that ends before its first step has already found a pressure.
            self.carried.pressure.fill(0.0);
            self.carried.older_pressure.fill(0.0);
        }
        self.find_drag();
        let size = match self.options.laplacian {
            Laplacian::Exact => Some(self.prepare_exact(dt)),
            Laplacian::Symmetric | Laplacian::Schwaiger => {
                self.prepare_compact();
                None
            }
        };
        for _ in 0..if starts { FIRST_SOLVES } else { 1 } {
            let before = self.pending.iterations;
            match size {
                Some(size) => self.solve_exact(dt, size)?,
                None => self.solve_compact(dt)?,
            }
            if !starts || self.pending.iterations == before {
                break;
            }
            self.carried.pressure.clone_from(&self.pressure);
            self.carried.older_pressure.clone_from(&self.pressure);
        }
        Ok(())
    }

    /// Prepares what all solves of a step share; returns the size of the divergence to be removed.
    fn prepare_exact(&mut self, dt: f64) -> f64 {
        self.soften();
        self.system.preconditioner.prepare(&self.system.matrix);
        // The tolerance of the solve is relative to the right-hand side that this divergence gives.
        let last = (self.tally.steps > 0).then_some(&self.carried.aim[..]);
        let aimed = self.exact.aim_at(&self.divergence, last, &self.near.volume);
        self.aim_at_volume();
        self.options.density * aimed / dt
    }

    /// Solves for the dynamic pressure p:
    ///
    /// -V D G p + C (p + ρ g (level - y)) + ε A (p - m p_old) = -(ρ/Δt) V (D u* - t), u* = u + Δt (g + drag)
    ///
    /// p_old is the last step's pressure, m is [`MEMORY`], D is the divergence at mid-step. t is
    /// the [aim](super::exact::Exact::aim_at). The unknown is the change from an extrapolated
    /// pressure.
    fn solve_exact(&mut self, dt: f64, size: f64) -> Result<(), StepError> {
        let carried = self.carried.pressure.iter().zip(&self.carried.older_pressure);
        self.pressure.clear();
        self.pressure.extend(carried.map(|(p, old)| 2.0 * p - old));
        self.accelerate(Source::Pressure);
        self.set_velocities_after(dt);
        self.diverge(|walls| walls.velocity);
        let (options, exact) = (&self.options, &mut self.exact);
        exact.scaled.clear();
        let pressures = self.pressure.iter().zip(&self.carried.pressure);
        exact.scaled.extend(pressures.map(|(p, old)| p - MEMORY * old));
        self.system.matrix.multiply(self.path, &exact.scaled, &mut exact.compact);
        let factor = -options.density / dt;
        self.system.right.resize(self.pressure.len(), 0.0);
        self.near.each(Field(&mut self.system.right), |i| {
            factor * self.near.volume[i] * (self.divergence[i] - exact.aim[i])
                - exact.softness[i] * self.own_pressure[i]
                - options.compact_share * exact.compact[i]
        });
        let mut change = std::mem::take(&mut self.system.change);
        change.clear();
        change.resize(self.pressure.len(), 0.0);
        self.refine(change, StopRule { size: Some(size), ..self.rule() })
    }

    /// Softens spray, and water whose last pressure was a tension.
    pub(super) fn soften(&mut self) {
        let (options, carried, y) = (&self.options, &self.carried, &self.near.places[1]);
        let tense = |i: usize| options.whole_pressure(carried.pressure[i], y[i]) < 0.0;
        self.exact.soften(&self.operators, tense, &mut self.system.matrix.diagonal);
    }

    /// Solves for the change of the pressure from a guess, and adds it.
    pub(super) fn refine(&mut self, mut change: Vec<f64>, rule: StopRule) -> Result<(), StepError> {
        let solved = self.solve(&mut change, &rule);
        for (pressure, change) in self.pressure.iter_mut().zip(&change) {
            *pressure += change;
        }
        self.system.change = change;
        solved
    }

    /// u + Δt (g + drag + the present accelerations).
    pub(super) fn set_velocities_after(&mut self, dt: f64) {
        let gravity = self.options.gravity;
        let (fluid, accelerations, drag) = (&self.fluid, &self.accelerations, &self.drag);
        self.velocities.resize(fluid.len(), [0.0; 2]);
        self.near.each(Field(&mut self.velocities), |i| {
            let ([ax, ay], [drag_x, drag_y]) = (accelerations[i], drag[i]);
            [fluid.vx[i] + dt * (ax + drag_x), fluid.vy[i] + dt * (ay + drag_y - gravity)]
        });
    }

    /// Solves for the pressure per unit acceleration of the responding wall. With it force and
    /// acceleration can be found together: p = p0 + a p1.
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
            self.compact_right_hand_side(dt);
        }
        let mut response = std::mem::take(&mut self.carried.response);
        response.resize(self.fluid.len(), 0.0);
        let tolerance = (RESPONSE_TOLERANCE * self.options.solver_tolerance).min(0.1);
        let rule = StopRule { tolerance, floor: 0.0, ..self.rule() };
        let solved = self.solve(&mut response, &rule);
        self.carried.response = response;
        solved
    }

    /// When a solve for the pressure ends.
    pub(super) fn rule(&self) -> StopRule {
        let options = &self.options;
        let height = options.density * options.acceleration * options.spacing;
        let entry = 2.0 * options.spacing * options.spacing * self.even.weight;
        StopRule {
            tolerance: options.solver_tolerance,
            size: None,
            floor: FLOOR * height * entry * (self.fluid.len() as f64).sqrt(),
            most_iterations: MOST_ITERATIONS,
        }
    }

    /// Solves for `x` from a guess, with the present right-hand side.
    fn solve(&mut self, x: &mut [f64], rule: &StopRule) -> Result<(), StepError> {
        let mut krylov = std::mem::take(&mut self.system.krylov);
        let right = std::mem::take(&mut self.system.right);
        let sides = (&*right, x);
        let path = self.path;
        let System { matrix, preconditioner, .. } = &mut self.system;
        let mut stored = Stored { path, matrix, preconditioner };
        let report = match self.options.laplacian {
            Laplacian::Exact => {
                krylov.conjugate_gradients(&mut self.exact_laplacian(), sides, rule)
            }
            Laplacian::Symmetric => krylov.conjugate_gradients(&mut stored, sides, rule),
            Laplacian::Schwaiger => krylov.bicgstab(&mut stored, sides, rule),
        };
        (self.system.krylov, self.system.right) = (krylov, right);
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
