//! Approximate inverses, one per file.

mod aggregation;
mod dense;
mod incomplete;

use serde::{Deserialize, Serialize};

use super::Csr;
use aggregation::Hierarchy;
use incomplete::Incomplete;

/// Names of the preconditioners, as scene files spell them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PreconditionerChoice {
    /// The diagonal.
    Jacobi,
    /// Incomplete factors on the matrix's own pattern: IC(0), ILU(0) where it is not symmetric.
    Incomplete,
    /// Multigrid by plain aggregation.
    Multigrid,
}

impl PreconditionerChoice {
    /// Every preconditioner.
    pub const ALL: [PreconditionerChoice; 3] = [
        PreconditionerChoice::Jacobi,
        PreconditionerChoice::Incomplete,
        PreconditionerChoice::Multigrid,
    ];
}

/// A preconditioner that is prepared for a matrix and applied many times.
#[derive(Debug, Clone)]
pub struct Preconditioner {
    choice: PreconditionerChoice,
    incomplete: Incomplete,
    hierarchy: Hierarchy,
}

impl Preconditioner {
    /// Not prepared yet.
    pub fn new(choice: PreconditionerChoice) -> Preconditioner {
        Preconditioner {
            choice,
            incomplete: Incomplete::default(),
            hierarchy: Hierarchy::default(),
        }
    }

    /// Gets ready for a matrix.
    pub fn prepare(&mut self, a: &Csr) {
        match self.choice {
            PreconditionerChoice::Jacobi => {}
            PreconditionerChoice::Incomplete => self.incomplete.prepare(a),
            PreconditionerChoice::Multigrid => self.hierarchy.prepare(a),
        }
    }

    /// `z` ≈ A⁻¹ `r`.
    pub fn apply(&mut self, a: &Csr, r: &[f64], z: &mut [f64]) {
        match self.choice {
            PreconditionerChoice::Jacobi => {
                for ((z, r), d) in z.iter_mut().zip(r).zip(&a.diagonal) {
                    *z = r / d;
                }
            }
            PreconditionerChoice::Incomplete => self.incomplete.apply(r, z),
            PreconditionerChoice::Multigrid => self.hierarchy.apply(a, r, z),
        }
    }
}
