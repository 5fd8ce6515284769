//! The place of a panel's axes, and the places of values between them.

use svg::node::element::Group;

use super::chart::Chart;
use super::labels::Field;
use super::legend::rows;
use super::text::{NORMAL, SMALL, width};

/// From the frame to tick labels, and from those to the title, CSS pixels.
pub const GAP: f64 = 7.0;
/// Length of a tick's stroke, CSS pixels.
pub const STROKE: f64 = 4.0;
/// From a panel's left edge to its legend, CSS pixels.
const EDGE: f64 = 6.0;

/// Room around a panel's frame, CSS pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// For labels and title of the vertical axis.
    pub left: f64,
    /// For what stands beside the last points.
    pub right: f64,
    /// For the heading, or a legend of its own.
    pub top: f64,
    /// For labels and title of the horizontal axis.
    pub bottom: f64,
}

impl Margins {
    /// Margins that are large enough for all panels of the given outer size.
    pub fn of(charts: &[Chart], size: (f64, f64)) -> Margins {
        let widest = |labels: &mut dyn Iterator<Item = &str>| {
            labels.map(|label| width(label, SMALL)).fold(0.0, f64::max)
        };
        let left =
            widest(&mut charts.iter().flat_map(|chart| &chart.y.ticks).map(|t| t.label.as_str()));
        let last = charts.iter().filter_map(|chart| chart.x.ticks.last());
        let right = widest(&mut last.map(|tick| tick.label.as_str())) / 2.0;
        let right = right.max(6.0) + 2.0;
        let headed = charts.iter().any(|chart| !chart.heading.is_empty());
        let legends = charts.iter().map(|chart| own_legend(chart, size.0 - right).1);
        let above = if headed { 22.0 } else { 10.0 };
        Margins {
            left: 3.0 + NORMAL + GAP + left + GAP,
            right,
            top: above + legends.fold(0.0, f64::max),
            bottom: STROKE + 4.0 + SMALL + 6.0 + NORMAL + 5.0,
        }
    }
}

/// A panel's own legend up to its right edge, and its height; empty where it has none.
pub fn own_legend(chart: &Chart, right: f64) -> (Group, f64) {
    let entries: Vec<_> = chart.entries().filter(|_| chart.legend).cloned().collect();
    rows(&entries, EDGE, right)
}

/// Where a panel's axes lie, CSS pixels.
#[derive(Debug, Clone)]
pub struct Frame<'a> {
    /// What is drawn.
    pub chart: &'a Chart,
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width.
    pub wide: f64,
    /// Height.
    pub high: f64,
}

impl<'a> Frame<'a> {
    /// The frame in a panel of the given outer size.
    pub fn new(chart: &'a Chart, margins: Margins, size: (f64, f64)) -> Frame<'a> {
        let (wide, high) =
            (size.0 - margins.left - margins.right, size.1 - margins.top - margins.bottom);
        Frame { chart, left: margins.left, top: margins.top, wide, high }
    }

    /// The place of a pair of values; values beyond the axes lie on the frame.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x(x), self.y(y))
    }

    /// Whether a pair of values has a place on both axes.
    pub fn holds(&self, x: f64, y: f64) -> bool {
        self.chart.x.holds(x) && self.chart.y.holds(y)
    }

    /// The rectangle of the axes.
    pub fn field(&self) -> Field {
        Field([self.left + 2.0, self.top, self.left + self.wide, self.top + self.high - 2.0])
    }

    /// A value's place from the left.
    pub fn x(&self, value: f64) -> f64 {
        self.left + self.wide * self.chart.x.share(value)
    }

    /// A value's place from the top.
    pub fn y(&self, value: f64) -> f64 {
        self.top + self.high * (1.0 - self.chart.y.share(value))
    }
}
