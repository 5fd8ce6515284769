//! A centred mean over a fixed span of time, of a quantity linear between its samples.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// Keeps the samples of the last `span` seconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunningMean {
    span: f64,
    samples: VecDeque<(f64, f64)>,
}

impl RunningMean {
    /// A mean over `span` seconds.
    pub fn new(span: f64) -> RunningMean {
        RunningMean { span, samples: VecDeque::new() }
    }

    /// Takes a sample; returns the mean and the middle of its span, once that is filled.
    pub fn push(&mut self, time: f64, value: f64) -> Option<(f64, f64)> {
        self.samples.push_back((time, value));
        let start = time - self.span;
        if self.samples[0].0 > start {
            return None;
        }
        while self.samples[1].0 <= start {
            self.samples.pop_front();
        }
        let (before, after) = (self.samples[0], self.samples[1]);
        let share = (start - before.0) / (after.0 - before.0);
        let mut last = (start, before.1 + share * (after.1 - before.1));
        let mut sum = 0.0;
        for &(at, value) in self.samples.iter().skip(1) {
            sum += 0.5 * (at - last.0) * (value + last.1);
            last = (at, value);
        }
        Some((time - 0.5 * self.span, sum / self.span))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_a_line_is_its_middle_and_a_parabola_lies_above_its_own() {
        let (mut line, mut parabola) = (RunningMean::new(0.01), RunningMean::new(0.01));
        for k in 0..100 {
            let time = 0.0009 * f64::from(k);
            if let Some((at, value)) = line.push(time, 3.0 * time + 1.0) {
                assert!((value - (3.0 * at + 1.0)).abs() < 1e-12);
                assert!((time - at - 0.005).abs() < 1e-12);
            } else {
                assert!(time < 0.01);
            }
            if let Some((at, value)) = parabola.push(time, time * time) {
                let excess = value - at * at;
                assert!((excess - 1e-4 / 12.0).abs() < 0.0009_f64.powi(2) / 6.0);
            }
        }
    }
}
