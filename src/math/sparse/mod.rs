//! Sparse symmetric systems: storage, Krylov solvers, preconditioners.

mod csr;
mod krylov;
mod preconditioner;

pub use csr::Csr;
pub use krylov::{Krylov, Product, SolveReport, StopRule, Stored};
pub use preconditioner::{Preconditioner, PreconditionerChoice};
