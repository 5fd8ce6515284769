//! Time histories at the wall: force, runup and displacement. With waves, each wave height has one
//! figure with a few curves. They are spread over the stiffnesses, over the masses at one
//! stiffness, or over other swept keys. Without waves, one figure has a few cases.

mod without_wave;

use super::look::Look;
use super::marks::{said, shown_are, wave_said};
use super::over_time::{self, Strip};
use super::{COMBINATIONS, Figure, SERIES, file_name, left_out, of_variant};
use crate::math::lists::grouped;
use crate::math::words::counted;
use crate::quantities::history::{DISPLACEMENT, FORCE, RUNUP};
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FORCE_MAX, RUNUP_MAX, SEAWALL_MASS, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO,
};
use crate::report::curves::{distinct, spread};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::row::Row;
use crate::report::series::History;
use crate::report::spoken::all_spoken;

const CURVES: usize = 6;
/// How many wave heights have figures.
const WAVES: usize = 12;

/// One case's history with its label in the legend.
struct Line {
    label: String,
    case: String,
    history: History,
    /// Its largest force, runup and displacement, as the page quotes them.
    quoted: [Option<f64>; 3],
}

/// The figures of wave heights, and of cases without a wave.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut figures = Vec::new();
    let waves = distinct(data.finished(), &WAVE_HEIGHT_RATIO);
    let digits = number::digits_apart(waves.iter().copied());
    let few_waves = left_out(waves.len(), WAVES, "wave heights");
    for wave in spread(&waves, WAVES) {
        let rows = data.finished().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(wave));
        let rows: Vec<_> = rows.collect();
        let called =
            wave_said(rows.iter().copied(), format!("H/h = {}", number::as_typed_to(wave, digits)));
        let groups = groups(rows);
        let few_groups = left_out(groups.len(), SERIES, COMBINATIONS);
        let wave = number::as_typed_to(wave, digits);
        for rows in spread(&groups, SERIES) {
            let gathers = rows.iter().any(|row| row.variant != rows[0].variant);
            let variant = if gathers { "" } else { &rows[0].variant };
            let (chosen, common, picked) = if gathers { gather(&rows) } else { choose(&rows) };
            let lines = read(data, chosen)?;
            if lines.is_empty() {
                continue;
            }
            let drop = dropped(lines.len(), rows.len(), "of this wave height", &picked);
            figures.push(Figure {
                drawing: over_time::strips(&strips(&lines)),
                caption: format!("{}{drop}{few_groups}{few_waves}", shown(&lines, &common)),
                title: format!("Histories, {called}{}", of_variant(variant)),
                name: file_name(&format!("history-wave-{wave}"), variant),
            });
        }
    }
    figures.extend(without_wave::figure(data)?);
    Ok(figures)
}

/// Cases of one wave that share a figure: a variant's, or all if each has its own variant.
fn groups(rows: Vec<&Row>) -> Vec<Vec<&Row>> {
    let groups = grouped(rows.iter().map(|row| (&row.variant, *row)));
    if groups.len() == rows.len() { vec![rows] } else { groups }
}

/// The end of a caption: what was picked, if not all cases are shown.
fn dropped(shown: usize, cases: usize, whose: &str, picked: &str) -> String {
    if shown >= cases {
        return String::new();
    }
    format!(" {} of {cases} finished cases {whose}: {picked}.", shown_are(shown))
}

/// The histories of cases that have more than one sample.
fn read(data: &Loaded, chosen: Vec<(String, &Row)>) -> Result<Vec<Line>, ReportError> {
    let mut lines = Vec::new();
    for (label, row) in chosen {
        let case = row.id().to_owned();
        let history = data.history(&case)?;
        if history.0.iter().any(|series| series.points.len() > 1) {
            let quoted = [&FORCE_MAX, &RUNUP_MAX, &DISPLACEMENT_MAX].map(|of| row.number(of));
            lines.push(Line { label, case, history, quoted });
        }
    }
    Ok(lines)
}

/// At most [`CURVES`] cases with different variants. Returns the same as [`choose`].
fn gather<'a>(rows: &[&'a Row]) -> (Vec<(String, &'a Row)>, String, String) {
    let wall = |row: &Row| row.wall_in_words().join(", ");
    let first = wall(rows[0]);
    let alike = rows.iter().all(|row| wall(row) == first);
    let label = |row: &'a Row| {
        let words = [if alike { String::new() } else { wall(row) }, all_spoken(&row.variant)];
        (words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", "), row)
    };
    let common = if alike && !first.is_empty() { format!(", {first}") } else { String::new() };
    let chosen = spread(rows, CURVES).into_iter().map(label).collect();
    (chosen, common, "spread over their order".to_owned())
}

