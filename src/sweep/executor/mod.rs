//! Executors: how commands reach workers and how their reports come back.
//!
//! - `threads`: one process, one case per thread;
//! - `mpi`: many processes; rank 0 coordinates and computes;
//! - `mpi_disabled`: stands in for `mpi` in a build without it.
//!
//! An executor gathers a [`Crew`] and hands it to a function that runs on rank 0 only. What a
//! single process does with its tasks is the same everywhere and lives in `worker`.

mod launcher;
mod message;
#[cfg(feature = "mpi")]
pub mod mpi;
#[cfg(not(feature = "mpi"))]
#[path = "mpi_disabled.rs"]
pub mod mpi;
pub mod threads;
mod worker;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::interrupt::Interrupt;
use super::runner::Runner;
use crate::math::simd::SimdPath;

pub use launcher::Launcher;
pub use message::{Order, Report};

/// Makes the runner once the instruction set is known.
pub type MakeRunner<'a> = &'a (dyn Fn(SimdPath) -> Box<dyn Runner> + Sync);

/// One process of a crew.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RankInfo {
    /// The machine.
    pub host: String,
    /// Cases that it runs at once.
    pub threads: usize,
}

/// Workers that have gathered and wait for the start.
pub trait Crew {
    /// The name of the executor, for provenance.
    fn executor(&self) -> &'static str;

    /// The ranks.
    fn ranks(&self) -> &[RankInfo];

    /// The widest instruction set that every rank has.
    fn widest_simd(&self) -> SimdPath;

    /// Starts the workers, hands the link to them to `lead`, and stops them when it returns.
    ///
    /// # Errors
    /// What `lead` returns, or a failure to start.
    fn work(
        &mut self,
        simd: SimdPath,
        lead: &mut dyn FnMut(&mut dyn Link) -> Result<(), SweepError>,
    ) -> Result<(), SweepError>;
}

/// The link between the coordinator and the workers.
pub trait Link {
    /// Sends an order to a rank.
    fn send(&mut self, rank: usize, order: Order);

    /// The next report, and the rank it comes from; `None` after the given time without one.
    ///
    /// # Errors
    /// A message that cannot be understood.
    fn poll(&mut self, patience: Duration) -> Result<Option<(usize, Report)>, SweepError>;
}

/// What an executor needs besides a crew's leader.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// Makes each rank's runner.
    pub make_runner: MakeRunner<'a>,
    /// Cases at once per rank; by default the node's cores shared among its ranks.
    pub threads: Option<usize>,
    /// The signals of this process.
    pub interrupt: &'a Interrupt,
}

/// The name of this machine.
pub fn host_name() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let name = name.or_else(|| std::env::var("HOSTNAME").ok());
    name.map_or_else(|| "unknown".to_owned(), |name| name.trim().to_owned())
}

/// The processors that this process may use.
fn available_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
