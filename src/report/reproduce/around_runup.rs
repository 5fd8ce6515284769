//! Fig. 5 of Liang et al. 2017: the force on a fixed wall around the largest runup, one panel for low and
//! one for high waves.

use super::{Drawn, Material, drawn, panel};
use crate::quantities::history::FORCE;
use crate::quantities::summary::{CASE_ID, RUNUP_MAX, WAVE_HEIGHT_RATIO};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::{Axis, Curve, Entry, Layout, Look, key, lasting};
use crate::report::row::{Row, label};

/// How far around, over √(h/g).
const REACH: f64 = 6.0;
/// √(h/g) of the papers' tank, seconds.
fn unit_s() -> f64 {
    (0.2_f64 / 9.81).sqrt()
}

pub fn drawing(material: &Material, panels: &[Vec<f64>]) -> Result<Option<Drawn>, ReportError> {
    let mut charts = Vec::new();
    for waves in panels {
        let mut curves = Vec::new();
        for (data, row) in material.cases() {
            let wave = row.number(&WAVE_HEIGHT_RATIO).filter(|wave| waves.contains(wave));
            let Some(wave) = wave else { continue };
            // The panels share a legend, so no two waves may look alike.
            let index = panels.iter().flatten().position(|other| *other == wave).unwrap_or(0);
            let points = points(data, row)?;
            let entry = Entry::line(label(&WAVE_HEIGHT_RATIO, wave), Look::of(index));
            let entry = entry.keyed(key(&WAVE_HEIGHT_RATIO, wave));
            curves.push((
                Curve { entry, points: points.iter().map(|&p| p.into()).collect() },
                points,
            ));
        }
        let heights = curves.iter().flat_map(|(_, points)| lasting(points));
        let axes = Axis::within([-REACH, REACH].into_iter(), 6.0).zip(Axis::around(heights, 6.0));
        let Some((x, y)) = axes else { continue };
        let titles = ["(t − t₀) / √(h/g), t₀ at the largest runup", FORCE.unit.axis()];
        let (curves, heading) =
            (curves.into_iter().map(|(curve, _)| curve).collect(), String::new());
        let names = ["time_from_largest_runup", FORCE.name];
        charts.push(panel(heading, titles.map(str::to_owned), names, (x, y), curves));
    }
    if charts.is_empty() {
        return Ok(None);
    }
    let layout = Layout { columns: 1, size: (560.0, 260.0) };
    Ok(drawn(charts, layout, "The force is unfiltered.".to_owned()))
}

/// The force around the largest runup of a case.
fn points(data: &Loaded, row: &Row) -> Result<Vec<(f64, f64)>, ReportError> {
    let history = data.history(row.text(&CASE_ID))?;
    let (force, top) = (history.into_iter().find(|s| s.name == FORCE.name), row.time(&RUNUP_MAX));
    let Some((force, top)) = force.zip(top) else { return Ok(Vec::new()) };
    let points = force.points.into_iter().map(|(time, force)| ((time - top) / unit_s(), force));
    Ok(points.filter(|(time, _)| time.abs() <= REACH).collect())
}
