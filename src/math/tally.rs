//! What is told of many cases, each thing once.

use std::collections::BTreeMap;
use std::fmt::Display;

use rayon::prelude::*;

/// How many cases are counted in one go.
const CHUNK: usize = 4096;

/// By key what was told first, and of how many cases.
#[derive(Debug)]
pub struct Tally<K, T> {
    told: BTreeMap<K, (T, usize)>,
    cases: usize,
}

impl<K: Ord + Send, T: Send> Tally<K, T> {
    /// Of the first case that tells a key, its words count; `tell` gives those of a case.
    pub fn of<C: Sync>(cases: &[C], tell: impl Fn(&C) -> Vec<(K, T)> + Sync) -> Self {
        let chunks = cases.par_chunks(CHUNK).map(|cases| Tally::counted(cases.iter().map(&tell)));
        chunks.reduce(|| Tally::counted([]), Tally::with)
    }

    /// The same of what is told of each case in turn.
    pub fn counted(all: impl IntoIterator<Item = Vec<(K, T)>>) -> Self {
        let mut tally = Tally { told: BTreeMap::new(), cases: 0 };
        for told in all {
            tally.cases += 1;
            told.into_iter().for_each(|(key, first)| tally.count(key, first, 1));
        }
        tally
    }

    fn count(&mut self, key: K, first: T, cases: usize) {
        self.told.entry(key).or_insert((first, 0)).1 += cases;
    }

    fn with(mut self, later: Self) -> Self {
        self.cases += later.cases;
        later.told.into_iter().for_each(|(key, (first, cases))| self.count(key, first, cases));
        self
    }

    /// Each key with its number of cases.
    pub fn keys(&self) -> impl Iterator<Item = (&K, usize)> {
        self.told.iter().map(|(key, (_, cases))| (key, *cases))
    }

    /// What was told of each key, with its number of cases.
    pub fn counts(self) -> impl Iterator<Item = (T, usize)> {
        self.told.into_values()
    }

    /// A line per key. Where it is told of only some of the cases, what `some` makes of their
    /// number follows.
    pub fn lines(self, some: impl Fn(usize) -> String) -> Vec<String>
    where
        T: Display,
    {
        let some = |cases| if cases == self.cases { String::new() } else { some(cases) };
        self.told.into_values().map(|(first, cases)| format!("{first}{}", some(cases))).collect()
    }
}
