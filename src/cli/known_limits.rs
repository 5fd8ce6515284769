//! Known limits that the cases of a study reach: told by `check`, `run` and `sweep`.

use super::output::Output;
use crate::math::tally::Tally;
use crate::math::words::counted;
use crate::scene::limits;
use crate::study::{Case, Study};

/// The limits, with the number of cases that reach each.
pub(super) struct KnownLimits(Tally<&'static str, ()>);

impl KnownLimits {
    pub(super) fn of(study: &Study) -> KnownLimits {
        let of_case = |case: &Case| limits(&case.config).into_iter().map(|limit| (limit, ()));
        KnownLimits(Tally::of(&study.cases, |case| of_case(case).collect()))
    }

    /// What each says.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(|(limit, _)| *limit)
    }

    /// A line for each, with the number of cases.
    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        let line = |(limit, cases)| format!("known limit, {}: {limit}", counted(cases, "case"));
        self.0.keys().map(line)
    }

    /// Prints them as notes.
    pub(super) fn tell(&self, output: &Output) {
        self.lines().for_each(|line| output.note(line));
    }
}
