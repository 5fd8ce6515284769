//! When something that changes fast is looked at between the samples of the history.

use serde::{Deserialize, Serialize};

/// Looks come at least so often, over √(h/g): every 0.005 s at h = 0.2 m. Readings a fiftieth of a second
/// apart would cut a crest off.
const INTERVAL: f64 = 0.036;

/// The looks so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Looks(u64);

impl Looks {
    /// Whether to look now: at the history's interval (s), or at its own, `unit` = √(h/g) in s, where that is
    /// shorter; from `start` on, s. If so it is taken as done.
    pub fn is_due(&mut self, time: f64, start: f64, intervals: (f64, f64)) -> bool {
        let is_due = self.comes(time, start, intervals);
        if is_due {
            self.0 += 1;
            while self.due(start, intervals) <= time {
                self.0 += 1;
            }
        }
        is_due
    }

    /// Whether to look now; nothing is taken as done.
    pub fn comes(&self, time: f64, start: f64, intervals: (f64, f64)) -> bool {
        time >= self.due(start, intervals)
    }

    /// When the next look is due, s.
    pub fn due(&self, start: f64, intervals: (f64, f64)) -> f64 {
        start + Looks::interval(intervals) * self.0 as f64 * (1.0 - 1e-12)
    }

    /// Between two looks, s.
    pub fn interval((history_interval, unit): (f64, f64)) -> f64 {
        history_interval.min(INTERVAL * unit)
    }

    /// Of every so many looks this was the last.
    pub fn complete(&self, many: u64) -> bool {
        self.0.is_multiple_of(many)
    }
}
