//! Equations of motion: weakly compressible δ-SPH.

mod state_equation;
pub mod wcsph;

pub use state_equation::{StateEquation, StateEquationChoice};
