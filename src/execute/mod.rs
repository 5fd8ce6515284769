//! Doing the work: [`coordinate`] ties the scheduler, the workers and the journal together.
//!
//! An executor carries commands to workers and their reports back:
//!
//! - `threads`: one process, one case per thread;
//! - `mpi`: many processes; rank 0 coordinates and computes;
//! - `mpi_disabled`: stands in for `mpi` in a build without it.
//!
//! An executor gathers a [`Crew`] and hands it to a function that runs on rank 0 only. What a
//! single process does with its tasks is the same everywhere and lives in `worker`.

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

/// Where there are fewer runs than threads, each takes as many threads as are left for it once the
/// runs are spread over the ranks.
fn share_threads(ranks: &mut [RankInfo], runs: usize) {
    let all: usize = ranks.iter().map(|rank| rank.threads).sum();
    let runs_per_rank = runs.div_ceil(ranks.len().max(1)).max(1);
    for rank in ranks {
        let alone = rank.threads / runs_per_rank;
        rank.threads_per_case = if runs < all { alone.max(1) } else { 1 };
    }
}

/// Workers that have gathered and wait for the start.
pub trait Crew {
    /// The name of the executor, for provenance.
    fn executor(&self) -> &'static str;

    /// The ranks.
    fn ranks(&self) -> &[RankInfo];

    /// Lets the threads that so few runs would leave idle share the work of each.
    fn share_threads(&mut self, runs: usize);

    /// The widest instruction set that every rank has.
    fn widest_simd(&self) -> SimdPath;

    /// Starts the workers, hands the link to them to `lead`, and stops them when it returns. They write the
    /// files of cases into `out`, which is open and has its manifest, where they see it.
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

    /// What all ranks are at, as far as they have said, and how far each piece is on the way from rest to the end of
    /// its case.
    fn under_way(&self) -> Vec<(Work, f64)> {
        Vec::new()
    }
}

/// What an executor needs besides a crew's leader.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// Makes each rank's runner.
    pub make_runner: MakeRunner<'a>,
    /// Threads per rank; by default the node's cores shared among its ranks.
    pub threads: Option<usize>,
    /// The signals of this process.
    pub interrupt: &'a Interrupt,
    /// A rank that is silent for longer than this is named.
    pub patience: Duration,
}

/// What each case on a rank may use.
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
