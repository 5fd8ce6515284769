//! From rows to points, and what captions say of them.

use super::chart::{Curve, Point};
use super::legend::Entry;
use super::look::Look;
use crate::quantities::Column;
use crate::quantities::summary::{CASE_ID, FORCE_COUPLING};
use crate::report::curves::distinct;
use crate::report::number::{plain, with_error};
use crate::report::row::{Row, label};

/// A case's point, if it has a number.
pub fn point(row: &Row, x: f64, column: &Column) -> Option<Point> {
    let y = row.number(column).filter(|value| value.is_finite())?;
    Some(Point {
        x,
        y,
        error: row.error(column).filter(|error| error.is_finite()).unwrap_or(0.0),
        bound: row.is_bound(column),
        case: row.text(&CASE_ID).to_owned(),
        told: told(row, column),
        ..Point::default()
    })
}

/// Case, value and bar in words.
pub fn told(row: &Row, column: &Column) -> String {
    let error = row.error(column).unwrap_or(0.0);
    let value = row.number(column).unwrap_or(f64::NAN);
    let value = if error > 0.0 { with_error(value, error) } else { row.brief(column) };
    let sign = if row.is_bound(column) { "≥" } else { "=" };
    let said = format!("{} {sign} {value}", column.symbol);
    let case = row.words();
    if case.is_empty() { said } else { format!("{case}: {said}") }
}

/// A curve for every value of a column that occurs among the cases, each with the look of the value's
/// place among all `values`, and one for cases without a value.
pub fn by(
    column: &Column,
    values: &[f64],
    cases: &[(f64, &Row)],
    value: impl Fn(f64, &Row) -> Option<Point>,
) -> Vec<Curve> {
    let all = values.iter().map(|value| Some(*value)).chain([None]).enumerate();
    let curve = |(index, own): (usize, Option<f64>)| {
        let cases = cases.iter().filter(|(_, row)| row.number(column) == own);
        let points: Vec<_> = cases.filter_map(|(x, row)| value(*x, row)).collect();
        let entry = match own {
            Some(own) => Entry::marked(label(column, own), Look::of(index)).keyed(key(column, own)),
            None => Entry::marked(String::new(), Look::of(0)),
        };
        (!points.is_empty()).then_some(Curve { entry, points })
    };
    all.filter_map(curve).collect()
}

/// A value of a column as programs read it.
pub fn key(column: &Column, value: f64) -> String {
    format!("{}={value}", column.name)
}

/// What the legend says of bounds, where there are any.
pub fn bounds(curves: &[Curve]) -> Option<Curve> {
    let any = curves.iter().flat_map(|curve| &curve.points).any(|point| point.bound);
    let entry = Entry::dots("lower bound: still moving at the end", Look::plain(), true);
    any.then_some(Curve { entry, points: Vec::new() })
}

/// The motion law that cases follow, as every figure of a movable wall has to say.
pub fn coupling<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let factors = distinct(rows.filter(|row| !row.is_fixed()), &FORCE_COUPLING);
    let factors: Vec<_> = factors.into_iter().map(plain).collect();
    if factors.is_empty() {
        return String::new();
    }
    format!(" Force coupling s = {}.", factors.join(", "))
}

/// What a caption says of error bars and of open markers, as far as there are any.
pub fn marks(rows: &[&Row], columns: &[&Column]) -> String {
    let any = |has: &dyn Fn(&Row, &Column) -> bool| {
        rows.iter().any(|row| columns.iter().any(|column| has(row, column)))
    };
    let mut text = String::new();
    if any(&|row, column| row.error(column).is_some()) {
        text.push_str(" Bars: estimated errors.");
    }
    if any(&|row, column| row.is_bound(column)) {
        text.push_str(
            " Open markers with an arrow: the wall was still moving outwards when the run ended, so \
             that the value is a lower bound; no line but dots goes through them.",
        );
    }
    text
}

/// The end of a caption: what was picked of many, where not all is drawn.
pub fn picked(shown: usize, all: usize, what: &str) -> String {
    if shown >= all {
        return String::new();
    }
    format!(" Shown are {shown} of {all} {what}.")
}
