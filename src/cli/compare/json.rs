//! A comparison as JSON.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::unit;
use crate::cli::output::{json_path, json_paths};
use crate::quantities::summary::RESULTS;
use crate::report::compare::{Comparison, Difference, Pair};

pub(super) fn value(
    directories: [&Path; 2],
    comparison: &Comparison,
    files: Option<&[PathBuf]>,
) -> Value {
    let difference = |one: &Option<Difference>| match one {
        None => Value::Null,
        Some(one) => json!({
            "a": one.values[0],
            "b": one.values[1],
            "difference": one.absolute(),
            "percent": one.percent(),
            "error_a": one.bars[0],
            "error_b": one.bars[1],
            "within_bars": one.is_within(),
            "bound": one.bounds[0] || one.bounds[1],
        }),
    };
    let names: Vec<_> = (0..RESULTS.len()).map(|at| comparison.column(at).name).collect();
    let pair = |pair: &Pair| {
        let differences = names.iter().zip(&pair.differences);
        let values: serde_json::Map<_, _> =
            differences.map(|(name, one)| ((*name).to_owned(), difference(one))).collect();
        json!({ "case": pair.words, "case_ids": pair.ids, "differences": values })
    };
    let tally = |at: usize| {
        let tally = Pair::tally(&comparison.pairs, at)?;
        let unit = unit(RESULTS[at].unit);
        Some(json!({
            "cases": tally.count,
            "median": tally.median,
            "worst": tally.worst,
            "unit": unit,
            "worst_case": comparison.pairs[tally.worst_pair].words,
            "with_bars": tally.with_bars,
            "within_bars": tally.within,
        }))
    };
    let tallies: serde_json::Map<_, _> = names
        .iter()
        .enumerate()
        .filter_map(|(at, n)| Some(((*n).to_owned(), tally(at)?)))
        .collect();
    let keys = comparison.keys.iter().map(|key| {
        json!({ "section": key.section, "key": key.key, "a": key.values[0], "b": key.values[1] })
    });
    json!({
        "directories": directories.map(json_path),
        "names": comparison.names,
        "pairs": comparison.pairs.len(),
        "only_in_a": comparison.only[0],
        "only_in_b": comparison.only[1],
        "keys": keys.collect::<Vec<_>>(),
        "summary": tallies,
        "cases": comparison.pairs.iter().map(pair).collect::<Vec<_>>(),
        "files": files.map(json_paths),
    })
}
