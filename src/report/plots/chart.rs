//! What stands in one panel.

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
    /// Only a lower bound: an open marker with an arrow.
    pub bound: bool,
    /// An open marker.
    pub open: bool,
    /// The ids of the cases that it stands for, separated by spaces.
    pub case: String,
    /// Case, value and bar, for a pointer that rests on it.
    pub told: String,
    /// What stands beside it.
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
    /// Its words in the legend, if any, and its look.
    pub entry: Entry,
    /// Its points; none where it stands in the legend alone.
    pub points: Vec<Point>,
}

impl Curve {
    /// A curve whose points have nothing but their places.
    pub fn through(entry: Entry, points: impl IntoIterator<Item = (f64, f64)>) -> Curve {
        Curve { entry, points: points.into_iter().map(Point::from).collect() }
    }

    /// A plain line at one level, as far as others reach.
    pub fn level(label: impl Into<String>, level: f64, others: &[Curve]) -> Curve {
        let (low, high) = ends(places(others)).unwrap_or_default();
        Curve::through(Entry::line(label, Look::plain()), [(low, level), (high, level)])
    }

    /// The lower and upper ends of all points; a bound has no upper end, but an arrow.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        let up = |point: &Point| if point.bound { 0.06 * point.y } else { point.error };
        self.points.iter().flat_map(move |point| [point.y - point.error, point.y + up(point)])
    }
}

/// The points of all curves.
pub fn points(curves: &[Curve]) -> impl Iterator<Item = &Point> + Clone {
    curves.iter().flat_map(|curve| &curve.points)
}

/// Their places on the horizontal axis.
pub fn places(curves: &[Curve]) -> impl Iterator<Item = f64> + Clone {
    points(curves).map(|point| point.x)
}

/// How far their values reach up and down, bars and arrows included.
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
    /// What stands above it; may be empty.
    pub heading: String,
    /// What all of it has in common, as `key=value`; may be empty.
    pub key: String,
    /// Titles of the horizontal and the vertical axis.
    pub titles: [String; 2],
    /// Names of the two quantities, for programs that read the drawing.
    pub names: [String; 2],
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, the last on top.
    pub curves: Vec<Curve>,
    /// Fields of a map, under the curves.
    pub cells: Vec<Cell>,
    /// Only in a page, where a choice of cases asks for it.
    pub spare: bool,
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
        }
    }

    /// With words above it, and what all of it has in common as `key=value`.
    pub fn under(self, heading: impl Into<String>, key: impl Into<String>) -> Chart {
        Chart { heading: heading.into(), key: key.into(), ..self }
    }
}
