//! The largest force, and where it is.

use crate::quantities::Column;
use crate::quantities::summary::{CASE_ID, FIRST_FORCE_MAX, FORCE_MAX, FORCE_MAX_ERROR};
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::words::{at, result};
use crate::report::row::Row;
use crate::report::scene_file::SceneFile;

/// A later force is told where it is larger than that of the first impact by more than this share.
const NOTABLE: f64 = 0.02;

/// The largest force of a case: that of the first impact, or of the whole run where it has none.
pub fn column(row: &Row) -> &'static Column {
    if row.number(&FIRST_FORCE_MAX).is_some() { &FIRST_FORCE_MAX } else { &FORCE_MAX }
}

/// The row that has the most of something.
pub fn most<'a>(
    rows: impl Iterator<Item = &'a Row>,
    read: impl Fn(&Row) -> Option<f64>,
) -> Option<(&'a Row, f64)> {
    let values = rows.filter_map(|row| Some((row, read(row)?)));
    values.filter(|(_, value)| value.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The largest force as F* and in kN/m, and the case that has it.
pub fn largest(data: &Loaded, file: Option<&SceneFile>) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(column(row)))?;
    let alone = data.rows.len() == 1;
    let is = if alone { "The largest force is" } else { "The largest force of all is" };
    let mut text = format!(
        "{is} {}{}{}.",
        result("F*", row, column(row))?,
        newtons(data, file, row, force),
        at(row)
    );
    if column(row) == &FIRST_FORCE_MAX {
        text.push_str(" It is that of the first impact.");
        text.push_str(&later(data, force).unwrap_or_default());
    }
    Some(text)
}

/// A force of later in a run that is larger still.
fn later(data: &Loaded, first: f64) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(&FORCE_MAX))?;
    if force <= first * (1.0 + NOTABLE) {
        return None;
    }
    let bar = row.number(&FORCE_MAX_ERROR).unwrap_or(0.0);
    Some(format!(" A later one reaches F* = {}{}.", number::with_error(force, bar), at(row)))
}

/// `, that is 0.77 kN per metre of wall`: F* times ½ρgh² of the row's own scene.
fn newtons(data: &Loaded, file: Option<&SceneFile>, row: &Row, force: f64) -> String {
    let scale = || {
        let index = data.rows.iter().position(|r| r.text(&CASE_ID) == row.text(&CASE_ID))?;
        let cells: Vec<_> = data.keys.iter().map(|key| key.cells[index].as_str()).collect();
        let frame = file?.config(&cells)?.scene.frame();
        Some(0.5 * frame.density * frame.acceleration() * frame.depth * frame.depth)
    };
    let told = |scale: f64| {
        let force = number::significant(force * scale / 1000.0, 3);
        format!(", that is {force} kN per metre of wall,")
    };
    scale().map(told).unwrap_or_default()
}
