//! `seawall`: parameter sweeps of smoothed particle hydrodynamics (SPH) simulations of solitary
//! waves on fixed and spring-mounted seawalls.
//!
//! Layers, from the ground up; a module imports only from its own layer or from below:
//!
//! | layer | modules | what lives there |
//! |---|---|---|
//! | 1 | [`math`], [`theory`], [`keys`] | SIMD lanes; pure formulas; how keys are declared |
//! | 2 | [`kernel`] | smoothing kernels behind one contract |
//! | 3 | [`particles`], [`neighbours`] | particle arrays, neighbour lists |
//! | 4 | [`boundary`], [`body`] | ghost particle interpolators; paddle and walls |
//! | 5 | [`scheme`] | δ-SPH time stepping |
//! | 6 | [`scene`] | scene files: parsing, validation, construction |
//! | 7 | [`simulation`] | driver, checkpoint, measures, outcome of one case |
//! | 8 | [`sweep`] | grid, plan, manager, journal, executors |
//! | 9 | [`report`] | tables and figures from files alone |
//! | 10 | [`cli`] | one file per subcommand |
//!
//! Start at [`simulation::run_case`] for one case and at [`sweep`] for a study.
#![warn(missing_docs)]

pub mod body;
pub mod boundary;
pub mod cli;
pub mod kernel;
pub mod keys;
pub mod math;
pub mod neighbours;
pub mod particles;
pub mod report;
pub mod scene;
pub mod scheme;
pub mod simulation;
pub mod sweep;
pub mod theory;
