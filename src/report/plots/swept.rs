//! Responses against a swept key that is not the wave's height, if the stiffness was not swept: a
//! panel each for force, runup and displacement, one curve per wave height.

mod beds;

use std::collections::{HashMap, HashSet};

use super::axes::Axis;
use super::chart::{Chart, reach};
use super::marks::{bounds, by, coupling, marks, picked, point};
use super::sheet::{Drawing, PANELS};
use super::{Figure, SERIES, of_variant};
use crate::math::lists::grouped;
use crate::math::scale::Scale;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FIRST_FORCE_MAX, FORCE_MAX, OVERTOPPING_VOLUME, RESULTS, SEAWALL_MASS,
    WAVE_HEIGHT_RATIO,
};
use crate::quantities::{Column, heading};
use crate::report::curves::{distinct, has_curve, responses, spread, variants};
use crate::report::load::Loaded;
use crate::report::row::Row;
use crate::report::study::Key;
use crate::report::variant::{file_name, shorten, words};

/// The columns for these cases: of regular waves those of the whole run.
fn drawn(group: &[Case]) -> [&'static Column; RESULTS.len()] {
    let regular = group.iter().any(|(_, row)| row.regular);
    RESULTS.map(|column| if regular { column.of_whole_run() } else { column })
}

/// One case: its place on the horizontal axis and its row.
type Case<'a> = (f64, &'a Row);

/// The key whose values are beds. Their places are their slopes or heights.
const BED: &str = "bed";

/// The first swept key of numbers or of beds with different places, besides the wave's height.
/// `None` if cases differ in stiffness alone: then response curves show them.
pub fn key(data: &Loaded) -> Option<&Key> {
    let sorted = |variant: &String| responses(&data.rows, variant, &FIRST_FORCE_MAX);
    if variants(&data.rows).iter().any(|variant| has_curve(&sorted(variant))) {
        return None;
    }
    data.keys.iter().find(|key| {
        let cases = cases(data, key);
        key.name != WAVE_HEIGHT_RATIO.name && cases.iter().any(|(x, _)| *x != cases[0].0)
    })
}

/// Caissons against the wave's height, if no other figure of responses has them.
pub fn caissons(data: &Loaded, elsewhere: Option<&Key>) -> Vec<Figure> {
    let drawn = elsewhere.map(|key| cases(data, key)).unwrap_or_default();
    let drawn: HashSet<_> = drawn.into_iter().map(|(_, row)| row.id()).collect();
    let of_variant = |variant: String| {
        let own = data.of_variant(&variant).filter(|row| row.is_springless());
        let own = own.filter(|row| !drawn.contains(row.id()));
        let mut group: Vec<Case> =
            own.filter_map(|row| Some((row.number(&WAVE_HEIGHT_RATIO)?, row))).collect();
        group.sort_by(|a, b| a.0.total_cmp(&b.0));
        if group.first()?.0 == group.last()?.0 {
            return None;
        }
        let rows = || group.iter().map(|(_, row)| *row);
        let masses = distinct(rows(), &SEAWALL_MASS);
        let shown = spread(&masses, SERIES);
        let title = WAVE_HEIGHT_RATIO.heading();
        let drawing = drawing((&title, WAVE_HEIGHT_RATIO.name), &group, &SEAWALL_MASS, &shown)?;
        let kind = group[0].1.kind();
        let of = format!("the nominal wave height {title}; one curve per mass of a {kind}.");
        let caption = caption(&of, &group) + &picked(shown.len(), masses.len(), "masses");
        let name = file_name("caissons-against-wave", &variant);
        let title = format!(
            "Responses of a {kind} against the nominal wave height{}",
            of_variant(&variant)
        );
        Some(Figure { drawing, title, caption, name })
    };
    variants(&data.rows).into_iter().filter_map(of_variant).collect()
}

/// Finished cases with a number in the key's column.
fn cases<'a>(data: &'a Loaded, key: &Key) -> Vec<Case<'a>> {
    let (measure, _) = measure(key);
    let place = |(row, cell): (&'a Row, &str)| {
        let x = measure(cell)?;
        (row.is_ok() && x.is_finite()).then_some((x, row))
    };
    data.rows.iter().zip(key.cells.iter()).filter_map(place).collect()
}

/// The function that places a cell of the key on the axis, and the axis title.
fn measure(key: &Key) -> (fn(&str) -> Option<f64>, String) {
    if key.name != BED {
        return (|cell| cell.parse().ok(), heading(&key.name));
    }
    let (place, told) = beds::measure(key);
    (place, told.to_owned())
}

/// Whether a row has its place on the key's axis.
pub fn holds(data: &Loaded, key: &Key, row: &Row) -> bool {
    cases(data, key).iter().any(|(_, other)| other.id() == row.id())
}

