//! Error against processor time, a dot for every method, both axes logarithmic.

use super::Figure;
use super::axes::Axis;
use super::legend::Entry;
use super::pen::Look;
use super::sheet::{Chart, Curve, Layout, Point, sheet};
use crate::report::error::ReportError;

/// A method.
#[derive(Debug, Clone)]
pub struct Dot {
    /// What stands beside it.
    pub name: String,
    /// Processor time, seconds.
    pub x: f64,
    /// Error, percent.
    pub y: f64,
    /// On the Pareto front.
    pub filled: bool,
}

/// The figure; `None` without dots.
pub fn error_against_time(dots: &[Dot]) -> Result<Option<Figure>, ReportError> {
    let name = "error-against-time";
    let good = || dots.iter().filter(|dot| dot.x > 0.0 && dot.y > 0.0);
    let point = |dot: &Dot| Point {
        x: libm::log10(dot.x),
        y: libm::log10(dot.y),
        open: !dot.filled,
        note: dot.name.clone(),
        ..Point::default()
    };
    let points: Vec<_> = good().map(point).collect();
    let x = Axis::around(points.iter().map(|point| point.x), 6.0);
    let y = Axis::around(points.iter().map(|point| point.y), 6.0);
    let Some((x, y)) = x.zip(y) else { return Ok(None) };
    let mut front: Vec<_> = points.iter().filter(|point| !point.open).cloned().collect();
    front.sort_by(|a, b| a.x.total_cmp(&b.x));
    let look = Look::of(0);
    let chart = Chart {
        heading: String::new(),
        titles: ["log₁₀ of the processor time, s", "log₁₀ of the error, %"].map(str::to_owned),
        x,
        y,
        curves: vec![
            Curve { entry: Entry::line(String::new(), look), points: front },
            Curve { entry: Entry::dots("", look, false), points },
        ],
    };
    let svg = sheet(name, &[chart], Layout { columns: 1, size: (620.0, 420.0) })?;
    Ok(Some(Figure {
        name: name.to_owned(),
        title: "Error against processor time".to_owned(),
        caption: "Root mean square error over all cases against the processor time that they \
                  take together. Filled: nothing is both cheaper and more accurate."
            .to_owned(),
        svg,
    }))
}
