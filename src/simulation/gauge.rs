//! The wave gauge: crest of the first wave that passes.

use serde::{Deserialize, Serialize};

use super::looks::Looks;

/// The crest has passed once the level has dropped by this share of it.
const PASSED_DROP: f64 = 0.3;
/// Lower crests than this share of the still water depth are ripples.
const SMALLEST_CREST: f64 = 0.01;

/// A crest is found from this many readings.
const READINGS: usize = 5;

/// Follows the surface level over still water, reading by reading.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CrestGauge {
    /// First level, metres above the bed.
    at_rest: Option<f64>,
    looks: Looks,
    recent: Vec<f64>,
    crest: f64,
    passed: bool,
}

impl CrestGauge {
    /// Reserves the memory for its readings.
    pub fn make_room(&mut self) {
        self.recent.reserve_exact(READINGS + 1);
    }

    /// Whether to read it now, until the crest has passed; see [`Looks::is_due`].
    pub fn is_due(&mut self, time: f64, intervals: (f64, f64)) -> bool {
        !self.passed && self.looks.is_due(time, 0.0, intervals)
    }

    /// Takes a level, metres above the bed, over still water of this depth. `may_be_here` is
    /// whether the wave can have arrived. Coarse water over a slope makes small waves as it comes
    /// to rest, which are not the paddle's.
    pub fn read(&mut self, level: f64, depth: f64, may_be_here: bool) {
        let at_rest = *self.at_rest.get_or_insert(level);
        if may_be_here {
            self.push((level - at_rest) / depth);
        }
    }

    /// Takes a level over still water, over h. The level comes from a parabola through five
    /// readings, so that a single noisy one has little effect. Their mean would cut a sharp crest
    /// off.
    fn push(&mut self, level: f64) {
        self.recent.push(level);
        if self.recent.len() < READINGS || self.passed {
            return;
        }
        if self.recent.len() > READINGS {
            self.recent.remove(0);
        }
        let (middle, top) = parabola(&self.recent);
        self.crest = self.crest.max(top);
        self.passed = self.crest > SMALLEST_CREST && middle < (1.0 - PASSED_DROP) * self.crest;
    }

    /// Height of the first crest over h, once it has passed.
    pub fn crest(&self) -> Option<f64> {
        self.passed.then_some(self.crest)
    }
}

/// The best parabola through five equidistant readings: its height at the middle one, and at its
/// top if that is within half an interval of the middle.
fn parabola(readings: &[f64]) -> (f64, f64) {
    let with = |weights: [f64; READINGS]| -> f64 {
        weights.iter().zip(readings).map(|(weight, reading)| weight * reading).sum()
    };
    let middle = with([-3.0, 12.0, 17.0, 12.0, -3.0]) / 35.0;
    let slope = with([-2.0, -1.0, 0.0, 1.0, 2.0]) / 10.0;
    let bend = with([2.0, -1.0, -2.0, -1.0, 2.0]) / 7.0;
    let is_top = bend < 0.0 && slope.abs() <= -0.5 * bend;
    (middle, if is_top { middle - 0.5 * slope * slope / bend } else { middle })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_crest_counts_not_the_reflected_one() {
        let mut gauge = CrestGauge::default();
        for k in 0..400 {
            let t = 0.005 * f64::from(k);
            let pulse = |centre: f64, height: f64| height / ((t - centre) * 5.0).cosh().powi(2);
            gauge.push(pulse(0.7, 0.5) + pulse(1.6, 0.8));
            assert_eq!(gauge.crest().is_some(), t > 0.8325, "{t}");
        }
        assert!((gauge.crest().unwrap() - 0.5).abs() < 1e-3);
    }

    /// Ten rows over a slope of 1:3 once sent a wave of 0.011 h through the gauge. That was
    /// reported as the height of a wave of 0.13 h.
    #[test]
    fn what_passes_before_the_wave_can_is_no_crest() {
        let mut gauge = CrestGauge::default();
        for k in 0..800 {
            let t = 0.005 * f64::from(k);
            let pulse = |centre: f64, height: f64| height / ((t - centre) * 5.0).cosh().powi(2);
            gauge.read(0.2 + pulse(0.7, 0.003) + pulse(2.6, 0.026), 0.2, t >= 2.0);
        }
        assert!((gauge.crest().unwrap() - 0.13).abs() < 1e-3, "{:?}", gauge.crest());
    }

    #[test]
    fn a_sharp_crest_is_not_cut_off() {
        // The crest of a wave of H/h = 0.6. The mean of three readings loses a thousandth of it.
        for offset in [0.0, 0.001, 0.0025, 0.004] {
            let mut gauge = CrestGauge::default();
            for k in 0..400 {
                let time = 0.005 * f64::from(k) + offset;
                gauge.push(0.6 / ((time - 0.7) * 8.2).cosh().powi(2));
            }
            assert!((gauge.crest().unwrap() / 0.6 - 1.0).abs() < 2e-5, "{offset}");
        }
    }

    #[test]
    fn a_coarse_history_does_not_make_the_crest_lower() {
        let crest = |history_interval: f64| {
            let (mut gauge, mut readings) = (CrestGauge::default(), 0);
            for k in 0..2000 {
                let time = 0.001 * f64::from(k);
                if gauge.is_due(time, (history_interval, 0.1428)) {
                    readings += 1;
                    gauge.read(0.2 + 0.1 / ((time - 0.7) * 5.0).cosh().powi(2), 0.2, true);
                }
            }
            (gauge.crest().unwrap(), readings)
        };
        let (fine, coarse) = (crest(0.005), crest(0.5));
        assert!((coarse.0 - fine.0).abs() < 1e-3, "{coarse:?}");
        // None after the crest.
        assert!((150..190).contains(&fine.1), "{fine:?}");
    }
}
