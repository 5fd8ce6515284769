//! Equations of motion behind one contract: weakly compressible δ-SPH and incompressible SPH.

mod contract;
pub mod isph;
mod step;
pub mod wcsph;

pub use crate::water::{StateEquation, StateEquationChoice};
pub use contract::{Scheme, SchemeState};
pub use step::{Dissipation, Load, NextStep, Phases, SolverSummary, StepError, StepWalls, Taken};