/// The figures, one for each combination of the other swept keys.
pub fn figures(data: &Loaded, key: &Key) -> Vec<Figure> {
    let waves = spread(&distinct(data.rows.iter(), &WAVE_HEIGHT_RATIO), SERIES);
    let others: HashMap<_, _> = data.rows.iter().map(Row::id).zip(others(data, key)).collect();
    let of = |(_, row): &Case| others[row.id()].as_str();
    let groups = grouped(cases(data, key).into_iter().map(|case| (of(&case), case)));
    // Another depth at the paddle changes the depth at the wall, and not in proportion.
    let over_beds = data.keys.iter().any(|key| key.name == BED)
        || data.file.as_ref().is_some_and(|file| file.scene.contains_key(BED));
    let (_, heading) = measure(key);
    let mut figures = Vec::new();
    for mut group in groups {
        let words = of(&group[0]);
        group.sort_by(|a, b| a.0.total_cmp(&b.0));
        let stem = format!("swept-{}", key.name.replace('_', "-"));
        let name = file_name(&stem, words);
        let along = (heading.as_str(), key.name.as_str());
        let Some(drawing) = drawing(along, &group, &WAVE_HEIGHT_RATIO, &waves) else { continue };
        let what = heading.split(", ").next().unwrap_or(&heading);
        figures.push(Figure {
            drawing,
            title: format!("Responses against {what}{}", of_variant(words)),
            caption: caption(&by_waves(what, &group, over_beds), &group) + &picked_waves(&group),
            name,
        });
    }
    figures
}

/// The other swept keys that vary, in words for every row.
fn others(data: &Loaded, key: &Key) -> Vec<String> {
    let varies = |other: &&Key| {
        other.name != key.name
            && other.name != WAVE_HEIGHT_RATIO.name
            && other.cells.different().nth(1).is_some()
    };
    let others = data.keys.iter().filter(varies);
    let others: Vec<_> = others.map(|key| (key.name.clone(), shorten(&key.cells))).collect();
    (0..data.rows.len()).map(|row| words(&others, row)).collect()
}

/// The caption's words on the key and on the curves.
fn by_waves(what: &str, group: &[Case], over_beds: bool) -> String {
    let curves =
        if nominal(group).is_empty() { "." } else { "; one curve per nominal wave height." };
    let counts = match over_beds {
        true => {
            " F* counts by the depth at the wall, or by the still water's where the wall stands dry."
        }
        false => "",
    };
    format!("{what}{curves}{counts}")
}

fn nominal(group: &[Case]) -> Vec<f64> {
    distinct(group.iter().map(|(_, row)| *row), &WAVE_HEIGHT_RATIO)
}

fn picked_waves(group: &[Case]) -> String {
    picked(SERIES, nominal(group).len(), "wave heights")
}

fn caption(against: &str, group: &[Case]) -> String {
    let rows: Vec<_> = group.iter().map(|(_, row)| *row).collect();
    let has = |column| rows.iter().any(|row| row.number(column).is_some());
    let drawn = drawn(group);
    let lacks = rows.iter().any(|row| row.number(&FIRST_FORCE_MAX).is_none());
    let of = match has(&FIRST_FORCE_MAX) && !drawn.contains(&&FORCE_MAX) {
        false => "whole run",
        true if lacks => "first impact, or of the whole run where there is none",
        true => "first impact",
    };
    let mut text = format!(
        "Largest force (running mean) and runup of the {of}{}{}, against {against}",
        if has(&DISPLACEMENT_MAX) { ", and largest displacement of the run" } else { "" },
        if has(&OVERTOPPING_VOLUME) { ", and volume that went over the crest" } else { "" }
    );
    text.push_str(&coupling(rows.iter().copied()));
    text.push_str(&marks(&rows, &drawn));
    text
}

/// The drawing; `None` where no case has a response.
fn drawing(
    (title, name): (&str, &str),
    group: &[Case],
    series: &Column,
    values: &[f64],
) -> Option<Drawing> {
    let places = || group.iter().map(|(x, _)| *x);
    let wide = Scale::of(places()) == Scale::Log;
    let x = if wide { Axis::logarithmic(places()) } else { Axis::around(places(), 5.0) }?;
    let chart = |column: &'static Column| {
        let whole = column.of_whole_run();
        let point = |x: f64, row: &Row| point(row, x, column).or_else(|| point(row, x, whole));
        let mut curves = by(series, values, group, point);
        let y = Axis::around(reach(&curves), 6.0)?;
        curves.extend(bounds(&curves));
        let heading = column.heading();
        let what = if column.unit.is_ratio() { column.unit.axis() } else { &heading };
        Some(Chart::new((x.clone(), y), [title, what], [name, column.name], curves))
    };
    Drawing::filled(drawn(group).into_iter().filter_map(chart).collect(), PANELS)
}

#[cfg(test)]
mod tests;
