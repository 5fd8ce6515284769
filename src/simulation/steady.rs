//! Readings without the swing of a wall on a stiff spring.
//!
//! In incompressible water the noise of the particles sets such a wall swinging with its own period.
//! Nothing damps that, as waves so short carry no energy away. Waves of the scene press the wall far
//! more slowly. A polynomial through the samples around a time follows these and not the swing
//! (Savitzky & Golay 1964). The equation of a wall that has left its stop is linear, so smooth
//! readings obey it as the raw ones do.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// The fit spans this time, over √(h/g). It takes out what swings within a third of that. Of the
/// largest force of a fixed wall at H/h = 0.6 it takes 0.3 %.
const SPAN: f64 = 2.0;
/// Degree of the polynomial.
const DEGREE: usize = 4;
/// A fit has at least this many samples.
const LEAST: usize = 9;

/// Keeps the last samples until what follows them is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Steady {
    /// Half of the span, s.
    lag: f64,
    /// Numbers of a sample.
    columns: usize,
    times: VecDeque<f64>,
    /// One sample after another.
    values: VecDeque<f64>,
    /// How many samples have been told.
    told: usize,
    /// Whether no sample follows.
    complete: bool,
    fitted: Vec<f64>,
}

impl Steady {
    /// For samples of so many numbers; √(h/g) in seconds.
    pub fn new(columns: usize, unit_time: f64) -> Steady {
        Steady {
            lag: 0.5 * SPAN * unit_time,
            columns,
            times: VecDeque::new(),
            values: VecDeque::new(),
            told: 0,
            complete: false,
            fitted: vec![0.0; columns],
        }
    }

    /// Takes a sample: its time, s, its first number, and the others. With none, no sample follows,
    /// or those that follow have nothing to do with these.
    pub fn push(&mut self, sample: Option<(f64, f64, &[f64])>) {
        let Some((time, first, others)) = sample else {
            self.complete = true;
            return;
        };
        if self.complete {
            self.times.clear();
            self.values.clear();
            (self.told, self.complete) = (0, false);
        }
        self.times.push_back(time);
        self.values.push_back(first);
        self.values.extend(others);
    }

    /// Tells all samples whose time has come, see [`Steady::next`].
    pub fn each(&mut self, smooth: bool, mut told: impl FnMut(f64, &[f64])) {
        while let Some((at, values)) = self.next(smooth) {
            told(at, values);
        }
    }

    /// The next sample, `smooth` or as it is, with its time, s. Samples that have too few others
    /// before or behind them are told as they are.
    pub fn next(&mut self, smooth: bool) -> Option<(f64, &[f64])> {
        let (at, newest) = (*self.times.get(self.told)?, *self.times.back()?);
        if at > newest - self.lag && !self.complete {
            return None;
        }
        while self.told > 0 && self.times[1] < at - self.lag {
            self.times.pop_front();
            self.values.drain(..self.columns);
            self.told -= 1;
        }
        let near = |&time: &f64| (time - at).abs() < self.lag;
        let before = self.times.iter().position(near).unwrap_or(self.told);
        let count = self.times.iter().skip(before).take_while(|time| near(time)).count();
        let whole = before > 0 && before + count < self.times.len() && count >= LEAST;
        let (from, weights) = if smooth && whole {
            let along = self.times.iter().skip(before).take(count);
            (before, weights(&along.map(|time| (time - at) / self.lag).collect::<Vec<_>>()))
        } else {
            (self.told, vec![1.0])
        };
        self.fitted.fill(0.0);
        let columns = self.columns;
        let samples = self.values.make_contiguous()[from * columns..].chunks_exact(columns);
        for (weight, sample) in weights.iter().zip(samples) {
            for (sum, value) in self.fitted.iter_mut().zip(sample) {
                *sum += weight * value;
            }
        }
        self.told += 1;
        Some((at, &self.fitted))
    }
}

/// Whether a wall with this period in still water, s, swings much faster than waves move it.
/// `unit_time` is √(h/g), s.
pub fn is_stiff(period: f64, unit_time: f64) -> bool {
    period < 0.5 * SPAN * unit_time
}

