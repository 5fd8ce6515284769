//! The pressure equation with what solves it.

use super::Isph;
use super::options::Laplacian;
use crate::math::sparse::{Csr, Krylov, Preconditioner, PreconditionerChoice, StopRule, Stored};
use crate::pairs::Rows;
use crate::scheme::StepError;

/// A solve that takes more iterations than this has failed.
const MOST_ITERATIONS: u32 = 500;
/// Right-hand sides smaller than the weight of this share of a spacing of water, held over the
/// surface of every particle, count as zero.
const FLOOR: f64 = 1e-3;

/// A matrix, its preconditioner and the fields of a solve.
#[derive(Debug)]
pub(super) struct System {
    pub matrix: Csr,
    pub preconditioner: Preconditioner,
    pub krylov: Krylov,
    pub rows: Rows,
    pub right: Vec<f64>,
    /// What is solved for, the guess before that.
    pub change: Vec<f64>,
    /// Who is connected to a particle whose pressure is held, and who is still to be asked for
    /// others.
    pub reached: Vec<bool>,
    pub open: Vec<u32>,
    /// L s of the particles, for Schwaiger's Laplacian.
    pub tilts: Vec<[f64; 2]>,
}

impl System {
    pub fn new(choice: PreconditionerChoice) -> System {
        System {
            matrix: Csr::default(),
            preconditioner: Preconditioner::new(choice),
            krylov: Krylov::default(),
            rows: Rows::default(),
            right: Vec::new(),
            change: Vec::new(),
            reached: Vec::new(),
            open: Vec::new(),
            tilts: Vec::new(),
        }
    }
}

impl Isph {
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

    /// Solves for `x`, from a guess, with the right-hand side at hand.
    pub(super) fn solve(&mut self, x: &mut [f64], rule: &StopRule) -> Result<(), StepError> {
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
}
