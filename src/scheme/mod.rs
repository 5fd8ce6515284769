//! Equations of motion behind one contract: weakly compressible δ-SPH.

mod contract;
mod state_equation;
pub mod wcsph;

pub use contract::{Dissipation, Load, Scheme, SchemeState, StepError, StepWalls};
pub use state_equation::{StateEquation, StateEquationChoice};
