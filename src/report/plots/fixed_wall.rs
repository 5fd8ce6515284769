//! Runup and force at a fixed wall against the wave's height. Goda's formula is drawn at upright
//! walls, and the exact solitary wave over level beds, too.

mod exact;

use super::axes::Axis;
use super::chart::{Chart, Curve, Point, places, reach};
use super::legend::Entry;
use super::look::Look;
use super::marks::point;
use super::sheet::{Drawing, PANELS};
use super::{COMBINATIONS, Figure, SERIES, file_name, left_out, of_variant, printed, swept};
use crate::quantities::Column;
use crate::quantities::summary::{
    FIRST_FORCE_MAX, FIRST_RUNUP_MAX, MEASURED_WAVE_HEIGHT_RATIO, WAVE_HEIGHT_RATIO,
};
use crate::report::curves::{spread, variants};
use crate::report::goda::{Setting, Settings};
use crate::report::load::Loaded;
use crate::report::number::significant;
use crate::report::row::Row;

/// The columns that are drawn side by side, and their places in [`exact::line`].
const SIDES: [(&Column, usize); 2] = [(&FIRST_RUNUP_MAX, 1), (&FIRST_FORCE_MAX, 2)];

/// The figure of every variant with fixed walls and waves.
pub fn figures(data: &Loaded) -> Vec<Figure> {
    let (key, settings) = (swept::key(data), Settings::of(data));
    let walls_of = |variant: String| {
        let (places, rows): (Vec<_>, Vec<_>) = walls(data, &variant).unzip();
        // A lone point makes no curve. It gets a figure only beside the exact wave, and if no other
        // figure has it.
        let elsewhere = |row: &Row| key.is_some_and(|key| swept::holds(data, key, row));
        let lone = rows.len() == 1 && rows.iter().all(|row| !row.is_vertical() || elsewhere(row));
        (!rows.is_empty() && !lone).then_some((variant, places, rows))
    };
    let groups: Vec<_> = variants(&data.rows).into_iter().filter_map(walls_of).collect();
    let few = left_out(groups.len(), SERIES, COMBINATIONS);
    let mut figures = Vec::new();
    for (variant, places, rows) in spread(&groups, SERIES) {
        let name = file_name("fixed-wall", &variant);
        let regular = rows.iter().any(|row| row.regular);
        let (sides, of) = match is_whole(data, &variant) {
            true => (SIDES.map(|(column, at)| (column.of_whole_run(), at)), "whole run"),
            false => (SIDES, "first impact"),
        };
        let known = |row: &&Row| row.number(&MEASURED_WAVE_HEIGHT_RATIO).is_some();
        let measured = !regular && rows.iter().all(known);
        let height = if measured { "measured at the gauge" } else { "nominal" };
        let pressed = rows.iter().any(|row| row.number(sides[1].0) != Some(0.0));
        let beside = if pressed { Beside::of(&settings, &places) } else { Beside::Nothing };
        let (shown, what, at, told) = match pressed {
            true => {
                let told = beside.caption(rows.iter().all(|row| row.is_vertical()));
                (&sides[..], "unup and force", ["at", "on"], told)
            }
            false => {
                let told = " The wall stands dry, and no water comes to it.";
                (&sides[..1], "unup", ["before", "before"], told)
            }
        };
        let has_bar = |row: &&Row| sides.iter().any(|(column, _)| row.error(column).is_some());
        let bars = if rows.iter().any(has_bar) { " Bars: estimated errors." } else { "" };
        figures.push(Figure {
            drawing: drawing(data, &rows, shown, &beside, measured),
            title: format!("R{what} {} a fixed wall{}", at[0], of_variant(&variant)),
            caption: format!(
                "Largest r{what} of the {of} {} a fixed wall against the wave height ({height}).{told}{bars}{few}",
                at[1]
            ),
            name,
        });
    }
    figures
}

/// Finished cases of a variant with a wave and a fixed wall, with their places among all rows.
pub fn walls<'a>(data: &'a Loaded, variant: &str) -> impl Iterator<Item = (usize, &'a Row)> {
    let sides = sides(data, variant);
    all(data, variant).filter(move |(_, row)| sides.iter().all(|of| row.number(of).is_some()))
}

/// The same cases, with or without results.
fn all<'a>(data: &'a Loaded, variant: &str) -> impl Iterator<Item = (usize, &'a Row)> {
    data.placed().filter(move |(_, row)| {
        row.is_fixed()
            && *row.variant == *variant
            && row.number(&WAVE_HEIGHT_RATIO).is_some_and(|wave| wave > 0.0)
    })
}

/// The columns for waves at fixed walls: runup and force of the first impact, or of the whole run.
pub fn sides(data: &Loaded, variant: &str) -> [&'static Column; 2] {
    let whole = is_whole(data, variant);
    SIDES.map(|(column, _)| if whole { column.of_whole_run() } else { column })
}

