//! One process, one case per thread.

use std::path::Path;
use std::time::Duration;

use super::worker::{Worker, with_worker};
use super::{
    Crew, Link, Order, Report, Setup, available_cores, host_name, resources, share_threads,
};
use crate::math::simd::SimdPath;
use crate::results::{Filing, RankInfo, SweepError};
use crate::schedule::Work;

/// Gathers this process's threads and lets `lead` use them.
pub fn with_crew<T>(setup: &Setup<'_>, lead: impl FnOnce(&mut dyn Crew) -> T) -> T {
    let threads = setup.threads.unwrap_or_else(available_cores).max(1);
    let ranks = [RankInfo::new(host_name(), threads)];
    lead(&mut Threads { setup: *setup, ranks })
}

struct Threads<'a> {
    setup: Setup<'a>,
    ranks: [RankInfo; 1],
}

impl Crew for Threads<'_> {
    fn executor(&self) -> &'static str {
        "threads"
    }

    fn ranks(&self) -> &[RankInfo] {
        &self.ranks
    }

    fn share_threads(&mut self, runs: usize) {
        share_threads(&mut self.ranks, runs);
    }

    fn widest_simd(&self) -> SimdPath {
        super::widest_simd().unwrap_or(SimdPath::Portable)
    }

    fn work(
        &mut self,
        simd: SimdPath,
        out: &Path,
        lead: &mut dyn FnMut(&mut dyn Link) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        let [rank] = &self.ranks;
        let runner = (self.setup.make_runner)(resources(rank, simd));
        let filing = Filing::here(out);
        with_worker(0, rank.places(), &*runner, Some(&filing), |worker| lead(&mut Local(worker)))?
    }
}

struct Local<'a, 'run, 'scope>(&'a mut Worker<'run, 'scope>);

impl Link for Local<'_, '_, '_> {
    fn send(&mut self, _rank: usize, order: Order) {
        if let Some(fetch) = self.0.take(order) {
            // There is no other rank, so the case runs from rest.
            self.0.arrive(fetch.trunk, None);
        }
    }

    fn poll(&mut self, patience: Duration) -> Result<Option<(usize, Report)>, SweepError> {
        Ok(self.0.poll(patience).map(|report| (0, report)))
    }

    fn under_way(&self) -> Vec<(Work, f64)> {
        self.0.under_way()
    }
}
