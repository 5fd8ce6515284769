//! Fig. 5 of Liang et al. 2017: the force on a fixed wall around the largest runup, one panel for low and
//! one for high waves.

use super::{Drawn, Material, drawn};
use crate::quantities::history::FORCE;
use crate::quantities::summary::{RUNUP_MAX, WAVE_HEIGHT_RATIO};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::{Axis, Chart, Curve, Entry, Layout, Look, key, lasting};
use crate::report::row::{Row, label};

/// How far before and after the largest runup, over √(h/g).
const REACH: f64 = 6.0;

/// √(h/g) of the papers' tank, seconds.
fn unit_s() -> f64 {
    (0.2_f64 / 9.81).sqrt()
}

pub fn drawing(material: &Material, panels: &[Vec<f64>]) -> Result<Option<Drawn>, ReportError> {
    let mut charts = Vec::new();
    for waves in panels {
        let (mut curves, mut heights) = (Vec::new(), Vec::new());
        for (data, row) in material.cases() {
            let wave = row.number(&WAVE_HEIGHT_RATIO).filter(|wave| waves.contains(wave));
            let Some(wave) = wave else { continue };
            // The panels share a legend, so no two waves may look alike.
            let index = panels.iter().flatten().position(|other| *other == wave).unwrap_or(0);
            let entry = Entry::line(label(&WAVE_HEIGHT_RATIO, wave), Look::of(index));
            let points = points(data, row)?;
            heights.extend(lasting(&points));
            curves.push(Curve::through(entry.keyed(key(&WAVE_HEIGHT_RATIO, wave)), points));
        }
        let y = Axis::around(heights.into_iter(), 6.0);
        let Some(axes) = Axis::within([-REACH, REACH].into_iter(), 6.0).zip(y) else { continue };
        let titles = ["(t − t₀) / √(h/g), t₀ at the largest runup", FORCE.unit.axis()];
        let names = ["time_from_largest_runup", FORCE.name];
        charts.push(Chart::new(axes, titles, names, curves));
    }
    let layout = Layout { columns: 1, size: (560.0, 260.0) };
    Ok(drawn(charts, layout, "The force is unfiltered."))
}

/// The force around the largest runup of a case.
fn points(data: &Loaded, row: &Row) -> Result<Vec<(f64, f64)>, ReportError> {
    let history = data.history(row.id())?;
    let Some(top) = row.time(&RUNUP_MAX) else { return Ok(Vec::new()) };
    let force =
        history.points(FORCE.name).iter().map(|(time, force)| ((time - top) / unit_s(), *force));
    Ok(force.filter(|(time, _)| time.abs() <= REACH).collect())
}
