//! Finds cases of two studies at the same physical point, and the keys in which they differ.

use std::collections::{BTreeSet, HashMap};

use super::values::{number_text, shown, text};
use super::{DifferentKey, Side, Study};
use crate::report::row::PLACE;

/// How many values of a key are shown, at most.
const SHOWN: usize = 3;

/// Pairs of cases at the same point, in the order of the first study.
///
/// A point is given by the keys of `[scene]` that either study sweeps, and the keys of `[numerics]`
/// that both sweep. If only one sweeps a key of `[numerics]`, several of its cases share a point.
pub fn matched(studies: &[Study<'_>; 2]) -> Vec<(usize, usize)> {
    let swept = studies
        .each_ref()
        .map(|study| study.data.keys.iter().map(|key| key.name.as_str()).collect::<BTreeSet<_>>());
    let either: Vec<&str> = swept[0].union(&swept[1]).copied().collect();
    let both: Vec<&str> = swept[0].intersection(&swept[1]).copied().collect();
    let points = studies.each_ref().map(|study| points(study, &either, &both));
    let mut there: HashMap<&str, Vec<usize>> = HashMap::new();
    for (at, point) in points[1].iter().enumerate() {
        there.entry(point).or_default().push(at);
    }
    let others = |point: &String| there.get(point.as_str()).into_iter().flatten();
    let pairs = points[0].iter().enumerate();
    pairs.flat_map(|(at, point)| others(point).map(move |other| (at, *other))).collect()
}

/// Each case's point as text. Equal values give equal text.
fn points(study: &Study<'_>, either: &[&str], both: &[&str]) -> Vec<String> {
    let of = |section: usize, keys: &[&str]| {
        keys.iter().map(|key| study.values.column(section, key)).collect::<Vec<_>>()
    };
    let [of_scene, shared, of_numerics] = [of(0, either), of(0, both), of(1, both)];
    let point = |side: &Side| {
        let Some(case) = side.case else {
            return PLACE.map(|column| number_text(side.row.number(column))).join(" ");
        };
        let scene = of_scene.iter().map(|column| text(*column, case));
        let both = shared.iter().zip(&of_numerics);
        let both = both.filter(|(scene, _)| shown(**scene, case).is_none());
        scene.chain(both.map(|(_, column)| text(*column, case))).collect::<Vec<_>>().join(" ")
    };
    study.sides.iter().map(point).collect()
}

/// Keys that differ in some pair; keys of the scene come first.
pub fn different_keys(studies: &[Study<'_>; 2], pairs: &[(usize, usize)]) -> Vec<DifferentKey> {
    let of = |one: usize, at: usize| studies[one].sides[at].case;
    let both = pairs.iter().filter_map(|&(a, b)| Some([of(0, a)?, of(1, b)?]));
    let both: Vec<[usize; 2]> = both.collect();
    let mut different = Vec::new();
    for (place, section) in ["scene", "numerics"].into_iter().enumerate() {
        let keys = studies.iter().flat_map(|study| study.values.keys(place));
        for key in keys.collect::<BTreeSet<_>>() {
            let columns = studies.each_ref().map(|study| study.values.column(place, key));
            if both.iter().any(|&[a, b]| text(columns[0], a) != text(columns[1], b)) {
                let values = |one: usize| {
                    first_few(both.iter().filter_map(|pair| shown(columns[one], pair[one])))
                };
                let values = [values(0), values(1)];
                different.push(DifferentKey { section, key: key.to_owned(), values });
            }
        }
    }
    different
}

/// The different values of a key, the first few.
fn first_few<'a>(values: impl Iterator<Item = &'a str>) -> String {
    let mut few: Vec<&str> = Vec::new();
    for value in values {
        if few.contains(&value) {
            continue;
        }
        if few.len() == SHOWN {
            return few.join(", ") + ", ...";
        }
        few.push(value);
    }
    few.join(", ")
}
