//! `seawall`: parameter sweeps of smoothed particle hydrodynamics (SPH) simulations of solitary
//! waves on fixed and spring-mounted seawalls.
//!
//! The modules are floors: each imports only from those below it. `ARCHITECTURE.md` has their order, and
//! `CONTRIBUTING.md` recipes for what is added most often.
//!
//! Start at [`simulation::run_case`] for one case and at [`study`] for a sweep.
#![warn(missing_docs)]

pub mod accuracy;
pub mod body;
pub mod boundary;
pub mod cli;
mod disk;
pub mod execute;
pub mod film;
pub mod kernel;
pub mod keys;
pub mod math;
pub mod pairs;
pub mod papers;
pub mod quantities;
pub mod report;
pub mod results;
pub mod scene;
pub mod schedule;
pub mod scheme;
pub mod simulation;
pub mod study;
pub mod theory;
pub mod water;

pub(crate) use kernel::with_kernel;
