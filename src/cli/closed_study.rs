//! `sweep` of a large finished study: its final messages are printed again from its files.

use std::path::Path;

use super::job::{Done, Job};
use super::output::Output;
use super::overview;
use super::{CASES_FAILED, SUCCESS};
use crate::keys::named;
use crate::results::{Closing, Lock, Program, Savings, checksum_of};
use crate::study::{PHYSICS_VERSION, SweepFile};

/// What decides how a finished study's end is reported.
pub(super) struct Asked {
    /// A checksum over the build, the file and the settings of the command line.
    sum: String,
    films: Vec<String>,
}

impl Asked {
    /// `None` where more than the file itself counts: points that are added, numerics that are
    /// chosen, or a stroke in its own file.
    pub(super) fn of(file: &SweepFile, overrides: &[String], films: &[String]) -> Option<Asked> {
        if file.names_stroke() || file.refine.is_some() || file.max_error_percent.is_some() {
            return None;
        }
        let Program { version, sources, .. } = Program::this();
        let physics = PHYSICS_VERSION.to_string();
        let mut pieces = vec![&version, &sources, &physics, &file.text];
        pieces.extend(overrides);
        let pieces = pieces.iter().flat_map(|piece| [piece.as_bytes(), b"\0"]);
        let films = films.iter().filter(|film| *film != "none").cloned().collect();
        Some(Asked { sum: checksum_of(pieces), films })
    }

    /// Reports a study's end again if its directory has not changed. Returns the exit code; `None`
    /// where the study has to be opened.
    pub(super) fn tell(
        &self,
        out: &Path,
        report: &Path,
        output: &Output,
    ) -> anyhow::Result<Option<u8>> {
        if output.verbose || output.is_json() || Lock::is_held(out) {
            return Ok(None);
        }
        let closing = Closing::read(out).filter(|closing| {
            closing.asked == self.sum && (self.films.is_empty() || closing.films == self.films)
        });
        let Some(closing) = closing else { return Ok(None) };
        output.note(format_args!("{} is finished; --fresh would run it again", named(out)));
        let text = format!("{}{}", closing.told, overview::reported(report));
        output.result(&text, &serde_json::json!({}))?;
        Ok(Some(if closing.failed > 0 { CASES_FAILED } else { SUCCESS }))
    }

    /// What is kept for reporting a study's end once it is closed; `None` for a small study.
    pub(super) fn closing(&self, job: &Job, done: &mut Done) -> Option<Closing> {
        if job.study.cases.len() <= Closing::ABOVE {
            return None;
        }
        // This process's own work is not reported again.
        (done.wall_time_s, done.film_time_s, done.savings) = (None, 0.0, Savings::default());
        let told = overview::of_cases(job, done, false);
        Some(Closing::new(&self.sum, &self.films, done.failed(), told))
    }
}
