//! The load of each rank: the time of all its past and present work.

use std::collections::HashMap;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::results::{Load, RankInfo, RankLoad};
use crate::schedule::Work;

/// Interval at which the file is renewed.
const EVERY: Duration = Duration::from_secs(2);

/// Counts during a session. Nothing here affects an answer.
#[derive(Debug)]
pub(super) struct Loads {
    since: Instant,
    written: Instant,
    ranks: Vec<RankLoad>,
    begun: HashMap<(usize, Work), Instant>,
}

impl Loads {
    pub(super) fn new(ranks: &[RankInfo]) -> Loads {
        let now = Instant::now();
        let of = |rank: &RankInfo| RankLoad { places: rank.places(), ..RankLoad::default() };
        let (ranks, begun) = (ranks.iter().map(of).collect(), HashMap::new());
        Loads { since: now, written: now, ranks, begun }
    }

    /// A rank was given work.
    pub(super) fn begin(&mut self, rank: usize, work: Work) {
        self.begun.insert((rank, work), Instant::now());
    }

    /// The work has ended, after this many seconds of its own.
    pub(super) fn end(&mut self, rank: usize, work: Work, seconds: f64) {
        self.begun.remove(&(rank, work));
        let load = &mut self.ranks[rank];
        load.busy_s += seconds;
        match work {
            Work::Trunk(_) => load.trunks += 1,
            Work::Case(_) => load.cases += 1,
        }
    }

    /// The work of every rank so far. A rank's present work counts only for as many pieces as it
    /// runs at once, because the last ones wait.
    pub(super) fn so_far(&self) -> Load {
        let mut at: Vec<Vec<f64>> = vec![Vec::new(); self.ranks.len()];
        for (&(rank, _), begun) in &self.begun {
            at[rank].push(begun.elapsed().as_secs_f64());
        }
        let elapsed_s = self.since.elapsed().as_secs_f64();
        let rank = |(load, mut at): (&RankLoad, Vec<f64>)| {
            at.sort_by(|a, b| b.total_cmp(a));
            let busy_s = load.busy_s + at.iter().take(load.places).sum::<f64>();
            RankLoad { busy_s: busy_s.min(elapsed_s * load.places as f64), ..load.clone() }
        };
        Load { elapsed_s, ranks: self.ranks.iter().zip(at).map(rank).collect() }
    }

    /// Writes the load for readers of the directory while the sweep runs. If that fails, they see
    /// nothing.
    pub(super) fn tell(&mut self, directory: &Path) {
        if self.written.elapsed() >= EVERY {
            self.written = Instant::now();
            let _ = self.so_far().write(directory);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_done_and_what_is_under_way_count() {
        let ranks = [RankInfo::new("here".into(), 2), RankInfo::new("there".into(), 1)];
        let mut loads = Loads::new(&ranks);
        loads.since -= Duration::from_secs(100);
        for case in 0..3 {
            loads.begin(0, Work::Case(case));
        }
        loads.begun.values_mut().for_each(|begun| *begun -= Duration::from_secs(10));
        loads.end(1, Work::Trunk(0), 25.0);
        let load = loads.so_far();
        assert!((20.0..21.0).contains(&load.ranks[0].busy_s), "two of three run: {load:?}");
        assert_eq!((load.ranks[1].busy_s, load.ranks[1].trunks, load.ranks[1].cases), (25.0, 1, 0));
        assert!((load.share(0) - 0.1).abs() < 0.01 && (load.share(1) - 0.25).abs() < 0.01);
        loads.end(0, Work::Case(0), 1e9);
        let most = loads.so_far();
        assert!(most.share(0) <= 1.0, "{most:?}");
    }
}
