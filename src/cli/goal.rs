//! The goal of a sweep. It may just run its cases. It may also run until its error bars are narrow enough, or add points
//! wherever a result bends.

use std::path::Path;

use serde_json::Value;

use super::failure::BadInput;
use super::job::Done;
use super::output::Output;
use super::{max_error, refine};
use crate::accuracy::{MaxError, Refinement};
use crate::study::{Study, SweepFile};

pub(super) enum Goal {
    /// Each case once, as the file has it.
    Cases,
    /// Chosen numerics, which become finer until the error bars are narrow enough.
    MaxError(MaxError),
    /// Further points, round by round.
    Points(Box<Refinement>),
}

impl Goal {
    /// The goal of a file and the command line, which may ask for an error of so many percent.
    pub(super) fn of(
        percent: Option<f64>,
        file: &SweepFile,
        study: &Study,
    ) -> Result<Goal, BadInput> {
        Ok(match (max_error::aim(percent, study)?, Refinement::of(file)) {
            (Some(aim), _) => Goal::MaxError(aim),
            (None, Some(points)) => Goal::Points(Box::new(points)),
            (None, None) => Goal::Cases,
        })
    }

    /// The study that runs first, with all that an earlier run has added to this directory. A large
    /// study is held only once.
    pub(super) fn first(
        &self,
        (file, study): (&SweepFile, Study),
        (out, fresh): (&Path, bool),
        output: &Output,
    ) -> Study {
        match self {
            Goal::MaxError(aim) => max_error::begun(aim, &study, out, fresh, output),
            Goal::Points(_) if !fresh => refine::study_in(out, file).unwrap_or(study),
            _ => study,
        }
    }

    /// Whether a case may get other numerics and so another id, while its place stays.
    pub(super) fn chooses_numerics(&self) -> bool {
        matches!(self, Goal::MaxError(_))
    }

    /// The study of the next round; `None` where nothing is left to do.
    pub(super) fn next(
        &self,
        path: &Path,
        study: &Study,
        done: &Done,
        output: &Output,
    ) -> anyhow::Result<Option<Study>> {
        match self {
            Goal::MaxError(aim) => Ok(max_error::refine(aim, study, done, output)),
            Goal::Points(points) => refine::next(points, path, study, done, output),
            Goal::Cases => Ok(None),
        }
    }

    /// Adds how far a finished study came to its results, as text and as JSON. The page reads the file that this writes.
    pub(super) fn report(
        &self,
        study: &Study,
        done: &Done,
        (text, value): (&mut String, &mut Value),
    ) -> anyhow::Result<()> {
        let (name, (told, reached)) = match self {
            Goal::MaxError(aim) => ("accuracy", max_error::report(aim, study, done)?),
            Goal::Points(points) => ("refined", refine::report(points, study, done)),
            Goal::Cases => return Ok(()),
        };
        text.push_str(&told);
        value[name] = reached;
        Ok(())
    }
}
