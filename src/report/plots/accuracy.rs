//! Error against processor time, a dot for every method, both axes logarithmic.

use super::Figure;
use super::axes::Axis;
use super::chart::{Chart, Curve, Point};
use super::legend::Entry;
use super::look::Look;
use super::sheet::{Drawing, Layout};

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
pub fn error_against_time(dots: &[Dot]) -> Option<Figure> {
    let point = |dot: &Dot| Point {
        x: dot.x,
        y: dot.y,
        open: !dot.filled,
        told: format!("{}: {} s, {} %", dot.name, dot.x, dot.y),
        note: dot.name.clone(),
        ..Point::default()
    };
    let points: Vec<_> = dots.iter().filter(|dot| dot.x > 0.0 && dot.y > 0.0).map(point).collect();
    let x = Axis::logarithmic(points.iter().map(|point| point.x))?;
    let y = Axis::logarithmic(points.iter().map(|point| point.y))?;
    let mut front: Vec<_> = points.iter().filter(|point| !point.open).cloned().collect();
    front.sort_by(|a, b| a.x.total_cmp(&b.x));
    let look = Look::of(0);
    let curves = vec![
        Curve { entry: Entry::line("", look), points: front },
        Curve { entry: Entry::dots("", look, false), points },
    ];
    let titles = ["processor time, s", "error, %"];
    let chart = Chart::new((x, y), titles, ["cpu_time_s", "error_percent"], curves);
    Some(Figure {
        name: "error-against-time".to_owned(),
        title: "Error against processor time".to_owned(),
        caption: "Root mean square error over all cases against the processor time that they \
                  take together. Filled: nothing is both cheaper and more accurate."
            .to_owned(),
        drawing: Drawing::new(vec![chart], Layout { columns: 1, size: (900.0, 620.0) }),
    })
}
