//! When quantities that change fast are read between the samples of the history.

use serde::{Deserialize, Serialize};

/// Largest time between two looks, over √(h/g): 0.005 s at h = 0.2 m. Readings at a distance of
/// 0.02 s would cut a crest off.
const INTERVAL: f64 = 0.036;

/// The looks so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Looks(u64);

impl Looks {
    /// Whether to look now; if so, the look counts as done. Looks come at the history's interval
    /// (s), or at their own if that is shorter; `unit` is √(h/g) in s. They begin at `start`, s.
    pub fn is_due(&mut self, time: f64, start: f64, intervals: (f64, f64)) -> bool {
        let is_due = self.comes(time, start, intervals);
        if is_due {
            let least = passed(time - start, Looks::interval(intervals));
            self.0 = next(self.0, least, |count| Looks(count).due(start, intervals) <= time);
        }
        is_due
    }

    /// Whether to look now; the look does not count as done.
    pub fn comes(&self, time: f64, start: f64, intervals: (f64, f64)) -> bool {
        time >= self.due(start, intervals)
    }

    /// When the next look is due, s.
    pub fn due(&self, start: f64, intervals: (f64, f64)) -> f64 {
        start + Looks::interval(intervals) * self.0 as f64 * (1.0 - 1e-12)
    }

    /// Time between two looks, s.
    pub fn interval((history_interval, unit): (f64, f64)) -> f64 {
        history_interval.min(INTERVAL * unit)
    }

    /// Whether the number of looks is a multiple of this.
    pub fn complete(&self, many: u64) -> bool {
        self.0.is_multiple_of(many)
    }
}

/// How many intervals have certainly passed in a time, s.
pub(super) fn passed(time: f64, interval: f64) -> u64 {
    ((time / interval) as u64).saturating_sub(1)
}

/// The first count after `count` that is not in the past. Counts up to `least` are skipped: a clock
/// may begin long after 0, and intervals may be far shorter than steps.
pub(super) fn next(count: u64, least: u64, is_past: impl Fn(u64) -> bool) -> u64 {
    let mut next = count.saturating_add(1).max(least);
    while next < u64::MAX && is_past(next) {
        next += 1;
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_come_one_by_one_on_a_clock_that_begins_anywhere() {
        for begin in [0.0, 3.37, 86400.123, 1.7e9] {
            let (mut looks, mut seen) = (Looks::default(), 0);
            for k in 0..1000 {
                let time = begin + 0.003 * f64::from(k);
                let next = looks;
                if looks.is_due(time, 0.0, (0.01, 1.0)) {
                    seen += 1;
                    // The first look that is not in the past.
                    let before = Looks(looks.0 - 1);
                    assert!(looks.due(0.0, (0.01, 1.0)) > time && next.0 < looks.0);
                    assert!(before.due(0.0, (0.01, 1.0)) <= time || next.0 + 1 == looks.0);
                }
            }
            assert!((299..=301).contains(&seen), "{begin}: {seen}");
        }
    }

    #[test]
    fn looks_come_at_every_step_where_these_are_far_longer() {
        for interval in [1e-10, 1e-30, 1e-300] {
            let mut looks = Looks::default();
            for k in 0..1000 {
                assert!(looks.is_due(0.003 * f64::from(k), 0.0, (interval, 1.0)), "{interval} {k}");
            }
        }
    }
}
