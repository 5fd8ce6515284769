//! Error against processor time, a dot for every method, both axes logarithmic.

use super::Figure;
use super::axes::{Axis, Panel};
use super::pen::{Align, Look, draw};
use crate::report::error::ReportError;

/// A method.
#[derive(Debug, Clone, Copy)]
pub struct Dot<'a> {
    /// What stands beside it.
    pub name: &'a str,
    /// Processor time, seconds.
    pub x: f64,
    /// Error, percent.
    pub y: f64,
    /// On the Pareto front.
    pub filled: bool,
}

const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 66.0;
const TOP: f64 = 20.0;

/// The figure; `None` without dots.
pub fn error_against_time(dots: &[Dot<'_>]) -> Result<Option<Figure>, ReportError> {
    let name = "error-against-time";
    let good: Vec<_> = dots.iter().filter(|dot| dot.x > 0.0 && dot.y > 0.0).collect();
    let x = Axis::around(good.iter().map(|dot| libm::log10(dot.x)), 6.0);
    let y = Axis::around(good.iter().map(|dot| libm::log10(dot.y)), 6.0);
    let Some((x, y)) = x.zip(y) else { return Ok(None) };
    let panel = Panel { left: LEFT, top: TOP, width: WIDTH, height: HEIGHT, x, y };
    let at = |dot: &Dot<'_>| panel.at(libm::log10(dot.x), libm::log10(dot.y));
    let svg = draw(name, (LEFT + WIDTH + 110.0, TOP + HEIGHT + 48.0), |pen| {
        panel.draw(pen, true)?;
        panel.title_x(pen, "log₁₀ of the processor time, s")?;
        panel.title_y(pen, "log₁₀ of the error, %")?;
        let mut front: Vec<_> = good.iter().filter(|dot| dot.filled).map(|dot| at(dot)).collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        if front.len() > 1 {
            pen.line(&front, Look::of(0).colour, 1.2)?;
        }
        for dot in &good {
            let (px, py) = at(dot);
            pen.marker((px, py), Look::of(0), !dot.filled)?;
            pen.text((px + 7.0, py - 6.0), dot.name, 9.5, Align::Left)?;
        }
        Ok(())
    })?;
    Ok(Some(Figure {
        name: name.to_owned(),
        title: "Error against processor time".to_owned(),
        caption: "Root mean square error over all cases against the processor time that they \
                  take together. Filled: nothing is both cheaper and more accurate."
            .to_owned(),
        svg,
    }))
}
