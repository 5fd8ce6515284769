//! Approximate inverses, one per file.
//!
//! A new one needs a file with an implementation of [`Inverse`], and two lines here: its `mod` and
//! its place in `preconditioners!`.

mod aggregation;
mod dense;
mod incomplete;
mod jacobi;

use serde::{Deserialize, Serialize};

use super::Csr;

/// An approximate inverse. It must be a symmetric, positive definite operation.
trait Inverse: Default {
    /// Prepares for a matrix.
    fn prepare(&mut self, a: &Csr);

    /// `z` ≈ A⁻¹ `r`.
    fn apply(&mut self, a: &Csr, r: &[f64], z: &mut [f64]);
}

/// Declares the family: for each its name in scene files (in kebab case) and its type.
macro_rules! preconditioners {
    ($($(#[$doc:meta])* $name:ident is $type:ty;)+) => {
        /// Names of the preconditioners, as scene files spell them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum PreconditionerChoice {
            $($(#[$doc])* $name,)+
        }

        impl PreconditionerChoice {
            /// Every preconditioner.
            pub const ALL: &[PreconditionerChoice] = &[$(PreconditionerChoice::$name),+];
        }

        #[derive(Debug, Clone)]
        enum Chosen {
            $($name(Box<$type>),)+
        }

        impl Preconditioner {
            /// Not prepared yet.
            pub fn new(choice: PreconditionerChoice) -> Preconditioner {
                Preconditioner(match choice {
                    $(PreconditionerChoice::$name => Chosen::$name(Box::default()),)+
                })
            }

            /// Prepares for a matrix.
            pub fn prepare(&mut self, a: &Csr) {
                match &mut self.0 {
                    $(Chosen::$name(inverse) => inverse.prepare(a),)+
                }
            }

            /// `z` ≈ A⁻¹ `r`.
            pub fn apply(&mut self, a: &Csr, r: &[f64], z: &mut [f64]) {
                match &mut self.0 {
                    $(Chosen::$name(inverse) => inverse.apply(a, r, z),)+
                }
            }
        }
    };
}

/// A preconditioner that is prepared for a matrix and applied many times.
#[derive(Debug, Clone)]
pub struct Preconditioner(Chosen);

preconditioners! {
    /// The diagonal.
    Jacobi is jacobi::Jacobi;
    /// Incomplete factors on the matrix's own pattern: IC(0), ILU(0) where it is not symmetric.
    Incomplete is incomplete::Incomplete;
    /// Multigrid by plain aggregation.
    Multigrid is aggregation::Hierarchy;
}
