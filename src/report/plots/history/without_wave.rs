//! Histories of scenes without a paddle: one figure of a few cases.

use super::{CURVES, dropped, read, strips};
use crate::quantities::history::FORCE;
use crate::quantities::summary::WAVE_HEIGHT_RATIO;
use crate::report::curves::spread;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::Figure;
use crate::report::plots::over_time::{self, Strip};

/// The figure of scenes without a paddle: a still tank, a dam break, a flow with an exact answer.
pub(super) fn figure(data: &Loaded) -> Result<Option<Figure>, ReportError> {
    let rows: Vec<_> =
        data.finished().filter(|row| row.number(&WAVE_HEIGHT_RATIO).is_none()).collect();
    let chosen = spread(&rows, CURVES).into_iter().map(|row| (row.words(), row)).collect();
    let lines = read(data, chosen)?;
    let mut strips = strips(&lines);
    if rows.is_empty() {
        return Ok(None);
    }
    let weightless = weightless_unit(data);
    if let Some(unit) = weightless {
        strips.iter_mut().filter(|strip| strip.name == FORCE.name).for_each(|strip| {
            strip.title = format!("F / ({unit})");
        });
    }
    strips.retain(Strip::holds_anything);
    if strips.is_empty() {
        return Ok(None);
    }
    let drop = dropped(lines.len(), rows.len(), "without a wave", "spread over their order");
    let what = match weightless {
        Some(_) => {
            "Force (unfiltered) along x on the right wall, over time; U is the largest speed at the \
             start, L the box's side."
        }
        None => {
            "Force (unfiltered) along x on the right wall and level at it above still water, over \
             time; h is the depth of the still water or the height of the column."
        }
    };
    Ok(Some(Figure {
        drawing: over_time::strips(&strips),
        name: "history".to_owned(),
        title: "Histories".to_owned(),
        caption: format!("{what} Spikes of one or two samples may leave the panel.{drop}"),
    }))
}

/// What F* is over where there is no gravity.
fn weightless_unit(data: &Loaded) -> Option<&'static str> {
    let frame = data.case(0)?.scene.frame();
    (frame.gravity == 0.0).then(|| frame.force_unit())
}
