//! Panels of curves over time, side by side in rows, each with the same axis of time.

use super::axes::Axis;
use super::chart::{Chart, Curve};
use super::legend::Entry;
use super::look::Look;
use super::sheet::{Drawing, PANELS};
use crate::quantities::history::TIME;

/// Points of a curve, at most. A panel is some 250 pixels wide.
const MOST: usize = 300;

/// Points over time: time in seconds and value.
type Points = Vec<(f64, f64)>;

/// A curve over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its label in the legend.
    pub entry: Entry,
    /// What it shows.
    pub points: Points,
}

impl Line {
    /// The `index`-th line of a figure.
    pub fn new(index: usize, label: &str, case: &str, points: Points) -> Line {
        Line { entry: Entry::line(label, Look::of(index)).keyed(format!("case={case}")), points }
    }
}

/// Curves over time in one panel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Strip {
    /// Title of the vertical axis.
    pub title: String,
    /// Name of the quantity.
    pub name: String,
    /// A curve without points keeps its colour, so that others have the same in all panels.
    pub curves: Vec<Line>,
    /// Whether the axis reaches every peak, and not only lasting and quoted values.
    pub peaks: bool,
    /// Values that are quoted elsewhere: the axis reaches them, too.
    pub quoted: Vec<f64>,
    /// Whether the panel has a legend of its own.
    pub legend: bool,
}

impl Strip {
    /// Whether any value is not 0.
    pub fn holds_anything(&self) -> bool {
        self.points().any(|point| point.1 != 0.0)
    }

    fn points(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.curves.iter().flat_map(|line| &line.points)
    }

    fn axis(&self) -> Option<Axis> {
        if self.peaks {
            return Axis::around(self.points().map(|point| point.1), 4.0);
        }
        let lasting = self.curves.iter().flat_map(|line| lasting(&line.points));
        Axis::around(lasting.chain(self.quoted.iter().copied()), 4.0)
    }

    fn chart(&self, x: &Axis) -> Option<Chart> {
        let curve = |line: &Line| Curve::through(line.entry.clone(), thinned(&line.points, MOST));
        let curves = self.curves.iter().map(curve).collect();
        let (axes, titles) = ((x.clone(), self.axis()?), [TIME.unit.axis(), &self.title]);
        let chart = Chart::new(axes, titles, [TIME.name, &self.name], curves);
        Some(Chart { legend: self.legend, ..chart })
    }
}

/// The drawing of panels that hold points, side by side.
pub fn strips(strips: &[Strip]) -> Drawing {
    let times = strips.iter().flat_map(Strip::points).map(|point| point.0);
    let x = Axis::within(times, 6.0);
    let charts = x.iter().flat_map(|x| strips.iter().filter_map(|strip| strip.chart(x)));
    Drawing::new(charts.collect(), PANELS)
}

/// Medians of five values each, which keep lasting values. An axis made for these is not squashed
/// by the pulse of a wall that hits its stop.
pub fn lasting(points: &[(f64, f64)]) -> Vec<f64> {
    let values: Vec<f64> = points.iter().map(|point| point.1).collect();
    let middle = |window: &[f64]| {
        let mut window = window.to_vec();
        window.sort_by(f64::total_cmp);
        window[window.len() / 2]
    };
    if values.len() < 5 { values } else { values.windows(5).map(middle).collect() }
}

/// At most so many points with the same peaks: the lowest and highest of every bucket, in order.
pub fn thinned(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let size = points.len().div_ceil(most / 2);
    if size < 3 {
        return points.to_vec();
    }
    let ends = |bucket: &[(f64, f64)]| {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let low = *bucket.iter().min_by(by_value).expect("chunks are not empty");
        let high = *bucket.iter().max_by(by_value).expect("chunks are not empty");
        if low.0 <= high.0 { [low, high] } else { [high, low] }
    };
    points.chunks(size).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_does_not_last() {
        let points: Vec<_> =
            (0..100).map(|i| (f64::from(i), if i == 50 { -20.0 } else { 1.0 })).collect();
        assert!(lasting(&points).iter().all(|force| *force == 1.0));
        assert!(lasting(&[]).is_empty());
    }

    #[test]
    fn thinning_keeps_the_peak() {
        let points: Vec<_> = (0..5000).map(|i| (f64::from(i), f64::from(i % 977))).collect();
        let thinned = thinned(&points, MOST);
        assert!(thinned.len() <= MOST);
        assert!(thinned.iter().any(|point| point.1 == 976.0));
        assert!(thinned.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }
}
