//! Which physics and numerics are on, for `seawall check`.

use std::collections::{HashMap, HashSet};

use rayon::prelude::*;
use toml::{Table, Value};

use crate::keys::{Key, Section, Shared};
use crate::math::decimal::significant;
use crate::scene::{CaseConfig, Kind, Numerics, Scene, numerics_keys, scene_keys};
use crate::study::{Case, Study};

/// A key that is on, and its values among the cases: `none` where a case has none.
pub(super) struct Line {
    /// The key's name in files.
    pub name: &'static str,
    /// The key in a few words.
    pub label: String,
    /// Its unit, empty for names, counts and ratios.
    pub unit: &'static str,
    /// The values, in the order of the cases.
    pub values: Vec<String>,
}

/// How many cases are looked at in one go.
const CHUNK: usize = 1000;
/// How many values of a key are written out.
const MOST: usize = 8;
/// The most digits of numbers that people write, and of derived numbers that the program prints.
const WRITTEN: usize = 9;
const TOLD: usize = 4;

impl Line {
    /// The values, or the first of many. Readers know what the file says.
    pub(super) fn text(&self, file: &str) -> String {
        let first = self.values.iter().take(MOST).map(|value| rounded(value, file));
        let mut text = first.collect::<Vec<_>>().join(", ");
        if self.values.len() > MOST {
            text += &format!(", ... ({} values)", self.values.len());
        }
        if self.unit.is_empty() { text } else { format!("{text} {}", self.unit) }
    }
}

/// A value with few digits, if it is long and not in the file.
fn rounded(value: &str, file: &str) -> String {
    let derived = |number: &f64| significant(*number, WRITTEN) != *number && !file.contains(value);
    let number = value.parse().ok().filter(derived);
    number.map_or_else(|| value.to_owned(), |number| significant(number, TOLD).to_string())
}

/// The keys that are on, in the order of their declarations.
pub(super) fn physics(study: &Study) -> Vec<Line> {
    let keys = keys(study);
    let chunks = study.cases.par_chunks(CHUNK).map(|cases| occurring(&keys, cases));
    let mut columns: Vec<Column> = keys.iter().map(|_| Column::default()).collect();
    for chunk in chunks.collect::<Vec<_>>() {
        for (column, more) in columns.iter_mut().zip(chunk) {
            column.is_on |= more.is_on;
            more.values.into_iter().for_each(|value| column.take(value));
        }
    }
    let pairs = keys.iter().zip(columns);
    let mut lines: Vec<Line> = pairs.filter_map(|(key, column)| line(key, column)).collect();
    let probes = study.cases.first().map(|case| &case.config.probes[..]).unwrap_or_default();
    if !probes.is_empty() {
        let names: Vec<_> = probes.iter().map(|probe| probe.name.as_str()).collect();
        let values = vec![names.join(" ")];
        lines.push(Line { name: "probes", label: "probes".to_owned(), unit: "", values });
    }
    lines
}

/// The keys of the numerics, and of all kinds of scenes that occur.
fn keys(study: &Study) -> Vec<&'static Key> {
    let kinds: HashSet<_> = study.cases.iter().map(|case| case.config.scene.kind()).collect();
    let kinds = Kind::ALL.iter().filter(|kind| kinds.contains(kind.name()));
    let mut keys: Vec<&Key> = Vec::new();
    for key in kinds.flat_map(|&kind| scene_keys(kind)).chain(numerics_keys()) {
        if keys.iter().all(|earlier| earlier.name != key.name) {
            keys.push(key);
        }
    }
    keys
}

fn values(scene: &Scene, numerics: &Table) -> Table {
    let own = scene.entries().into_iter().map(|(key, value)| (key.to_owned(), value));
    let mut values: Table = own.collect();
    values.extend(numerics.iter().map(|(key, value)| (key.clone(), value.clone())));
    values
}

/// The different values of a key in order of appearance: `none` where a case has none.
#[derive(Default)]
struct Column {
    values: Vec<String>,
    seen: HashSet<String>,
    /// Whether any case has one.
    is_on: bool,
    /// Whether the last case has one.
    last_on: bool,
}

impl Column {
    fn take(&mut self, value: String) {
        if self.values.last() != Some(&value) && self.seen.insert(value.clone()) {
            self.values.push(value);
        }
    }
}

/// The values of each key among some cases. A case with all its keys is large, so none is kept.
fn occurring(keys: &[&'static Key], cases: &[Case]) -> Vec<Column> {
    let mut columns: Vec<Column> = keys.iter().map(|_| Column::default()).collect();
    let mut shared: Option<(&Shared<Numerics>, Table)> = None;
    let numerics_have = |name: &str| numerics_keys().iter().any(|key| key.name == name);
    let of_scene = |key: &&'static Key| !numerics_have(key.name) && !key.rule.newer;
    let places = keys.iter().enumerate().filter(|(_, key)| of_scene(key));
    let places: HashMap<_, _> = places.map(|(place, key)| (key.name, place)).collect();
    let mut before: Option<&CaseConfig> = None;
    for case in cases {
        let own = &case.config.numerics;
        if let Some(before) = before.replace(&case.config)
            && let Some(changes) = changes(&places, before, &case.config)
        {
            for (place, number) in changes {
                let column = &mut columns[place];
                if column.last_on {
                    column.take(text(&number.into()));
                }
            }
            continue;
        }
        let numerics = match shared.take() {
            Some((known, table)) if known == own => table,
            _ => own.table(),
        };
        let numerics = &shared.insert((own, numerics)).1;
        let case = values(&case.config.scene, numerics);
        for (key, column) in keys.iter().zip(&mut columns) {
            let value = case.get(key.name).filter(|_| key.is_on(&case));
            column.last_on = value.is_some();
            column.is_on |= column.last_on;
            column.take(value.map_or_else(|| "none".to_owned(), text));
        }
    }
    columns
}

/// The numbers in which a case differs from the one before, with the places of their keys. `None`
/// if anything else differs: names decide which keys are on, and so does a number that is 0.
fn changes(
    places: &HashMap<&'static str, usize>,
    before: &CaseConfig,
    case: &CaseConfig,
) -> Option<Vec<(usize, f64)>> {
    let mut names = Vec::new();
    if before.numerics != case.numerics || !before.scene.differing(&case.scene, &mut names) {
        return None;
    }
    let number =
        |scene: &Scene, name| scene.entry(name)?.as_float().filter(|&number| number != 0.0);
    let change = |name: &'static str| {
        number(&before.scene, name)?;
        Some((*places.get(name)?, number(&case.scene, name)?))
    };
    names.into_iter().map(change).collect()
}

fn line(key: &'static Key, column: Column) -> Option<Line> {
    let (name, label, unit) = (key.name, key.label(), key.rule.unit);
    column.is_on.then_some(Line { name, label, unit, values: column.values })
}

fn text(value: &Value) -> String {
    match value {
        Value::String(name) => name.clone(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(on) => if *on { "yes" } else { "no" }.to_owned(),
        Value::Array(points) => format!("{} points", points.len()),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests;
