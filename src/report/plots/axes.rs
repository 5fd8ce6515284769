//! A rectangle with two axes: ranges, ticks, grid, labels.

use super::pen::{Align, Fault, INK, Pen, faint};

/// Height of tick labels and of axis titles, CSS pixels.
const TICK_SIZE: f64 = 11.0;
const TITLE_SIZE: f64 = 12.5;

/// The range of an axis and its ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    ticks: Vec<f64>,
    decimals: usize,
}

impl Axis {
    /// An axis for the given values with about `ticks` ticks and a little air at both ends;
    /// `None` without values.
    pub fn around(values: impl Iterator<Item = f64>, ticks: f64) -> Option<Axis> {
        Axis::new(values, ticks, 0.05)
    }

    /// Likewise, ending exactly at the lowest and highest value.
    pub fn within(values: impl Iterator<Item = f64>, ticks: f64) -> Option<Axis> {
        Axis::new(values, ticks, 0.0)
    }

    fn new(values: impl Iterator<Item = f64>, ticks: f64, air: f64) -> Option<Axis> {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return None;
        }
        let least = 1e-6_f64.max(0.02 * low.abs().max(high.abs()));
        let span = high - low;
        let margin = if span < least { 0.5_f64.max(0.1 * high.abs()) } else { air * span };
        let (low, high) = (low - margin, high + margin);
        let (step, decimals) = round_step((high - low) / ticks);
        let ticks = ((low / step).ceil() as i64..=(high / step).floor() as i64)
            .map(|index| index as f64 * step)
            .collect();
        Some(Axis { low, high, ticks, decimals })
    }

    fn label(&self, value: f64) -> String {
        format!("{value:.*}", self.decimals).replace('-', "\u{2212}")
    }

    fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

/// The step of 1, 2 or 5 times a power of ten next above `rough`, and the decimals it needs.
fn round_step(rough: f64) -> (f64, usize) {
    let mut decimals = 0;
    let mut unit = 1.0;
    while unit > rough && decimals < 9 {
        decimals += 1;
        unit = 10_f64.powi(-decimals);
    }
    while unit * 10.0 <= rough {
        unit *= 10.0;
    }
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * unit).into_iter().find(|s| *s >= rough);
    let step = step.unwrap_or(unit);
    let needed = if step >= 10.0 * unit { decimals - 1 } else { decimals };
    (step, usize::try_from(needed).unwrap_or(0))
}

/// A panel on the sheet, in CSS pixels.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
}

impl Panel {
    /// Where a pair of values lies on the sheet.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let right = self.x.share(x).clamp(0.0, 1.0);
        let up = self.y.share(y).clamp(0.0, 1.0);
        (self.left + self.width * right, self.top + self.height * (1.0 - up))
    }

    /// Frame, grid and tick labels; those of the horizontal axis only where asked for.
    pub fn draw(&self, pen: &Pen, label_x: bool) -> Result<(), Fault> {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        for &tick in &self.x.ticks {
            let (x, _) = self.at(tick, self.y.low);
            pen.line(&[(x, self.top), (x, bottom)], faint(0.12), 1.0)?;
            pen.line(&[(x, bottom), (x, bottom + 4.0)], INK, 1.0)?;
            if label_x {
                pen.text((x, bottom + 13.0), &self.x.label(tick), TICK_SIZE, Align::Centre)?;
            }
        }
        for &tick in &self.y.ticks {
            let (_, y) = self.at(self.x.low, tick);
            pen.line(&[(self.left, y), (right, y)], faint(0.12), 1.0)?;
            pen.line(&[(self.left - 4.0, y), (self.left, y)], INK, 1.0)?;
            pen.text((self.left - 7.0, y), &self.y.label(tick), TICK_SIZE, Align::Right)?;
        }
        let corners = [(self.left, self.top), (self.left, bottom), (right, bottom)];
        pen.line(&corners, INK, 1.0)
    }

    /// The title of the horizontal axis, under its labels.
    pub fn title_x(&self, pen: &Pen, title: &str) -> Result<(), Fault> {
        let at = (self.left + self.width / 2.0, self.top + self.height + 32.0);
        pen.text(at, title, TITLE_SIZE, Align::Centre)
    }

    /// The title of the vertical axis, to the left of its labels.
    pub fn title_y(&self, pen: &Pen, title: &str) -> Result<(), Fault> {
        let widest = self.y.ticks.iter().map(|tick| self.y.label(*tick).chars().count()).max();
        let labels = 7.0 + 0.58 * TICK_SIZE * widest.unwrap_or(0) as f64;
        let at = (self.left - (labels + 8.0).max(44.0), self.top + self.height / 2.0);
        pen.text(at, title, TITLE_SIZE, Align::Upwards)
    }

    /// A heading above the panel.
    pub fn heading(&self, pen: &Pen, text: &str) -> Result<(), Fault> {
        pen.text((self.left + self.width / 2.0, self.top - 11.0), text, TITLE_SIZE, Align::Centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::within([0.03, 0.97].into_iter(), 5.0).unwrap();
        let labels: Vec<_> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["0.2", "0.4", "0.6", "0.8"]);
        let axis = Axis::within([-4.6, 4.4].into_iter(), 6.0).unwrap();
        let labels: Vec<_> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["−4", "−2", "0", "2", "4"]);
        let axis = Axis::within([0.0, 35.0].into_iter(), 6.0).unwrap();
        let labels: Vec<_> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["0", "10", "20", "30"]);
    }

    #[test]
    fn one_value_still_makes_an_axis() {
        let axis = Axis::around([3.0].into_iter(), 5.0).unwrap();
        assert!(axis.low < 3.0 && axis.high > 3.0 && axis.ticks.len() > 2);
        assert_eq!(Axis::around([f64::NAN].into_iter(), 5.0), None);
    }
}
