//! Which cases of two studies are the same physical point, and which keys they differ in.

use std::collections::{BTreeMap, BTreeSet};

use toml::{Table, Value};

use super::{DifferentKey, Side};
use crate::keys::number;
use crate::math::lists::different;
use crate::report::config::Config;
use crate::report::load::Loaded;
use crate::report::row::PLACE;

/// Values of a key that are shown, at most.
const SHOWN: usize = 3;

/// Pairs of cases at the same point, in the order of the first study.
///
/// A point is told by the keys of `[scene]` that either study sweeps, and by those of `[numerics]` that
/// both sweep. What only one of them sweeps in its numerics makes several cases of one point.
pub fn matched(studies: &[Loaded; 2], sides: &[Vec<Side<'_>>; 2]) -> Vec<(usize, usize)> {
    let swept = [0, 1]
        .map(|one| studies[one].keys.iter().map(|key| key.name.as_str()).collect::<BTreeSet<_>>());
    let either: Vec<&str> = swept[0].union(&swept[1]).copied().collect();
    let both: Vec<&str> = swept[0].intersection(&swept[1]).copied().collect();
    let mut there: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (at, side) in sides[1].iter().enumerate() {
        there.entry(point(side, &either, &both)).or_default().push(at);
    }
    let mut pairs = Vec::new();
    for (at, side) in sides[0].iter().enumerate() {
        let others = there.get(&point(side, &either, &both)).into_iter().flatten();
        pairs.extend(others.map(|other| (at, *other)));
    }
    pairs
}

/// A case's point as text that is the same for the same values.
fn point(side: &Side, either: &[&str], both: &[&str]) -> String {
    let Some(Config { scene, numerics }) = side.config else {
        return PLACE.map(|column| number_text(side.row.number(column))).join(" ");
    };
    let of_scene = either.iter().map(|key| text(scene, key));
    let shared = both.iter().filter(|key| !scene.contains_key(**key));
    of_scene.chain(shared.map(|key| text(numerics, key))).collect::<Vec<_>>().join(" ")
}

fn text(table: &Table, key: &str) -> String {
    match table.get(key) {
        Some(value) => number(value).map_or_else(|| value.to_string(), |v| number_text(Some(v))),
        None => "-".to_owned(),
    }
}

/// Nine digits tell numbers apart that a file writes in different ways.
pub fn number_text(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.8e}"))
}

/// A section by its name, and where its values are.
type Section = (&'static str, fn(&Config) -> &Table);

/// Keys that differ in some pair, those of the scene first.
pub fn different_keys(sides: &[Vec<Side<'_>>; 2], pairs: &[(usize, usize)]) -> Vec<DifferentKey> {
    let mut keys = Vec::new();
    let tables: [Section; 2] =
        [("scene", |config| &config.scene), ("numerics", |config| &config.numerics)];
    for (section, table) in tables {
        let of = |one: usize, at: usize| sides[one][at].config.map(table);
        let both = pairs.iter().filter_map(|&(a, b)| of(0, a).zip(of(1, b)));
        let both: Vec<(&Table, &Table)> = both.collect();
        let mut names: Vec<&String> =
            both.iter().flat_map(|(a, b)| a.keys().chain(b.keys())).collect();
        names.sort_unstable();
        names.dedup();
        for key in names {
            if both.iter().any(|(a, b)| text(a, key) != text(b, key)) {
                let values = [
                    values(both.iter().map(|(a, _)| *a), key),
                    values(both.iter().map(|(_, b)| *b), key),
                ];
                keys.push(DifferentKey { section, key: key.clone(), values });
            }
        }
    }
    keys
}

/// The different values of a key, the first few.
fn values<'a>(tables: impl Iterator<Item = &'a Table>, key: &str) -> String {
    let mut all = different(tables.filter_map(|table| table.get(key)).map(|value| match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }));
    let more = if all.len() > SHOWN { ", ..." } else { "" };
    all.truncate(SHOWN);
    all.join(", ") + more
}
