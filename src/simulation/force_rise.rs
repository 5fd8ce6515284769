//! The rise of a force to the maximum of its first impact, and the impulse.

use serde::{Deserialize, Serialize};

use super::outcome::Maximum;

/// The rise is between these shares of the maximum's height above still water.
const SHARES: [f64; 2] = [0.1, 0.9];
/// At most this many samples are kept. Water that is never calm but never impacts loses its older
/// half.
const MOST: usize = 2048;

/// The course of a force from its last calm to its maximum, and its integral.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Onrush {
    /// Samples are at least this far apart, seconds.
    interval: f64,
    /// F* no higher than this is calm.
    calm: f64,
    /// Time, s, and F*.
    course: Vec<[f64; 2]>,
    /// The last sample of the integral.
    last: Option<[f64; 2]>,
    impulse: f64,
}

impl Onrush {
    /// For impacts of at least this F*, with samples at least `interval` apart, s.
    pub fn new(least: f64, interval: f64) -> Onrush {
        Onrush {
            interval,
            calm: 1.0 + SHARES[0] * (least - 1.0),
            course: Vec::with_capacity(MOST),
            last: None,
            impulse: 0.0,
        }
    }

    /// Takes F* at a time, s, during an impact or before it.
    pub fn push(&mut self, at: f64, force: f64, under_way: bool) {
        if !under_way && force <= self.calm {
            self.course.clear();
        }
        if self.course.last().is_none_or(|[last, _]| at - last >= self.interval) {
            if self.course.len() == MOST {
                self.course.drain(..MOST / 2);
            }
            self.course.push([at, force]);
        }
        if under_way {
            self.add(at, force);
        }
    }

    /// Takes F* at a time, s, only for the integral.
    pub fn add(&mut self, at: f64, force: f64) {
        if let Some([before, last]) = self.last {
            self.impulse += (at - before) * (0.5 * (last + force) - 1.0);
        }
        self.last = Some([at, force]);
    }

    /// An impact begins. Earlier samples are not part of it.
    pub fn begin(&mut self) {
        self.last = None;
        self.impulse = 0.0;
    }

    /// The next sample does not continue the last one.
    pub fn interrupt(&mut self) {
        self.last = None;
    }

    /// ∫ (F* - 1) dt over the impact, s.
    pub fn impulse(&self) -> f64 {
        self.impulse
    }

    /// Seconds from 10 % to 90 % of a maximum's height above still water. It begins where F* last
    /// rose through 10 % before the maximum. It ends where F* then first rose through 90 %.
    pub fn rise_time(&self, maximum: Maximum) -> Option<f64> {
        let [low, high] = SHARES.map(|share| 1.0 + share * (maximum.value - 1.0));
        let end = self.course.partition_point(|[time, _]| *time < maximum.time_s);
        let at = |place: usize| {
            if place < end { self.course[place] } else { [maximum.time_s, maximum.value] }
        };
        let rises = |place: &usize| at(*place)[1] <= low && at(place + 1)[1] > low;
        let begun = (0..end).rev().find(rises)?;
        let done = (begun..end).find(|place| at(place + 1)[1] >= high)?;
        let passed = |place: usize, value: f64| passed([at(place), at(place + 1)], value);
        Some(passed(done, high) - passed(begun, low))
    }
}

/// The time at which a value was passed between two samples.
fn passed([[t0, f0], [t1, f1]]: [[f64; 2]; 2], value: f64) -> f64 {
    t0 + (t1 - t0) * ((value - f0) / (f1 - f0)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_rises_in_four_fifths_of_its_time() {
        let mut onrush = Onrush::new(1.15, 0.0025);
        for step in 0..4000 {
            let time = 0.0005 * f64::from(step);
            // An earlier short rise that becomes calm again.
            let blip = if (0.3..0.4).contains(&time) { 0.3 } else { 0.0 };
            let force = 1.0 + blip + 2.0 * ((time - 1.0) / 0.25).clamp(0.0, 1.0);
            onrush.push(time, force, time >= 1.01);
        }
        let maximum = Maximum { value: 3.0, time_s: 1.25 };
        let rise = onrush.rise_time(maximum).unwrap();
        assert!((rise - 0.2).abs() < 1e-3, "{rise}");
        let exact = 2.0 * (1.9995 - 1.25) + 0.25 - 2.0 * 0.5 * 0.01 * 0.04;
        assert!((onrush.impulse() - exact).abs() < 1e-3, "{} for {exact}", onrush.impulse());
    }

    #[test]
    fn what_was_drowned_adds_nothing() {
        let mut onrush = Onrush::new(1.15, 0.001);
        onrush.begin();
        onrush.push(0.0, 2.0, true);
        onrush.push(0.1, 2.0, true);
        onrush.interrupt();
        onrush.push(0.3, 2.0, true);
        onrush.push(0.4, 2.0, true);
        assert!((onrush.impulse() - 0.2).abs() < 1e-12);
        onrush.begin();
        assert_eq!(onrush.impulse(), 0.0);
        assert_eq!(Onrush::new(1.15, 0.001).rise_time(Maximum { value: 2.0, time_s: 1.0 }), None);
    }
}
