//! What the papers print, as markers in a study's figures.

use super::chart::{Curve, Point};
use super::legend::Entry;
use super::look::Look;
use crate::papers::{Printed, printed, scenes};
use crate::quantities::Column;
use crate::report::config::each_config;
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row};

/// The legend's words.
pub(in crate::report) const PRINTED: &str = "printed in the papers";

/// The look of printed numbers in all figures.
pub(in crate::report) fn entry() -> Entry {
    Entry::dots(PRINTED, Look::plain().printed(), false).keyed("printed")
}

/// A printed number as a point.
pub(in crate::report) fn point(place: (f64, f64), row: &Row, printed: &Printed) -> Point {
    let told = format!("printed in Fig. {}: {} {}", printed.figure, printed.value, printed.unit);
    let case = row.id().to_owned();
    Point { open: true, case, told: told.trim_end().to_owned(), ..place.into() }
}

/// Markers of a panel: what the papers print for this column and these cases, at their places in
/// the column `x`. `None` if they print nothing.
pub fn beside(data: &Loaded, column: &Column, rows: &[&Row], x: &Column) -> Option<Curve> {
    let mut points: Vec<Point> = Vec::new();
    for number in printed().iter().filter(|number| number.quantity == column.name) {
        let own = rows.iter().filter(|row| number.holds_at(PLACE.map(|c| row.number(c))));
        for row in own.filter(|row| is_theirs(data, row, number)) {
            let point = row.number(x).map(|x| point((x, number.value), row, number));
            points.extend(point.filter(|point| !points.contains(point)));
        }
    }
    (!points.is_empty()).then(|| Curve { entry: entry(), points })
}

/// Whether a case has the scene of a printed number.
fn is_theirs(data: &Loaded, row: &Row, number: &Printed) -> bool {
    let place = data.rows.iter().position(|other| std::ptr::eq(other, row));
    let config = each_config(data, place.into_iter()).next().flatten();
    config.is_some_and(|config| scenes(&config.scene).any(|scene| scene == number.scene))
}
