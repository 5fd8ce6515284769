//! Where swept beds stand on an axis.

use std::collections::HashSet;

use toml::Value;

use crate::keys::{self, read_value};
use crate::report::study::Key;

/// The function that places a bed, and the axis title: whichever tells more beds apart.
pub(super) fn measure(key: &Key) -> (fn(&str) -> Option<f64>, &'static str) {
    let values = |of: fn(&str) -> Option<f64>| {
        key.cells.different().filter_map(of).map(f64::to_bits).collect::<HashSet<_>>().len()
    };
    match values(slope) < values(top) {
        true => (top, "highest place of the bed, m"),
        false => (slope, "mean slope of the bed"),
    }
}

/// The points of a bed.
fn points(cell: &str) -> Option<Vec<[f64; 2]>> {
    let bed = read_value(cell);
    let number = |point: &Value, at: usize| keys::number(point.get(at)?);
    let point = |point: &Value| Some([number(point, 0)?, number(point, 1)?]);
    bed.as_array()?.iter().map(point).collect()
}

/// Mean slope of a bed from the end of its level part to the wall; 0 for a level bed.
pub(super) fn slope(cell: &str) -> Option<f64> {
    let points = points(cell)?;
    let first =
        points.iter().position(|point| point[1] != 0.0).map_or(0, |at| at.saturating_sub(1));
    let ([x0, y0], [x1, y1]) = (points[first], *points.last()?);
    Some((y1 - y0) / (x1 - x0)).filter(|slope| slope.is_finite())
}

/// The highest place of a bed, metres.
fn top(cell: &str) -> Option<f64> {
    points(cell)?.into_iter().map(|point| point[1]).reduce(f64::max)
}
