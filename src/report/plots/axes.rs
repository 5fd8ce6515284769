//! An axis: its range, its ticks, and where a value lies on it.

use super::ticks::{Tick, linear, logarithmic};
use crate::math::lists::ends;
use crate::math::scale::Scale;

/// The range of an axis and its ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    scale: Scale,
    /// Places with a label.
    pub ticks: Vec<Tick>,
    /// Places with only a small stroke.
    pub minor: Vec<f64>,
}

impl Axis {
    /// An axis for the given values with about `ticks` ticks and a small margin at both ends;
    /// `None` without values.
    pub fn around(values: impl Iterator<Item = f64>, ticks: f64) -> Option<Axis> {
        Axis::even(values, ticks, 0.05)
    }

    /// An axis that ends exactly at the lowest and highest value.
    pub fn within(values: impl Iterator<Item = f64>, ticks: f64) -> Option<Axis> {
        Axis::even(values, ticks, 0.0)
    }

    fn even(values: impl Iterator<Item = f64>, ticks: f64, air: f64) -> Option<Axis> {
        let (low, high) = ends(values.filter(|value| value.is_finite()))?;
        let least = 1e-6_f64.max(0.02 * low.abs().max(high.abs()));
        let span = high - low;
        // A single value stands in the middle: the axis goes from 0.5 to 1.5 times it.
        let lone = if high.abs() > least { 0.5 * high.abs() } else { 0.5 };
        let margin = if span < least { lone } else { air * span };
        let (low, high) = (low - margin, high + margin);
        let ticks = linear(low, high, ticks);
        Some(Axis { low, high, scale: Scale::Linear, ticks, minor: Vec::new() })
    }

    /// A logarithmic axis for the given values. Values that are not above 0 have no place on it.
    pub fn logarithmic(values: impl Iterator<Item = f64>) -> Option<Axis> {
        let (low, high) = ends(values.filter(|value| value.is_finite() && *value > 0.0))?;
        let margin = libm::pow(high / low, 0.05).max(1.26);
        let (low, high) = (low / margin, high * margin);
        let (ticks, minor) = logarithmic(low, high);
        Some(Axis { low, high, scale: Scale::Log, ticks, minor })
    }

    /// A place for each word, one after the other: 0, 1, 2 and so on.
    pub fn steps(words: Vec<String>) -> Axis {
        let high = words.len() as f64 - 0.5;
        let tick = |(index, label)| Tick { at: index as f64, label };
        let ticks = words.into_iter().enumerate().map(tick).collect();
        Axis { low: -0.5, high, scale: Scale::Linear, ticks, minor: Vec::new() }
    }

    /// Whether a value has a place on the axis.
    pub fn holds(&self, value: f64) -> bool {
        value.is_finite() && (self.scale == Scale::Linear || value > 0.0)
    }

    /// How far along the axis a value lies: 0 at its start, 1 at its end, and never beyond.
    pub fn share(&self, value: f64) -> f64 {
        let along = match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log if value <= 0.0 => 0.0,
            Scale::Log => libm::log(value / self.low) / libm::log(self.high / self.low),
        };
        along.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_still_makes_an_axis() {
        let axis = Axis::around([3.0].into_iter(), 5.0).unwrap();
        assert!(axis.low < 3.0 && axis.high > 3.0 && axis.ticks.len() > 3);
        // The story: a wave of 0.1 had an axis from -0.4 to 0.6, a force of 30 one from 27 to 33.
        for value in [0.1, -0.3, 3.0, 30.0] {
            let axis = Axis::around([value].into_iter(), 5.0).unwrap();
            assert!(axis.low * axis.high > 0.0 && axis.ticks.len() > 3, "{axis:?}");
        }
        let naught = Axis::around([0.0].into_iter(), 5.0).unwrap();
        assert_eq!((naught.low, naught.high), (-0.5, 0.5));
        assert_eq!(Axis::around([f64::NAN].into_iter(), 5.0), None);
        assert!(Axis::logarithmic([500.0].into_iter()).unwrap().ticks.len() > 3);
    }

    #[test]
    fn naught_has_no_place_on_a_logarithmic_axis() {
        let axis = Axis::logarithmic([0.0, 1.0, 100.0].into_iter()).unwrap();
        assert!(!axis.holds(0.0) && axis.holds(1.0));
        assert!((axis.share(10.0) - 0.5).abs() < 1e-12);
        assert_eq!((axis.share(0.0), axis.share(1e9)), (0.0, 1.0));
        assert_eq!(Axis::logarithmic([0.0].into_iter()), None);
    }
}