/// The weights of samples at these places, between -1 and 1, whose sum is the value at 0 of the
/// polynomial with the least Σ (1 - s²)² δ². Polynomials that are orthogonal on the places come from
/// a recurrence (Forsythe 1957).
fn weights(places: &[f64]) -> Vec<f64> {
    let counts: Vec<f64> = places.iter().map(|s| (1.0 - s * s).powi(2)).collect();
    let sum = |of: &dyn Fn(usize) -> f64| (0..places.len()).map(|i| counts[i] * of(i)).sum::<f64>();
    let mut all = vec![0.0; places.len()];
    // The polynomial and the one before it, at the places and at 0.
    let (mut now, mut last) = (vec![1.0; places.len()], vec![0.0; places.len()]);
    let [mut now_here, mut last_here, mut last_norm] = [1.0, 0.0, f64::INFINITY];
    for _ in 0..=DEGREE {
        let norm = sum(&|i| now[i] * now[i]);
        let middle = sum(&|i| places[i] * now[i] * now[i]) / norm;
        let share = norm / last_norm;
        for (i, weight) in all.iter_mut().enumerate() {
            *weight += counts[i] * now[i] * now_here / norm;
            let next = (places[i] - middle) * now[i] - share * last[i];
            (last[i], now[i]) = (now[i], next);
        }
        let next = -middle * now_here - share * last_here;
        (last_here, now_here, last_norm) = (now_here, next, norm);
    }
    all
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const UNIT: f64 = 0.1428;

    /// All samples of what `of` gives at uneven times.
    fn told(smooth: bool, of: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let (mut steady, mut all) = (Steady::new(2, UNIT), Vec::new());
        let mut take = |at: f64, values: &[f64]| {
            assert_eq!(values[1], -values[0]);
            all.push((at, values[0]));
        };
        for step in 0..1000 {
            let time = 0.002 * f64::from(step) + 0.0005 * f64::from(step % 3);
            steady.push(Some((time, of(time), &[-of(time)])));
            steady.each(smooth, &mut take);
        }
        steady.push(None);
        steady.each(smooth, &mut take);
        assert_eq!(all.len(), 1000);
        all
    }

    #[test]
    fn a_polynomial_stays_what_it_is() {
        let of = |t: f64| 1.0 + t * (0.3 - t * (2.0 - t * (1.0 + 0.5 * t)));
        for (at, value) in told(true, of) {
            assert!((value - of(at)).abs() < 1e-10, "{at}: {value}");
        }
    }

    #[test]
    fn rough_readings_and_those_at_the_ends_are_told_as_they_are() {
        let of = |t: f64| (100.0 * t).sin();
        let inside = |at: f64| at > 0.14 && at < 1.86;
        assert!(told(false, of).iter().all(|&(at, value)| value == of(at)));
        let smooth = told(true, of);
        assert!(smooth.iter().all(|&(at, value)| inside(at) || value == of(at)));
        assert!(smooth.iter().any(|&(at, value)| (value - of(at)).abs() > 0.3));
    }

    /// A wave is as long as its solitary crest at the wall.
    #[test]
    fn the_swing_goes_and_the_wave_stays() {
        let most = |of: &dyn Fn(f64) -> f64| {
            let inside = told(true, of).into_iter().filter(|&(at, _)| at > 0.2 && at < 1.8);
            inside.fold(0.0, |most: f64, (_, value)| most.max(value.abs()))
        };
        for period in [0.02, 0.05, 0.07, 0.09] {
            let swing = most(&|t| (TAU * t / period).sin());
            assert!(swing < 0.1, "{period}: {swing}");
        }
        let wave = most(&|t| ((t - 1.0) / (1.5 * UNIT)).cosh().powi(-2));
        assert!((wave - 1.0).abs() < 0.004, "{wave}");
        assert!(is_stiff(0.1, UNIT) && !is_stiff(0.15, UNIT));
    }

    #[test]
    fn nothing_reaches_over_a_break() {
        let mut steady = Steady::new(1, UNIT);
        let mut all = Vec::new();
        for step in 0..400 {
            if step == 200 {
                steady.push(None);
                steady.each(true, |_, value| all.push(value[0]));
            }
            steady.push(Some((0.002 * f64::from(step), f64::from(u8::from(step >= 200)), &[])));
            steady.each(true, |_, value| all.push(value[0]));
        }
        assert!(
            all.iter()
                .enumerate()
                .all(|(k, &value)| { (value - f64::from(u8::from(k >= 200))).abs() < 1e-12 })
        );
    }
}
