//! `seawall`: parameter sweeps of smoothed particle hydrodynamics (SPH) simulations of solitary
//! waves on fixed and spring-mounted seawalls.
//!
//! Layers, from the ground up; a module imports only from its own layer or from below:
//!
//! | layer | modules | what lives there |
//! |---|---|---|
//! | 1 | [`math`], [`theory`], [`keys`] | SIMD lanes; pure formulas; how keys are declared |
//! | 2 | [`kernel`] | smoothing kernels behind one contract |
//! | 3 | [`pairs`] | particle arrays, neighbour lists, sums over pairs |
//! | 4 | [`boundary`], [`body`] | ghost particle interpolators; paddle and walls |
//! | 5 | [`water`] | what every scheme does with its water |
//! | 6 | [`scheme`] | δ-SPH and incompressible SPH |
//! | 7 | [`scene`] | scene files: parsing, validation, construction |
//! | 8 | [`simulation`] | driver, checkpoint, measures, outcome of one case |
//! | 9 | [`quantities`], [`papers`] | what is reported of a case: names, units, where values are read; what the papers print |
//! | 10 | [`study`] | sweep files, the grid, case identity, plan |
//! | 11 | [`schedule`] | what runs where and when: a pure state machine |
//! | 12 | [`results`] | the output directory: journal, records, tables |
//! | 13 | [`film`] | films of the water: a page that plays, and a still |
//! | 14 | [`execute`] | workers on threads or under MPI |
//! | 15 | [`accuracy`] | measured errors, hard cases, numerics that meet a wanted error |
//! | 16 | [`report`] | tables and figures from files alone |
//! | 17 | [`cli`] | one file per subcommand |
//!
//! Start at [`simulation::run_case`] for one case and at [`study`] for a sweep.
#![warn(missing_docs)]

pub mod accuracy;
pub mod body;
pub mod boundary;
pub mod cli;
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
