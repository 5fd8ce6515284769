//! A rectangle with two axes, and what is drawn in it.

use svg::node::element::Group;

use super::chart::Chart;
use super::labels::Field;
use super::pen::{Align, drawn, group, line, strokes, text};
use super::text::{NORMAL, SMALL, width};
use super::trace::{field, notes, series};

/// From the frame to tick labels, and from those to the title, CSS pixels.
const GAP: f64 = 7.0;
const STROKE: f64 = 4.0;

/// Room around a panel's frame, CSS pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// For labels and title of the vertical axis.
    pub left: f64,
    /// For what stands beside the last points.
    pub right: f64,
    /// For the heading.
    pub top: f64,
    /// For labels and title of the horizontal axis.
    pub bottom: f64,
}

impl Margins {
    /// What all of the panels have room in.
    pub fn of(charts: &[Chart]) -> Margins {
        let widest = |labels: &mut dyn Iterator<Item = &str>| {
            labels.map(|label| width(label, SMALL)).fold(0.0, f64::max)
        };
        let left =
            widest(&mut charts.iter().flat_map(|chart| &chart.y.ticks).map(|t| t.label.as_str()));
        let last = charts.iter().filter_map(|chart| chart.x.ticks.last());
        let right = widest(&mut last.map(|tick| tick.label.as_str())) / 2.0;
        let headed = charts.iter().any(|chart| !chart.heading.is_empty());
        Margins {
            left: 3.0 + NORMAL + GAP + left + GAP,
            right: right.max(6.0) + 2.0,
            top: if headed { 22.0 } else { 10.0 },
            bottom: STROKE + 4.0 + SMALL + 6.0 + NORMAL + 5.0,
        }
    }
}

/// Where a panel's axes lie, CSS pixels.
#[derive(Debug, Clone)]
pub struct Frame<'a> {
    chart: &'a Chart,
    left: f64,
    top: f64,
    wide: f64,
    high: f64,
}

impl<'a> Frame<'a> {
    /// The frame in a panel of the given outer size.
    pub fn new(chart: &'a Chart, margins: Margins, size: (f64, f64)) -> Frame<'a> {
        let (wide, high) =
            (size.0 - margins.left - margins.right, size.1 - margins.top - margins.bottom);
        Frame { chart, left: margins.left, top: margins.top, wide, high }
    }

    /// Where a pair of values lies; values beyond the axes lie on the frame.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let (right, up) = (self.chart.x.share(x), self.chart.y.share(y));
        (self.left + self.wide * right, self.top + self.high * (1.0 - up))
    }

    /// Whether a pair of values has a place on both axes.
    pub fn holds(&self, x: f64, y: f64) -> bool {
        self.chart.x.holds(x) && self.chart.y.holds(y)
    }

    /// The rectangle of the axes.
    pub fn field(&self) -> Field {
        Field([self.left + 2.0, self.top, self.left + self.wide, self.top + self.high - 2.0])
    }

    /// Axes, fields and curves.
    pub fn draw(&self) -> Group {
        let chart = self.chart;
        let mut panel = group("panel").set("data-panel", chart.key.as_str());
        panel = panel.add(self.grid());
        for cell in &chart.cells {
            panel = panel.add(field(self, cell));
        }
        panel = panel.add(self.axis_x()).add(self.axis_y());
        for curve in chart.curves.iter().filter(|curve| !curve.points.is_empty()) {
            panel = panel.add(series(self, curve));
        }
        if let Some(notes) = notes(self, &chart.curves) {
            panel = panel.add(notes);
        }
        if chart.heading.is_empty() {
            return panel;
        }
        let above = (self.left + self.wide / 2.0, self.top - 11.0);
        panel.add(text(above, &chart.heading, NORMAL, Align::Centre).set("class", "heading"))
    }

    fn grid(&self) -> Group {
        let (right, bottom) = (self.left + self.wide, self.top + self.high);
        let upright = |x: f64| [(x, self.top), (x, bottom)];
        let level = |y: f64| [(self.left, y), (right, y)];
        let xs = self.chart.x.ticks.iter().map(|tick| upright(self.x(tick.at)));
        let ys = self.chart.y.ticks.iter().map(|tick| level(self.y(tick.at)));
        let lines: Vec<_> =
            if self.chart.cells.is_empty() { xs.chain(ys).collect() } else { Vec::new() };
        drawn(group("grid")).add(strokes("", &lines, 1.0).set("stroke-opacity", 0.13))
    }

    fn x(&self, value: f64) -> f64 {
        self.left + self.wide * self.chart.x.share(value)
    }

    fn y(&self, value: f64) -> f64 {
        self.top + self.high * (1.0 - self.chart.y.share(value))
    }

    fn axis_x(&self) -> Group {
        let (chart, bottom) = (self.chart, self.top + self.high);
        let mut axis = drawn(group("axis x")).set("data-name", chart.names[0].as_str());
        axis = axis.add(line("", &[(self.left, bottom), (self.left + self.wide, bottom)], 1.0));
        let stroke = |at: f64, long: f64| [(self.x(at), bottom), (self.x(at), bottom + long)];
        let long = chart.x.ticks.iter().map(|tick| stroke(tick.at, STROKE));
        let short = chart.x.minor.iter().map(|at| stroke(*at, 0.5 * STROKE));
        axis = axis.add(strokes("strokes", &long.chain(short).collect::<Vec<_>>(), 1.0));
        let below = bottom + STROKE + 4.0 + SMALL / 2.0;
        let mut free = f64::NEG_INFINITY;
        for tick in &chart.x.ticks {
            let (x, half) = (self.x(tick.at), width(&tick.label, SMALL) / 2.0);
            // Words that would run into those before are left out; their stroke stays.
            if tick.label.is_empty() || x - half < free {
                continue;
            }
            free = x + half + 3.0;
            let label = text((x, below), &tick.label, SMALL, Align::Centre);
            axis = axis.add(label.set("class", "tick"));
        }
        let under = below + SMALL / 2.0 + 6.0 + NORMAL / 2.0;
        let middle = (self.left + self.wide / 2.0, under);
        axis.add(text(middle, &chart.titles[0], NORMAL, Align::Centre).set("class", "title"))
    }

    fn axis_y(&self) -> Group {
        let chart = self.chart;
        let mut axis = drawn(group("axis y")).set("data-name", chart.names[1].as_str());
        axis = axis.add(line("", &[(self.left, self.top), (self.left, self.top + self.high)], 1.0));
        let stroke = |at: f64, long: f64| [(self.left, self.y(at)), (self.left - long, self.y(at))];
        let long = chart.y.ticks.iter().map(|tick| stroke(tick.at, STROKE));
        let short = chart.y.minor.iter().map(|at| stroke(*at, 0.5 * STROKE));
        axis = axis.add(strokes("strokes", &long.chain(short).collect::<Vec<_>>(), 1.0));
        for tick in &chart.y.ticks {
            let at = (self.left - GAP, self.y(tick.at));
            axis = axis.add(text(at, &tick.label, SMALL, Align::Right).set("class", "tick"));
        }
        let middle = (3.0 + NORMAL / 2.0, self.top + self.high / 2.0);
        axis.add(text(middle, &chart.titles[1], NORMAL, Align::Upwards).set("class", "title"))
    }
}
