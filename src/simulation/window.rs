//! A centred running mean over a fixed span of time.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// Room from the start for so many samples.
const ROOM: usize = 128;

/// Keeps the samples of the last `span` seconds and tells their mean, which belongs to the middle
/// of the span. The sum is formed anew each time: no rounding piles up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunningMean {
    span: f64,
    filled: bool,
    samples: VecDeque<(f64, f64)>,
}

impl RunningMean {
    /// A mean over `span` seconds.
    pub fn new(span: f64) -> RunningMean {
        RunningMean { span, filled: false, samples: VecDeque::with_capacity(ROOM) }
    }

    /// Takes a sample; returns the mean and the time it belongs to, once the span is filled.
    pub fn push(&mut self, time: f64, value: f64) -> Option<(f64, f64)> {
        self.samples.push_back((time, value));
        let oldest = time - self.span * (1.0 + 1e-9);
        while self.samples.front().is_some_and(|&(t, _)| t < oldest) {
            self.samples.pop_front();
            self.filled = true;
        }
        if !self.filled {
            return None;
        }
        let (first, last) = (self.samples.front()?.0, self.samples.back()?.0);
        let sum: f64 = self.samples.iter().map(|&(_, value)| value).sum();
        Some((0.5 * (first + last), sum / self.samples.len() as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_a_line_is_its_middle() {
        let mut mean = RunningMean::new(0.01);
        for k in 0..100 {
            let time = 0.0009 * f64::from(k);
            if let Some((at, value)) = mean.push(time, 3.0 * time + 1.0) {
                assert!((value - (3.0 * at + 1.0)).abs() < 1e-12);
                assert!(time - at <= 0.005 + 1e-9 && time >= 0.009);
            } else {
                assert!(time < 0.0101);
            }
        }
    }
}
