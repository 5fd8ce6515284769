//! Responses against one parameter in its own unit: stiffness k on a logarithmic axis, mass m*,
//! wave height. Force, runup and displacement stand side by side. Rows are values of a second
//! parameter, curves those of the third.

use super::axes::Axis;
use super::chart::{Chart, Curve, Point, places, points, reach};
use super::marks::{bounds, by, coupling, key, marks, picked, point, said, springless};
use super::sheet::{Drawing, PANELS};
use super::{Figure, SERIES, file_name, of_variant};
use crate::quantities::summary::{M_STAR, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, Unit};
use crate::report::curves::{RESPONSES, distinct, spread, variants};
use crate::report::load::Loaded;
use crate::report::row::Row;

/// Values of the second parameter, at most.
const ROWS: usize = 3;
/// A page also holds other values, up to so many, and shows them when a choice asks for them.
const MOST_ROWS: usize = 8;
const MOST_SERIES: usize = 12;

/// How far the arrow of a bound reaches up on a logarithmic axis.
const ARROW: f64 = 2.0;

/// One cut through a study.
struct Slice {
    name: &'static str,
    /// The column on the horizontal axis, and its words.
    along: &'static Column,
    what: &'static str,
    /// The column that tells curves apart, and its words.
    series: &'static Column,
    curves: &'static str,
    /// The column that tells rows of panels apart, and its words.
    rows: &'static Column,
    held: &'static str,
    /// Whether the axes of parameter and displacement are logarithmic.
    logarithmic: bool,
}

const SLICES: [Slice; 3] = [
    Slice {
        name: "stiffness",
        along: &SPRING_STIFFNESS,
        what: "the spring stiffness k",
        series: &M_STAR,
        curves: "masses",
        rows: &WAVE_HEIGHT_RATIO,
        held: "wave heights",
        logarithmic: true,
    },
    Slice {
        name: "mass",
        along: &M_STAR,
        what: "the wall mass m* = m/(ρh²)",
        series: &SPRING_STIFFNESS,
        curves: "stiffnesses",
        rows: &WAVE_HEIGHT_RATIO,
        held: "wave heights",
        logarithmic: false,
    },
    Slice {
        name: "wave",
        along: &WAVE_HEIGHT_RATIO,
        what: "the nominal wave height H/h",
        series: &SPRING_STIFFNESS,
        curves: "stiffnesses",
        rows: &M_STAR,
        held: "masses",
        logarithmic: false,
    },
];

/// The figures of every variant in which a parameter has more than one value.
pub fn figures(data: &Loaded) -> Vec<Figure> {
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        let rows: Vec<_> = data.of_variant(&variant).collect();
        figures.extend(SLICES.iter().filter_map(|slice| slice.figure(&rows, &variant)));
    }
    figures
}

impl Slice {
    fn figure(&self, rows: &[&Row], variant: &str) -> Option<Figure> {
        let needed = [self.along, self.series, self.rows];
        let has = |row: &&&Row| needed.iter().all(|column| row.number(column).is_some());
        let all = || rows.iter().filter(has).copied();
        let rows: Vec<&Row> = all().filter(|row| self.draws(row)).collect();
        let naught = if self.logarithmic { springless(all()) } else { "" };
        let values = |column: &Column| distinct(rows.iter().copied(), column);
        if values(self.along).len() < 2 {
            return None;
        }
        let (series, held) = (values(self.series), values(self.rows));
        let shown = [spread(&series, SERIES), spread(&held, ROWS)];
        let all = [with_spare(&shown[0], &series, MOST_SERIES), {
            let mut rows = with_spare(&shown[1], &held, MOST_ROWS);
            rows.sort_by(f64::total_cmp);
            rows
        }];
        let charts = self.charts(&rows, &all, &shown);
        let scale = if self.logarithmic { " X* stands on a logarithmic axis." } else { "" };
        let counts = picked(shown[0].len(), series.len(), self.curves)
            + &picked(shown[1].len(), held.len(), self.held);
        let more = all.iter().zip(&shown).any(|(all, shown)| all.len() > shown.len());
        let more = if more { " In the page a choice of cases shows the others." } else { "" };
        Some(Figure {
            title: format!("Responses against {}{}", self.what, of_variant(variant)),
            caption: format!(
                "Largest force and runup of the first impact and largest displacement of the run \
                 against {}.{naught}{scale}{}{}{counts}{more}",
                self.what,
                marks(&rows, &RESPONSES),
                coupling(rows.iter().copied()),
            ),
            name: file_name(&format!("against-{}", self.name), variant),
            drawing: Drawing::filled(charts, PANELS)?,
        })
    }

    /// Whether a case has anything to show. A logarithmic axis has no place for 0. Still water has
    /// no first impact and moves no wall: its panels would be empty.
    fn draws(&self, row: &Row) -> bool {
        let above = |column: &Column| row.number(column).is_some_and(|value| value > 0.0);
        (above(self.along) || !self.logarithmic) && RESPONSES.iter().any(|column| above(column))
    }

    /// A row of panels per value of the second parameter. Panels in a column share their axes.
    fn charts(
        &self,
        rows: &[&Row],
        [series, held]: &[Vec<f64>; 2],
        [seen, kept]: &[Vec<f64>; 2],
    ) -> Vec<Chart> {
        let seen: Vec<_> = seen.iter().map(|value| key(self.series, *value)).collect();
        let curves = |value: f64, column: &'static Column| {
            let of_value = rows.iter().filter(|row| row.number(self.rows) == Some(value));
            let mut cases: Vec<_> =
                of_value.filter_map(|row| Some((row.number(self.along)?, *row))).collect();
            cases.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut curves = by(self.series, series, &cases, |x, row| point(row, x, column));
            for entry in curves.iter_mut().map(|curve| &mut curve.entry) {
                entry.spare = !entry.key.is_empty() && !seen.contains(&entry.key);
            }
            curves
        };
        let title = self.along.heading();
        let panel = |value: f64, column: &'static Column| {
            let all: Vec<_> = held.iter().flat_map(|held| curves(*held, column)).collect();
            let (x, y) = self.axes(column, &all)?;
            let drawn = curves(value, column).into_iter().chain(bounds(&all)).collect();
            let (titles, names) = ([&title, column.unit.axis()], [self.along.name, column.name]);
            let mut chart = Chart::new((x, y), titles, names, drawn);
            chart.spare = !kept.contains(&value);
            let heading = said(rows.iter().copied(), self.rows, value);
            Some(chart.under(heading, key(self.rows, value)))
        };
        let cells = held.iter().flat_map(|value| RESPONSES.map(|column| panel(*value, column)));
        cells.flatten().collect()
    }

    fn axes(&self, column: &Column, curves: &[Curve]) -> Option<(Axis, Axis)> {
        let x = if self.logarithmic {
            Axis::logarithmic(places(curves))
        } else {
            Axis::around(places(curves), 5.0)
        };
        let y = if self.logarithmic && column.unit == Unit::Displacement {
            // An arrow needs room above its marker.
            let top = |point: &Point| if point.bound { ARROW * point.y } else { point.y };
            Axis::logarithmic(points(curves).flat_map(|point| [point.y, top(point)]))
        } else {
            Axis::around(reach(curves), 6.0)
        };
        x.zip(y)
    }
}

/// First the values that are shown, then those for a choice of cases, unless there are too many.
fn with_spare(shown: &[f64], all: &[f64], most: usize) -> Vec<f64> {
    let rest = all.iter().filter(|value| all.len() <= most && !shown.contains(value));
    shown.iter().chain(rest).copied().collect()
}

#[cfg(test)]
mod tests;
