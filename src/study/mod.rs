//! The study: from a file with a `[grid]` to its cases and a plan of what runs.
//!
//! - [`SweepFile`] is the parsed file, [`Study`] its cases in grid order, each a [`Case`] whose id
//!   is a hash of what decides its answer;
//! - resolution companions are the same cases with coarser particles;
//! - [`Plan`] groups the cases into trunks and branches.

mod axis;
mod case;
mod case_map;
mod companions;
mod file;
mod grid;
mod limits;
mod plan;
mod points;
mod refine;
mod schema;
mod single;
mod syntax;
mod unknown;
mod unread;

pub use axis::GridAxis;
pub use case::{Assignments, Case, CaseId, PHYSICS_VERSION};
pub use case_map::CaseMap;
pub use companions::has_enough_rows;
pub use file::{SweepFile, accuracy_keys};
pub use limits::limits_keys;
pub use plan::{Plan, PlannedCase, PlannedTrunk};
pub use refine::{Refine, refine_keys};
pub use schema::schema;
pub use unread::Unread;

pub use crate::keys::Override;
use crate::keys::Recent;

use sha2::{Digest, Sha256};

use crate::math::digest::digits;
use crate::scene::{ConfigError, ErrorBars};
use crate::simulation::Limits;

/// A validated sweep, ready to be planned.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name.
    pub name: String,
    /// The swept keys, in the order of the file.
    pub keys: Vec<String>,
    /// The cases, in grid order.
    pub cases: Vec<Case>,
    /// Their resolution companions, with indices after those of the cases.
    pub companions: Vec<Case>,
    /// The companions of every case, by [`Study::run`]'s index, the finest first.
    pub companions_of: Vec<Vec<usize>>,
    /// How many cases ask for error bars but have no companion, because it would be too coarse to
    /// run.
    pub without_bars: usize,
    /// Hash over the cases and their order, with or without error bars. Two files with the same
    /// identity are the same sweep.
    pub identity: String,
    /// The error that the file or the command line aims at, percent.
    pub max_error_percent: Option<f64>,
    /// Limits of every case.
    pub limits: Limits,
    /// How points are added to it.
    pub refine: Option<Refine>,
    /// Keys that the file gives and some cases do not read.
    pub unread: Vec<Unread>,
    /// The file as written.
    pub file_text: String,
    /// The command line's values.
    pub sets: Vec<Override>,
}

impl Study {
    /// Expands and validates a file.
    ///
    /// # Errors
    /// The first bad value of the first bad case.
    pub fn new(file: &SweepFile) -> Result<Study, ConfigError> {
        Ok(Study::of_file(file, grid::expand(file)?))
    }

    /// The study of a file with these cases.
    fn of_file(file: &SweepFile, mut cases: Vec<Case>) -> Study {
        let mut numerics = Recent::default();
        let mut take_bars = |case: &mut Case| {
            let own = &mut case.config.numerics;
            if own.error_bars == ErrorBars::None {
                return ErrorBars::None;
            }
            let bars = std::mem::replace(&mut own.error_bars, ErrorBars::None);
            numerics.share(own);
            bars
        };
        let bars: Vec<_> = cases.iter_mut().map(&mut take_bars).collect();
        let unread = unread::unread(file, &cases);
        let keys: Vec<String> = file.grid.iter().map(|axis| axis.key.clone()).collect();
        let study = Study::of(file.name.clone(), keys, cases, &bars, &file.text);
        let (max_error_percent, refine) = (file.max_error_percent, file.refine.clone());
        let (limits, sets) = (file.limits, file.sets.clone());
        Study { max_error_percent, refine, limits, sets, unread, ..study }
    }

    /// A study of the given cases. If `bars` has fewer entries, the other cases have no bars.
    pub(crate) fn of(
        name: String,
        keys: Vec<String>,
        cases: Vec<Case>,
        bars: &[ErrorBars],
        file_text: &str,
    ) -> Study {
        let (companions, companions_of) = companions::plan(&cases, bars);
        let barless =
            |(bars, own): &(&ErrorBars, &Vec<usize>)| **bars != ErrorBars::None && own.is_empty();
        let without_bars = bars.iter().zip(&companions_of).filter(barless).count();
        let mut hash = Sha256::new();
        hash.update(keys.join(","));
        for case in &cases {
            hash.update(case.id.to_string());
        }
        let identity = digits(hash);
        let file_text = file_text.to_owned();
        let (max_error_percent, refine) = (None, None);
        Study {
            name,
            keys,
            cases,
            companions,
            companions_of,
            without_bars,
            identity,
            max_error_percent,
            limits: Limits::default(),
            refine,
            unread: Vec::new(),
            file_text,
            sets: Vec::new(),
        }
    }

    /// Cases and companions, in the order of their indices.
    pub fn runs(&self) -> impl Iterator<Item = &Case> {
        self.cases.iter().chain(&self.companions)
    }

    /// A case, or a companion.
    ///
    /// # Panics
    /// Where there is none of this index.
    pub fn run(&self, index: usize) -> &Case {
        self.cases.get(index).unwrap_or_else(|| &self.companions[index - self.cases.len()])
    }

    /// The number of cases and companions.
    pub fn run_count(&self) -> usize {
        self.cases.len() + self.companions.len()
    }

    /// A case's swept keys and values, for files. `None` if a key means nothing to the case.
    pub fn values(&self, case: &Case) -> Vec<(String, serde_json::Value)> {
        let value = |value: &toml::Value| serde_json::to_value(value).unwrap_or_default();
        let pairs = self.keys.iter().zip(&case.assignments);
        pairs.filter_map(|(key, set)| Some((key.clone(), value(set.as_deref()?)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A million cases with their results must fit into two gigabytes, so shared data are held
    /// once.
    #[test]
    fn cases_hold_what_they_share_once() {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\n[numerics]\nerror_bars = \"pair\"\n[grid]\n\
            spring_stiffness_n_per_m = [1, 2, 3]\nseawall_mass_kg_per_m = [50, 60]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let same = |a: &Case, b: &Case| std::ptr::eq(&*a.config.numerics, &*b.config.numerics);
        assert!(study.cases.iter().all(|case| same(case, &study.cases[0])));
        assert!(study.companions.iter().all(|case| same(case, &study.companions[0])));
        assert!(!same(&study.cases[0], &study.companions[0]));
        let value = |case: usize| study.cases[case].assignments[1].as_deref().unwrap();
        assert!(std::ptr::eq(value(0), value(2)));
        let bytes = std::mem::size_of::<Case>();
        assert!(bytes <= 360, "{bytes} bytes for each case");
    }
}
