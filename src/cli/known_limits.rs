//! Known limits that the cases of a study reach: told by `check`, `run` and `sweep`.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::output::Output;
use crate::math::lists::counts;
use crate::math::words::counted;
use crate::scene::limits;
use crate::study::Study;

/// How many cases are looked at in one go.
pub(super) const CHUNK: usize = 4096;

/// The limits, with the number of cases that reach each.
pub(super) struct KnownLimits(BTreeMap<&'static str, usize>);

impl KnownLimits {
    pub(super) fn of(study: &Study) -> KnownLimits {
        let chunks = study.cases.par_chunks(CHUNK);
        let chunks = chunks.map(|cases| counts(cases.iter().flat_map(|case| limits(&case.config))));
        KnownLimits(chunks.reduce(BTreeMap::new, |mut all, more| {
            more.into_iter().for_each(|(limit, cases)| *all.entry(limit).or_default() += cases);
            all
        }))
    }

    /// What each says.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.keys().copied()
    }

    /// A line for each, with the number of cases.
    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        let line = |(limit, &cases): (&&str, &usize)| {
            format!("known limit, {}: {limit}", counted(cases, "case"))
        };
        self.0.iter().map(line)
    }

    /// Prints them as notes.
    pub(super) fn tell(&self, output: &Output) {
        self.lines().for_each(|line| output.note(line));
    }
}
