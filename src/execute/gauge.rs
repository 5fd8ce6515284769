//! Progress of the present work of this process.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::interrupt::Interrupt;
use crate::scene::CaseConfig;
use crate::schedule::Work;
use crate::simulation::{Limits, Monitor};

/// The progress of every piece of work, as a share of the way from rest to the end of its case.
#[derive(Debug, Default)]
pub(super) struct Gauges(Mutex<HashMap<Work, Arc<AtomicU64>>>);

impl Gauges {
    /// A monitor of a piece of work.
    pub(super) fn watch<'a>(
        &'a self,
        cancel: &'a Interrupt,
        work: Work,
        config: &CaseConfig,
        limits: Limits,
    ) -> Gauge<'a> {
        let way = Way::of(config);
        let share = Arc::new(AtomicU64::new(0));
        self.lock().insert(work, share.clone());
        let limited = Limited { limits, since: Instant::now() };
        Gauge { gauges: self, cancel, work, way, share, limited }
    }

    /// The present work, with its progress.
    pub(super) fn read(&self) -> Vec<(Work, f64)> {
        let share = |share: &Arc<AtomicU64>| f64::from_bits(share.load(Ordering::Relaxed));
        self.lock().iter().map(|(&work, at)| (work, share(at))).collect()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<Work, Arc<AtomicU64>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The simulated times from rest to the end of a case, seconds. They include the relaxation of its
/// water.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way([f64; 2]);

impl Way {
    /// Of a case, or of the cases that share a trunk.
    pub(super) fn of(config: &CaseConfig) -> Way {
        let rests = config.scene.start_s() - config.numerics.relaxation_time_s;
        Way([rests, config.scene.frame().end_time])
    }

    /// The share of it that is done at a time.
    pub(super) fn share(self, time_s: f64) -> f64 {
        let Way([start, end]) = self;
        ((time_s - start) / (end - start).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }
}

/// Records the progress of one piece of work.
pub(super) struct Gauge<'a> {
    gauges: &'a Gauges,
    cancel: &'a Interrupt,
    work: Work,
    way: Way,
    share: Arc<AtomicU64>,
    limited: Limited,
}

/// Checks limits on time and steps, and does so in a child, too.
pub(super) struct Limited {
    pub(super) limits: Limits,
    pub(super) since: Instant,
}

impl Monitor for Limited {
    fn over_limit(&self, steps: u64) -> Option<String> {
        self.limits.on_steps(steps).or_else(|| self.limits.on_time(self.since.elapsed()))
    }
}

impl Monitor for Gauge<'_> {
    fn cancelled(&self) -> bool {
        self.cancel.is_raised()
    }

    fn over_limit(&self, steps: u64) -> Option<String> {
        self.limited.over_limit(steps)
    }

    fn limits(&self) -> Limits {
        self.limited.limits
    }

    fn reached(&self, time_s: f64) {
        self.share.store(self.way.share(time_s).to_bits(), Ordering::Relaxed);
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
        let share = |work, time_s: f64| {
            let gauge = gauges.watch(&cancel, work, &config, Limits::default());
            gauge.reached(time_s);
            let told = gauges.read();
            assert!(told.len() == 1 && told[0].0 == work);
            told[0].1
        };
        for work in [Work::Case(3), Work::Trunk(0)] {
            assert!((share(work, 0.5 * end) - 0.5).abs() < 1e-12);
            assert_eq!([0.0, end].map(|time| share(work, time)), [0.0, 1.0]);
        }
        assert!(gauges.read().is_empty());
    }

    #[test]
    fn the_time_in_which_water_comes_to_rest_counts() {
        let numerics = "relaxation_time_s = 6".parse().unwrap();
        let config =
            CaseConfig::from_tables(&"end_time_s = 4".parse().unwrap(), &numerics).unwrap();
        assert_eq!([-6.0, -1.0, 4.0].map(|time| Way::of(&config).share(time)), [0.0, 0.5, 1.0]);
    }
}