/// Whether whole runs count. They do for regular waves, as earlier waves change later ones, and for
/// walls that stand dry, where few waves come.
fn is_whole(data: &Loaded, variant: &str) -> bool {
    all(data, variant).any(|(_, row)| row.regular || row.stands_dry())
}

/// The curve that is drawn beside the cases.
enum Beside {
    /// The exact solitary wave and Goda's formula, if both hold for all cases.
    Exact,
    /// Goda's formula alone: over beds, for crests, for regular waves; one setting for each case.
    Goda(Vec<Option<Setting>>),
    /// Nothing.
    Nothing,
}

impl Beside {
    fn of(settings: &Settings, places: &[usize]) -> Beside {
        let each: Vec<_> = places.iter().map(|place| settings.at(*place)).collect();
        match &each[..] {
            all if all.iter().all(|one| one.is_some_and(Setting::is_plain)) => Beside::Exact,
            all if all.iter().any(Option::is_some) => Beside::Goda(each),
            _ => Beside::Nothing,
        }
    }

    fn caption(&self, vertical: bool) -> &'static str {
        match self {
            Beside::Exact => {
                " Line: the exact solitary wave of the Euler equations reflected by a vertical wall, \
                 computed for seven heights and smooth between them. Beside the force Goda's formula of 1974 for an upright wall, in the limit of long \
                 waves, with the solitary wave's height for H."
            }
            Beside::Goda(_) => {
                " Beside the force Goda's formula of 1974 for an upright wall, with the depth of the \
                 still water there and as far up as its crest; single waves in the limit of long \
                 ones, with their height for H."
            }
            Beside::Nothing if vertical => {
                " The wall stands dry, for which Goda's formula gives no force to compare with."
            }
            Beside::Nothing => {
                " The wall is inclined, for which there is no exact solution to compare with; the \
                 force is that along x."
            }
        }
    }

    /// Goda's curve over places on the horizontal axis. If it is not the same for all cases, there
    /// is a point for each.
    fn goda(&self, rows: &[&Row], wave: &Column) -> Option<Curve> {
        let line = |setting: Setting| {
            let words = if setting.is_plain() { "Goda, long waves" } else { "Goda" };
            let points = exact::waves().map(|wave| (wave, setting.force(wave)));
            Curve::through(Entry::line(words, Look::of(1)), points)
        };
        match self {
            Beside::Nothing => None,
            Beside::Exact => Some(line(Setting::PLAIN)),
            Beside::Goda(each) => {
                let first = each[0].filter(|first| !first.is_regular());
                if let Some(first) = first.filter(|_| each.iter().all(|one| *one == each[0])) {
                    return Some(line(first));
                }
                let point = |(row, setting): (&&Row, &Option<Setting>)| {
                    let (x, y) = (row.number(wave)?, setting.as_ref()?.of_case(row)?);
                    let told =
                        format!("{}: F* = {} by Goda's formula", row.title(), significant(y, 4));
                    Some(Point { x, y, case: row.id().to_owned(), told, ..Point::default() })
                };
                let points = rows.iter().zip(each).filter_map(point).collect();
                Some(Curve { entry: Entry::dots("Goda", Look::of(1), false), points })
            }
        }
    }
}

/// A pair of panels.
fn drawing(
    data: &Loaded,
    rows: &[&Row],
    sides: &[(&Column, usize)],
    beside: &Beside,
    measured: bool,
) -> Drawing {
    let wave = if measured { &MEASURED_WAVE_HEIGHT_RATIO } else { &WAVE_HEIGHT_RATIO };
    let chart = |&(column, place): &(&Column, usize)| {
        let mut curves = Vec::new();
        if matches!(beside, Beside::Exact) {
            let entry = Entry::line("exact solitary wave", Look::ink());
            curves.push(Curve::through(entry, exact::line(place)));
        }
        if sides.iter().position(|side| side.0 == column) == Some(1) {
            curves.extend(beside.goda(rows, wave));
        }
        let points = rows.iter().filter_map(|row| point(row, row.number(wave)?, column));
        let entry = Entry::dots("computed", Look::of(0), false);
        curves.push(Curve { entry, points: points.collect() });
        curves.extend(printed::beside(data, column, rows, wave));
        let x = Axis::around(places(&curves), 6.0)?;
        let y = Axis::around(reach(&curves), 6.0)?;
        let title = wave.heading();
        let titles = [&title, column.unit.axis()];
        Some(Chart::new((x, y), titles, [wave.name, column.name], curves))
    };
    Drawing::new(sides.iter().filter_map(chart).collect(), PANELS)
}

#[cfg(test)]
mod tests;
