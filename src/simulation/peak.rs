//! The first peak of a quantity.

use serde::{Deserialize, Serialize};

/// A peak is over when it has dropped by this share.
const PEAK_DROP: f64 = 0.10;

/// Running maximum that is closed once the quantity has dropped 10 % of its height above `base`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Peak {
    base: f64,
    highest: f64,
    pub(super) closed: bool,
}

impl Peak {
    pub(super) fn new(base: f64) -> Peak {
        Peak { base, highest: f64::NEG_INFINITY, closed: false }
    }

    pub(super) fn push(&mut self, value: f64) {
        if self.closed {
            return;
        }
        self.highest = self.highest.max(value);
        let height = self.highest - self.base;
        self.closed = height > 0.0 && value - self.base < (1.0 - PEAK_DROP) * height;
    }

    pub(super) fn value(&self) -> Option<f64> {
        self.highest.is_finite().then_some(self.highest)
    }
}
