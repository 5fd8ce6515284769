//! The content of one panel.

use super::axes::Axis;
use super::legend::Entry;
use super::look::Look;
use crate::math::lists::ends;

/// One point of a curve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Point {
    /// Place on the horizontal axis.
    pub x: f64,
    /// Place on the vertical axis.
    pub y: f64,
    /// Half the length of its error bar.
    pub error: f64,
    /// Whether it is only a lower bound: an open marker with an arrow.
    pub bound: bool,
    /// Whether its marker is open.
    pub open: bool,
    /// The ids of the cases that it stands for, separated by spaces.
    pub case: String,
    /// Case, value and bar, shown when a pointer rests on it.
    pub told: String,
    /// The note beside it.
    pub note: String,
}

impl From<(f64, f64)> for Point {
    fn from((x, y): (f64, f64)) -> Point {
        Point { x, y, ..Point::default() }
    }
}

/// Points that belong together, and how they look.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its label in the legend, if any, and its look.
    pub entry: Entry,
    /// Its points; empty where it stands only in the legend.
    pub points: Vec<Point>,
}

impl Curve {
    /// A curve whose points have only their places.
    pub fn through(entry: Entry, points: impl IntoIterator<Item = (f64, f64)>) -> Curve {
        Curve { entry, points: points.into_iter().map(Point::from).collect() }
    }

    /// A plain line at one level, as long as the other curves.
    pub fn level(label: impl Into<String>, level: f64, others: &[Curve]) -> Curve {
        let (low, high) = ends(places(others)).unwrap_or_default();
        Curve::through(Entry::line(label, Look::ink()), [(low, level), (high, level)])
    }

    /// The lower and upper ends of all points. A bound has an arrow as its upper end.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        let up = |point: &Point| if point.bound { 0.06 * point.y } else { point.error };
        self.points.iter().flat_map(move |point| [point.y - point.error, point.y + up(point)])
    }
}

/// The points of all curves.
pub fn points(curves: &[Curve]) -> impl Iterator<Item = &Point> + Clone {
    curves.iter().flat_map(|curve| &curve.points)
}

/// The places of all points on the horizontal axis.
pub fn places(curves: &[Curve]) -> impl Iterator<Item = f64> + Clone {
    points(curves).map(|point| point.x)
}

/// How far the values reach up and down, with bars and arrows.
pub fn reach(curves: &[Curve]) -> impl Iterator<Item = f64> {
    curves.iter().flat_map(Curve::reach)
}

/// A coloured field of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Column and row, from the axes' starts.
    pub at: (usize, usize),
    /// Its colour: red, green and blue.
    pub colour: [u8; 3],
    /// Its number; empty where there is no room.
    pub label: String,
    /// The id of its case.
    pub case: String,
    /// Case, value and bar.
    pub told: String,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The heading; may be empty.
    pub heading: String,
    /// What all its points have in common, as `key=value`; may be empty.
    pub key: String,
    /// Titles of the horizontal and the vertical axis.
    pub titles: [String; 2],
    /// Names of the two quantities, for programs that read the drawing.
    pub names: [String; 2],
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// The curves; the last one is on top.
    pub curves: Vec<Curve>,
    /// Fields of a map, below the curves.
    pub cells: Vec<Cell>,
    /// Shown only in a page, when a choice of cases asks for it.
    pub spare: bool,
    /// Whether its legend stands above its own axes, and not above all panels.
    pub legend: bool,
}

impl Chart {
    /// A panel without a heading: its axes, their titles, and the names of their quantities.
    pub fn new(
        (x, y): (Axis, Axis),
        titles: [&str; 2],
        names: [&str; 2],
        curves: Vec<Curve>,
    ) -> Chart {
        Chart {
            heading: String::new(),
            key: String::new(),
            titles: titles.map(str::to_owned),
            names: names.map(str::to_owned),
            x,
            y,
            curves,
            cells: Vec::new(),
            spare: false,
            legend: false,
        }
    }

    /// The entries of its legend: every curve with a label.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        let all = self.curves.iter().map(|curve| &curve.entry);
        all.filter(|entry| !entry.label.is_empty())
    }

    /// Adds a heading, and what all its points have in common as `key=value`.
    pub fn under(self, heading: impl Into<String>, key: impl Into<String>) -> Chart {
        Chart { heading: heading.into(), key: key.into(), ..self }
    }
}
