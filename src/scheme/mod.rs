//! Equations of motion behind one contract: weakly compressible δ-SPH and incompressible SPH.

mod contract;
pub mod isph;
mod state_equation;
pub mod wcsph;

pub use contract::{
    Dissipation, Load, NextStep, Scheme, SchemeState, SolverSummary, StepError, StepWalls,
};
pub use state_equation::{StateEquation, StateEquationChoice};
