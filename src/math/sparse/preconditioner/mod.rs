//! Approximate inverses, one per file.

mod aggregation;
mod incomplete;

use serde::{Deserialize, Serialize};

use super::Csr;
use crate::math::simd::SimdPath;
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
pub enum Preconditioner {
    /// The diagonal.
    Jacobi,
    /// Incomplete factors.
    Incomplete(Incomplete),
    /// A hierarchy of aggregates.
    Multigrid(Hierarchy),
}

impl Preconditioner {
    /// Not prepared yet.
    pub fn new(choice: PreconditionerChoice) -> Preconditioner {
        match choice {
            PreconditionerChoice::Jacobi => Preconditioner::Jacobi,
            PreconditionerChoice::Incomplete => Preconditioner::Incomplete(Incomplete::default()),
            PreconditionerChoice::Multigrid => Preconditioner::Multigrid(Hierarchy::default()),
        }
    }

    /// Gets ready for a matrix.
    pub fn prepare(&mut self, a: &Csr) {
        match self {
            Preconditioner::Jacobi => {}
            Preconditioner::Incomplete(factors) => factors.prepare(a),
            Preconditioner::Multigrid(hierarchy) => hierarchy.prepare(a),
        }
    }

    /// `z` ≈ A⁻¹ `r`.
    pub fn apply(&mut self, path: SimdPath, a: &Csr, r: &[f64], z: &mut [f64]) {
        match self {
            Preconditioner::Jacobi => {
                for ((z, r), d) in z.iter_mut().zip(r).zip(&a.diagonal) {
                    *z = r / d;
                }
            }
            Preconditioner::Incomplete(factors) => factors.apply(r, z),
            Preconditioner::Multigrid(hierarchy) => hierarchy.apply(path, a, r, z),
        }
    }
}
