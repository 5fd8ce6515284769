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
    /// shorter; from `start` on, s.
    pub fn is_due(&mut self, time: f64, start: f64, (history_interval, unit): (f64, f64)) -> bool {
        let interval = history_interval.min(INTERVAL * unit);
        let due = |looks: u64| start + interval * looks as f64 * (1.0 - 1e-12);
        if time < due(self.0) {
            return false;
        }
        while due(self.0) <= time {
            self.0 += 1;
        }
        true
    }
}
