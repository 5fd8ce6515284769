//! Equations of motion behind one contract: weakly compressible δ-SPH and incompressible SPH.

mod contract;
pub mod isph;
pub mod wcsph;

pub use crate::water::{StateEquation, StateEquationChoice};
pub use contract::{
    Dissipation, Load, NextStep, Scheme, SchemeState, SolverSummary, StepError, StepWalls,
};
