//! The studies that a figure of a paper needs, and what they cost before they run.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::cost::expected_seconds;
use crate::cli::failure::BadInput;
use crate::cli::input::Setting;
use crate::cli::output::duration;
use crate::keys::named;
use crate::math::words::counted;
use crate::papers::{Run, files};
use crate::results::{CaseRecord, SweepError, finished};
use crate::study::{Study, SweepFile};

/// The study of a run with the settings of the recipe and of the user.
pub(super) fn study(run: &Run, settings: &[Setting]) -> Result<Study, BadInput> {
    let bad = |reason: &dyn std::fmt::Display| {
        BadInput(format!("{} (inside the program): {reason}", run.file))
    };
    let text = files::text(&run.file).ok_or_else(|| bad(&"is not there"))?;
    let mut sets = vec![format!("name={}", run.name).parse().map_err(|e| bad(&e))?];
    for set in &run.set {
        sets.push(set.parse().map_err(|e: String| bad(&e))?);
    }
    sets.extend(settings.iter().map(|setting| setting.set.clone()));
    let file = SweepFile::read(text, &sets).map_err(|error| bad(&error))?;
    Study::new(&file).map_err(|error| bad(&error))
}

/// A study that a figure needs, before it runs.
#[derive(Debug, Serialize)]
pub(super) struct Needed {
    /// Where it goes.
    directory: PathBuf,
    cases: usize,
    /// How many of its cases are finished.
    finished: usize,
    /// The expected time of all of them, seconds.
    expected_time_s: f64,
}

/// Each of a figure's studies. `how` holds the number of threads, and whether they start over.
pub(super) fn needed(
    runs: &[Run],
    studies: &[Study],
    out: &Path,
    how: (Option<u16>, bool),
) -> Result<Vec<Needed>, SweepError> {
    let one = |(run, study): (&Run, &Study)| {
        let directory = out.join(&run.name);
        let is_new = how.1 || !directory.exists();
        let records = if is_new { Vec::new() } else { finished(&directory, study)? };
        let well = |record: &Option<CaseRecord>| record.as_ref().is_some_and(CaseRecord::is_ok);
        let done = study.cases.iter().zip(records).filter(|(_, record)| well(record)).count();
        Ok(Needed {
            directory,
            cases: study.cases.len(),
            finished: done,
            expected_time_s: expected_seconds(study, how.0.map(usize::from)),
        })
    };
    runs.iter().zip(studies).map(one).collect()
}

/// The needed studies in words.
pub(super) fn text(needed: &[Needed]) -> String {
    let line = |one: &Needed| {
        let done = match one.finished {
            0 => String::new(),
            done => format!(", {done} of them finished"),
        };
        let (cases, time) = (counted(one.cases, "case"), duration(one.expected_time_s));
        format!("  {cases}, about {time} in all{done}, into {}\n", named(&one.directory))
    };
    needed.iter().map(line).chain(["nothing was run\n".to_owned()]).collect()
}
