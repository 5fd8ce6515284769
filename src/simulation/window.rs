//! A centred running mean over a fixed span of time.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// Memory reserved for this many samples.
const ROOM: usize = 128;

/// Keeps the samples of the last `span` seconds and gives their mean, which belongs to the middle
/// of the span.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunningMean(RunningMeans);

impl RunningMean {
    /// A mean over `span` seconds.
    pub fn new(span: f64) -> RunningMean {
        RunningMean(RunningMeans::new(span, 1))
    }

    /// Takes a sample; returns the mean and the time it belongs to, once the span is filled.
    pub fn push(&mut self, time: f64, value: f64) -> Option<(f64, f64)> {
        self.0.push(time, value, &[]).map(|(middle, means)| (middle, means[0]))
    }
}

/// Running means of many columns over the same span. Sums are formed anew each time, so that
/// rounding does not accumulate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunningMeans {
    span: f64,
    filled: bool,
    times: VecDeque<f64>,
    /// One sample after another.
    values: VecDeque<f64>,
    means: Vec<f64>,
}

impl RunningMeans {
    /// Means of so many columns over `span` seconds.
    pub fn new(span: f64, columns: usize) -> RunningMeans {
        RunningMeans {
            span,
            filled: false,
            times: VecDeque::with_capacity(ROOM),
            values: VecDeque::with_capacity(ROOM * columns),
            means: vec![0.0; columns],
        }
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.times.clear();
        self.values.clear();
        self.filled = false;
    }

    /// Takes a sample of all columns, the first apart from the others, as [`RunningMean::push`] does.
    pub fn push(&mut self, time: f64, first: f64, others: &[f64]) -> Option<(f64, &[f64])> {
        let columns = self.means.len();
        self.times.push_back(time);
        self.values.push_back(first);
        self.values.extend(others);
        let oldest = time - self.span * (1.0 + 1e-9);
        while self.times.front().is_some_and(|&t| t < oldest) {
            self.times.pop_front();
            self.values.drain(..columns);
            self.filled = true;
        }
        if !self.filled {
            return None;
        }
        self.means.fill(0.0);
        for sample in self.values.make_contiguous().chunks_exact(columns) {
            for (sum, value) in self.means.iter_mut().zip(sample) {
                *sum += value;
            }
        }
        let count = self.times.len() as f64;
        self.means.iter_mut().for_each(|sum| *sum /= count);
        Some((0.5 * (self.times.front()? + self.times.back()?), &self.means))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_many_columns_are_those_of_each() {
        let mut one = RunningMean::new(0.01);
        let mut many = RunningMeans::new(0.01, 3);
        for k in 0..200 {
            let time = 0.0009 * f64::from(k);
            let value = (40.0 * time).sin();
            if k == 100 {
                one = RunningMean::new(0.01);
                many.clear();
            }
            let told = many.push(time, value, &[2.0 * value, 7.0]);
            let Some((at, mean)) = one.push(time, value) else {
                assert!(told.is_none());
                continue;
            };
            let (same, means) = told.unwrap();
            assert_eq!((at, mean), (same, means[0]));
            assert_eq!((means[1], means[2]), (2.0 * mean, 7.0));
        }
    }

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
