//! Readings without the swing of a wall on a stiff spring.
//!
//! In incompressible water the noise of the particles sets such a wall swinging with its own period.
//! Nothing damps that, as waves so short carry no energy away. Waves of the scene press the wall far
//! more slowly. A polynomial through the samples around a time follows these and not the swing
//! (Savitzky & Golay 1964). The equation of a wall that has left its stop is linear, so smooth
//! readings obey it as the raw ones do.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::math::local_fit::LocalFit;

/// The fit spans this time, over √(h/g). It takes out what swings within a third of that. Of the
/// largest force of a fixed wall at H/h = 0.6 it takes 0.3 %.
const SPAN: f64 = 2.0;
/// Memory reserved for this many samples.
const ROOM: usize = 256;
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
            times: VecDeque::with_capacity(ROOM),
            values: VecDeque::with_capacity(ROOM * columns),
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
        self.fitted.fill(0.0);
        let from = self.told * self.columns;
        if !(smooth && self.fit(at)) {
            let raw = self.values.range(from..from + self.columns);
            self.fitted.iter_mut().zip(raw).for_each(|(fitted, raw)| *fitted = *raw);
        }
        self.told += 1;
        Some((at, &self.fitted))
    }

    /// Fits polynomials around a time, s, if there are samples enough on both sides.
    fn fit(&mut self, at: f64) -> bool {
        let near = |time: &f64| (time - at).abs() < self.lag;
        let before = self.times.iter().take_while(|time| !near(time)).count();
        let count = self.times.iter().skip(before).take_while(|time| near(time)).count();
        if before == 0 || before + count == self.times.len() || count < LEAST {
            return false;
        }
        let times = self.times.iter().skip(before).take(count);
        let places = times.map(|time| (time - at) / self.lag);
        let fit = LocalFit::on(places.clone());
        let samples = self.values.make_contiguous().chunks_exact(self.columns).skip(before);
        for (place, sample) in places.zip(samples) {
            let weight = fit.weight(place);
            for (sum, value) in self.fitted.iter_mut().zip(sample) {
                *sum += weight * value;
            }
        }
        true
    }
}

/// Whether a wall with this period in still water, s, swings much faster than waves move it.
/// `unit_time` is √(h/g), s.
pub fn is_stiff(period: f64, unit_time: f64) -> bool {
    period < 0.5 * SPAN * unit_time
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
