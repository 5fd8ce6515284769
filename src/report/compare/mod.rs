//! Two studies side by side: the same physical points, by their values and not by their identities, since
//! numerics may differ.

mod matching;
mod pair;
mod shown;

use std::collections::HashSet;
use std::path::Path;

use super::config::{Config, configs};
use super::error::ReportError;
use super::load::Loaded;
use super::row::Row;

pub use pair::{COMPARED, Difference, Pair, Tally};
pub use shown::{figure, table};

/// A key that has other values in one study than in the other, in cases of the same point.
#[derive(Debug, Clone, PartialEq)]
pub struct DifferentKey {
    /// `scene` or `numerics`.
    pub section: &'static str,
    /// The key.
    pub key: String,
    /// Its values in either study; empty where it has none.
    pub values: [String; 2],
}

/// What two studies have in common, and where they differ.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Names of the studies.
    pub names: [String; 2],
    /// Finished cases of either.
    pub finished: [usize; 2],
    /// Keys that differ in cases of the same point.
    pub keys: Vec<DifferentKey>,
    /// Cases of the same point.
    pub pairs: Vec<Pair>,
    /// Cases that only one of them has, in words.
    pub only: [Vec<String>; 2],
}

/// A finished case of a study.
struct Side<'a> {
    row: &'a Row,
    config: Option<&'a Config>,
}

/// Compares two output directories by their files alone.
pub fn compare(directories: [&Path; 2]) -> Result<Comparison, ReportError> {
    let [a, b] = directories.map(Loaded::read);
    let studies = [a?, b?];
    let configs = [configs(&studies[0]), configs(&studies[1])];
    let sides = [0, 1].map(|one| sides(&studies[one], &configs[one]));
    let matches = matching::matched(&studies, &sides);
    let pair = |&(a, b): &(usize, usize)| Pair::of(&sides[0][a], &sides[1][b]);
    let only = [0, 1].map(|one| {
        // Of a hundred thousand pairs a look through all for each case would take minutes.
        let has: HashSet<usize> = matches.iter().map(|&(a, b)| [a, b][one]).collect();
        let lone = sides[one].iter().enumerate().filter(|(at, _)| !has.contains(at));
        lone.map(|(_, side)| side.row.title()).collect()
    });
    let name = |one: usize| studies[one].name().unwrap_or_default().to_owned();
    Ok(Comparison {
        names: [name(0), name(1)],
        finished: [sides[0].len(), sides[1].len()],
        keys: matching::different_keys(&sides, &matches),
        pairs: matches.iter().map(pair).collect(),
        only,
    })
}

fn sides<'a>(study: &'a Loaded, configs: &'a [Option<Config>]) -> Vec<Side<'a>> {
    let side = |(row, config): (&'a Row, &'a Option<Config>)| {
        row.is_ok().then_some(Side { row, config: config.as_ref() })
    };
    study.rows.iter().zip(configs).filter_map(side).collect()
}
