//! Two studies side by side. Cases are matched by their physical values and not by their ids, since
//! numerics may differ.

mod gaps;
mod held;
mod matching;
mod measured;
mod pair;
mod record;
mod shown;
mod slips;
mod values;

use std::collections::HashSet;
use std::path::Path;

use super::config::{Config, each_config};
use super::error::ReportError;
use super::load::Loaded;
use super::row::Row;
use crate::quantities::Column;
use crate::quantities::summary::RESULTS;
use values::Values;

pub use gaps::Gaps;
pub use held::{figure as figure_of_held, table as table_of_held};
pub use measured::{Beside, Held, hold};
pub use pair::{Difference, Pair, Tally};
pub use shown::{figure, table};
pub use slips::slips;

/// A key that has other values in one study than in the other, in cases of the same point.
#[derive(Debug, Clone, PartialEq)]
pub struct DifferentKey {
    /// `scene` or `numerics`.
    pub section: &'static str,
    /// The key.
    pub key: String,
    /// Its values in the two studies; empty where a study has none.
    pub values: [String; 2],
}

/// What two studies have in common, and where they differ.
#[derive(Debug, Clone, Default)]
pub struct Comparison {
    /// Names of the studies.
    pub names: [String; 2],
    /// Whether each has a manifest that can be read. Without one nothing tells what was swept.
    pub have_manifest: [bool; 2],
    /// How many cases of each are finished.
    pub finished: [usize; 2],
    /// Keys that differ in cases of the same point.
    pub keys: Vec<DifferentKey>,
    /// Cases of the same point.
    pub pairs: Vec<Pair>,
    /// Cases that only one study has, in words.
    pub only: [Vec<String>; 2],
}

/// A study, as far as it is compared.
struct Study<'a> {
    data: &'a Loaded,
    sides: Vec<Side<'a>>,
    /// The keys and values of those cases, as far as files tell.
    values: Values,
}

/// A finished case of a study.
struct Side<'a> {
    row: &'a Row,
    /// Its place in `Study::values`.
    case: Option<usize>,
    /// Depth of its still water, m, as far as files tell.
    depth: Option<f64>,
}

/// Compares two output directories by their files alone.
pub fn compare(directories: [&Path; 2]) -> Result<Comparison, ReportError> {
    let [a, b] = directories.map(Loaded::read);
    let data = [a?, b?];
    let studies = data.each_ref().map(Study::of);
    let matches = matching::matched(&studies);
    let [a, b] = studies.each_ref().map(|study| &study.sides);
    let only = [0, 1].map(|one| {
        // Looking through all pairs for each case takes minutes where there are a hundred thousand.
        let has: HashSet<usize> = matches.iter().map(|&(a, b)| [a, b][one]).collect();
        let lone = [a, b][one].iter().enumerate().filter(|(at, _)| !has.contains(at));
        lone.map(|(_, side)| side.row.title()).collect()
    });
    Ok(Comparison {
        names: data.each_ref().map(|data| data.name().unwrap_or_default().to_owned()),
        have_manifest: data.each_ref().map(|data| data.manifest.is_some()),
        finished: [a.len(), b.len()],
        keys: matching::different_keys(&studies, &matches),
        pairs: matches.iter().map(|&(at, other)| Pair::of(&a[at], &b[other])).collect(),
        only,
    })
}

impl Comparison {
    /// The column of a compared quantity: that of the whole run if no pair has its own.
    pub fn column(&self, quantity: usize) -> &'static Column {
        let mut known = self.pairs.iter().filter_map(|pair| pair.differences[quantity]).peekable();
        let replaced = known.peek().is_some() && known.all(|one| one.stands_in);
        if replaced { RESULTS[quantity].of_whole_run() } else { RESULTS[quantity] }
    }
}

impl<'a> Study<'a> {
    fn of(data: &'a Loaded) -> Study<'a> {
        let configs = each_config(data, data.placed().map(|(place, _)| place));
        let mut values = Values::default();
        let side = |((_, row), config): ((usize, &'a Row), Option<Config>)| Side {
            row,
            depth: config.as_ref().and_then(|config| config.value("still_water_depth_m")),
            case: config.map(|config| values.push(&config)),
        };
        let sides = data.placed().zip(configs).map(side).collect();
        Study { data, sides, values }
    }
}