/// At most [`CURVES`] cases and their labels, what they have in common, and how they were picked.
fn choose<'a>(rows: &[&'a Row]) -> (Vec<(String, &'a Row)>, String, String) {
    let springless = || rows.iter().copied().filter(|row| row.is_springless());
    let movable = || rows.iter().copied().filter(|row| !row.is_fixed() && !row.is_springless());
    let room = CURVES - usize::from(springless().next().is_some());
    let stiffnesses = distinct(movable(), &SPRING_STIFFNESS);
    let masses = distinct(movable(), &SEAWALL_MASS);
    let middle = masses.get(masses.len().saturating_sub(1) / 2);
    let (varied, held, kept, plural) = if stiffnesses.len() > 1 {
        ((&SPRING_STIFFNESS, &stiffnesses), &SEAWALL_MASS, middle, "stiffnesses")
    } else {
        ((&SEAWALL_MASS, &masses), &SPRING_STIFFNESS, stiffnesses.first(), "masses")
    };
    let mut chosen: Vec<(String, &Row)> = Vec::new();
    let (mut common, mut picked) = (String::new(), String::new());
    if let Some(&kept) = kept {
        let (column, values) = varied;
        common = format!(", {}", said(movable(), held, kept));
        for value in spread(values, room) {
            let is_it =
                |row: &&Row| row.number(column) == Some(value) && row.number(held) == Some(kept);
            chosen.extend(movable().find(is_it).map(|row| (said(movable(), column, value), row)));
        }
        picked = format!("{} of {} {plural}", chosen.len(), values.len());
        if held == &SEAWALL_MASS && masses.len() > 1 {
            picked.push_str(&format!(" at one of {} masses", masses.len()));
        }
    }
    let kind = springless().next().map_or("", Row::kind);
    let weights = distinct(springless(), &SEAWALL_MASS);
    let drawn = spread(&weights, CURVES - chosen.len());
    for &mass in &drawn {
        let label = format!("{kind}, {}", said(springless(), &SEAWALL_MASS, mass));
        let is_it = |row: &&Row| row.number(&SEAWALL_MASS) == Some(mass);
        chosen.extend(springless().find(is_it).map(|row| (label, row)));
    }
    if !drawn.is_empty() {
        let before = if picked.is_empty() { "" } else { ", " };
        picked.push_str(&format!("{before}{} of {}", drawn.len(), counted(weights.len(), kind)));
    }
    let fixed = rows.iter().copied().find(|row| row.is_fixed());
    if fixed.is_some() && !picked.is_empty() {
        picked.push_str(", and the fixed wall");
    }
    chosen.extend(fixed.map(|row| ("fixed wall".to_owned(), row)));
    (chosen, common, picked)
}

fn moves(lines: &[Line]) -> bool {
    lines.iter().flat_map(|line| line.history.points(DISPLACEMENT.name)).any(|(_, x)| *x != 0.0)
}

/// Whether any water reaches the wall. A dry wall that no wave reaches has no force to show.
fn presses(lines: &[Line]) -> bool {
    lines.iter().flat_map(|line| line.history.points(FORCE.name)).any(|(_, force)| *force != 0.0)
}

/// What is drawn, for the caption.
fn shown(lines: &[Line], common: &str) -> String {
    let what = match (presses(lines), moves(lines)) {
        (false, true) => {
            "Runup and displacement of a wall to which no water comes: it has no force"
        }
        (false, false) => "Runup before the wall, to which no water comes: it has no force",
        (true, true) => "Force (unfiltered), runup and displacement at the wall",
        (true, false) => "Force (unfiltered) and runup at the wall",
    };
    let spikes = match presses(lines) {
        true => " Spikes of one or two samples may leave the panel.",
        false => "",
    };
    format!("{what}{common}, over time.{spikes}")
}

fn strips(lines: &[Line]) -> Vec<Strip> {
    let all = [&FORCE, &RUNUP, &DISPLACEMENT];
    let drawn = usize::from(!presses(lines))..if moves(lines) { 3 } else { 2 };
    let curve = |(index, line): (usize, &Line), name: &str| {
        let points = line.history.points(name).to_vec();
        let mut curve = over_time::Line::new(index, &line.label, &line.case, points);
        // Later curves have no look of their own: the fixed wall is drawn in ink.
        if index >= CURVES {
            curve.entry.look = Look::ink();
        }
        curve
    };
    let strip = |at: usize| Strip {
        title: all[at].unit.axis().to_owned(),
        name: all[at].name.to_owned(),
        curves: lines.iter().enumerate().map(|line| curve(line, all[at].name)).collect(),
        quoted: lines.iter().filter_map(|line| line.quoted[at]).collect(),
        ..Strip::default()
    };
    drawn.map(strip).collect()
}

#[cfg(test)]
mod tests;
