//! Runs the work: [`coordinate`] connects the scheduler, the workers and the journal.
//!
//! An executor carries commands to workers and their reports back:
//!
//! - `threads`: one process, one case per thread;
//! - `mpi`: many processes; rank 0 coordinates and computes;
//! - `mpi_disabled`: replaces `mpi` in a build without it.
//!
//! An executor gathers a [`Crew`] and passes it to a function that runs on rank 0 only. How a
//! single process does its tasks is the same for all executors: see `worker`.

pub mod apart;
mod coordinate;
pub mod fake;
mod gauge;
mod interrupt;
mod keeping;
mod launcher;
mod load;
pub mod memory;
mod message;
#[cfg(feature = "mpi")]
pub mod mpi;
#[cfg(not(feature = "mpi"))]
#[path = "mpi_disabled.rs"]
pub mod mpi;
mod processor;
mod progress;
mod reckoning;
mod runner;
mod session;
mod sph_runner;
pub mod threads;
mod worker;

use std::path::Path;
use std::time::Duration;

use crate::math::simd::SimdPath;
use crate::results::{RankInfo, SweepError};
use crate::schedule::Work;
use crate::simulation::Resources;

pub use coordinate::coordinate;
pub use interrupt::{Interrupt, outlive_long_files};
pub use keeping::Keeping;
pub use launcher::Launcher;
pub use message::{Order, Posted, Report};
pub use processor::widest_simd;
pub use progress::{Progress, ProgressStyle, Tally, duration};
pub use runner::{Runner, guarded};
pub use session::{Ending, Session, Worked};
pub use sph_runner::SphRunner;

/// Makes the runner once the instruction set and a case's threads are known.
pub type MakeRunner<'a> = &'a (dyn Fn(Resources) -> Box<dyn Runner> + Sync);

/// If there are fewer runs than threads, each run gets the threads that are left when the runs are
/// spread over the ranks.
fn share_threads(ranks: &mut [RankInfo], runs: usize) {
    let all: usize = ranks.iter().map(|rank| rank.threads).sum();
    let runs_per_rank = runs.div_ceil(ranks.len().max(1)).max(1);
    for rank in ranks {
        let alone = rank.threads / runs_per_rank;
        rank.threads_per_case = if runs < all { alone.max(1) } else { 1 };
    }
}

/// Workers that wait for the start.
pub trait Crew {
    /// The name of the executor, for provenance.
    fn executor(&self) -> &'static str;

    /// The ranks.
    fn ranks(&self) -> &[RankInfo];

    /// Lets idle threads share the work of each run, if there are only this many runs.
    fn share_threads(&mut self, runs: usize);

    /// The widest instruction set that all ranks have.
    fn widest_simd(&self) -> SimdPath;

    /// Starts the workers, passes their link to `lead`, and stops them when it returns. If they can
    /// see `out`, they write the files of cases there. It must be open and have its manifest.
    fn work(
        &mut self,
        simd: SimdPath,
        out: &Path,
        lead: &mut dyn FnMut(&mut dyn Link) -> Result<(), SweepError>,
    ) -> Result<(), SweepError>;
}

/// The link between the coordinator and the workers.
pub trait Link {
    /// Sends an order to a rank.
    fn send(&mut self, rank: usize, order: Order);

    /// The next report, and the rank it comes from; `None` after the given time without one.
    fn poll(&mut self, patience: Duration) -> Result<Option<(usize, Report)>, SweepError>;

    /// The present work of all ranks as last reported, with its progress on the way from rest to
    /// the end of its case.
    fn under_way(&self) -> Vec<(Work, f64)> {
        Vec::new()
    }
}

/// The inputs of an executor, besides the function for rank 0.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// Makes each rank's runner.
    pub make_runner: MakeRunner<'a>,
    /// Threads per rank; by default the node's cores shared among its ranks.
    pub threads: Option<usize>,
    /// The stop requests of this process.
    pub interrupt: &'a Interrupt,
    /// A rank that is silent for longer than this is reported.
    pub patience: Duration,
}

/// The resources of each case on a rank.
fn resources(rank: &RankInfo, simd: SimdPath) -> Resources {
    Resources { simd, threads: rank.threads_per_case }
}

/// The name of this machine.
pub fn host_name() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let name = name.or_else(|| std::env::var("HOSTNAME").ok());
    name.map_or_else(|| "unknown".to_owned(), |name| name.trim().to_owned())
}

/// The processors that this process may use.
pub fn available_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_that_cases_leave_idle_work_within_them() {
        let shared = |threads: &[usize], runs: usize| {
            let rank = |&threads: &usize| RankInfo::new(String::new(), threads);
            let mut ranks: Vec<_> = threads.iter().map(rank).collect();
            share_threads(&mut ranks, runs);
            let places: usize = ranks.iter().map(RankInfo::places).sum();
            assert!(places >= runs.min(threads.iter().sum()), "{threads:?} {runs}");
            ranks.iter().map(|rank| rank.threads_per_case).collect::<Vec<_>>()
        };
        assert_eq!(shared(&[8], 3), [2]);
        assert_eq!(shared(&[8], 1), [8]);
        assert_eq!(shared(&[8], 8), [1]);
        assert_eq!(shared(&[2], 300), [1]);
        assert_eq!(shared(&[4, 4], 3), [2, 2]);
        assert_eq!(shared(&[4, 1], 2), [4, 1]);
        assert_eq!(shared(&[1, 1, 1], 2), [1, 1, 1]);
    }
}
