//! How far the pieces of work are that this process is at.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::interrupt::Interrupt;
use crate::scene::CaseConfig;
use crate::schedule::Work;
use crate::simulation::{Limits, Monitor, cost};

/// The share of every piece that is being worked on.
#[derive(Debug, Default)]
pub(super) struct Gauges(Mutex<HashMap<Work, Arc<AtomicU64>>>);

impl Gauges {
    /// A monitor of a piece of work; `branches` where it starts from a checkpoint.
    pub(super) fn watch<'a>(
        &'a self,
        cancel: &'a Interrupt,
        work: Work,
        config: &CaseConfig,
        branches: bool,
        limits: Limits,
    ) -> Gauge<'a> {
        let estimate = cost(config);
        let end = config.scene.frame().end_time;
        let start = config.scene.start_s();
        let onset = estimate.trunk_share * end;
        let span = match work {
            Work::Trunk(_) => [start, onset],
            Work::Case(_) if branches => [onset, end],
            Work::Case(_) => [start, end],
        };
        let share = Arc::new(AtomicU64::new(0));
        self.lock().insert(work, share.clone());
        Gauge { gauges: self, cancel, work, span, share, limits, since: Instant::now() }
    }

    /// What is being worked on, and the share of it that is done.
    pub(super) fn read(&self) -> Vec<(Work, f64)> {
        let share = |share: &Arc<AtomicU64>| f64::from_bits(share.load(Ordering::Relaxed));
        self.lock().iter().map(|(&work, at)| (work, share(at))).collect()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<Work, Arc<AtomicU64>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Watches one piece of work.
pub(super) struct Gauge<'a> {
    gauges: &'a Gauges,
    cancel: &'a Interrupt,
    work: Work,
    /// Simulated time at its start and at its end, about, seconds.
    span: [f64; 2],
    share: Arc<AtomicU64>,
    limits: Limits,
    since: Instant,
}

impl Monitor for Gauge<'_> {
    fn cancelled(&self) -> bool {
        self.cancel.is_raised()
    }

    fn over_limit(&self, steps: u64) -> Option<String> {
        self.limits.on_steps(steps).or_else(|| self.limits.on_time(self.since.elapsed()))
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    fn reached(&self, time_s: f64) {
        let [start, end] = self.span;
        let share = ((time_s - start) / (end - start).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        self.share.store(share.to_bits(), Ordering::Relaxed);
    }
}

impl Drop for Gauge<'_> {
    fn drop(&mut self) {
        self.gauges.lock().remove(&self.work);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_is_told_while_it_is_under_way() {
        let empty = toml::Table::new();
        let config = CaseConfig::from_tables(&empty, &empty).unwrap();
        let end = config.scene.frame().end_time;
        let (gauges, cancel) = (Gauges::default(), Interrupt::default());
        let share = |work, branches, time_s: f64| {
            let gauge = gauges.watch(&cancel, work, &config, branches, Limits::default());
            gauge.reached(time_s);
            let told = gauges.read();
            assert!(told.len() == 1 && told[0].0 == work);
            told[0].1
        };
        assert!((share(Work::Case(3), false, 0.5 * end) - 0.5).abs() < 1e-12);
        assert_eq!(share(Work::Case(3), true, 0.0), 0.0);
        assert_eq!(share(Work::Case(3), true, end), 1.0);
        assert_eq!(share(Work::Trunk(0), false, end), 1.0);
        assert!(gauges.read().is_empty());
    }
}
