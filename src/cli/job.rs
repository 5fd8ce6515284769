//! A study that is to be run, and the result.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::output::{Output, json_path};
use super::{CASES_FAILED, INTERRUPTED, SUCCESS, lost_bars};
use crate::execute::Ending;
use crate::math::simd::SimdPath;
use crate::quantities::summary::{
    COARSE_SPACING, DISPLACEMENT_ERROR, FORCE_ERROR, FORCE_MAX_ERROR, MOMENT_ERROR,
    MOMENT_MAX_ERROR, OVERTOPPING_VOLUME_ERROR, RUNUP_ERROR, RUNUP_MAX_ERROR,
};
use crate::quantities::{Bars, Value as Cell};
use crate::results::{CaseRecord, Directory, OpenMode, Savings, SweepError, finished_whole};
use crate::study::Study;

/// What runs again of what failed earlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Retry {
    Nothing,
    /// Cases, but not the companions for their error bars.
    Cases,
    All,
}

/// A study, where it runs, and how.
pub(super) struct Job {
    pub(super) study: Study,
    pub(super) out: PathBuf,
    pub(super) mode: OpenMode,
    pub(super) retry: Retry,
    pub(super) branching: bool,
    /// Whether threads that the runs leave idle work within them.
    pub(super) shares_threads: bool,
    pub(super) simd: Option<SimdPath>,
    pub(super) overrides: Vec<String>,
    /// Whether films and page are made once its cases are done.
    pub(super) reports: bool,
}

impl Job {
    /// Runs all that is missing of a study; `fresh` starts it over. Cases share trunks, all threads
    /// work, and no report is made.
    pub(super) fn of(study: Study, out: PathBuf, fresh: bool) -> Job {
        Job {
            study,
            out,
            mode: if fresh { OpenMode::Fresh } else { OpenMode::Resume },
            retry: Retry::Nothing,
            branching: true,
            shares_threads: true,
            simd: None,
            overrides: Vec::new(),
            reports: false,
        }
    }
}

/// The result of a job.
pub(super) struct Done {
    pub(super) directory: Directory,
    pub(super) ending: Ending,
    pub(super) savings: Savings,
    /// The time that the runs took, seconds; `None` where everything was there before.
    pub(super) wall_time_s: Option<f64>,
    /// What the films of this call took, seconds.
    pub(super) film_time_s: f64,
}

impl Done {
    /// The finished cases, in grid order.
    pub(super) fn records(&self) -> impl Iterator<Item = &CaseRecord> {
        self.directory.case_records().iter().flatten()
    }

    /// How many finished cases have a reason for doubt.
    pub(super) fn doubtful(&self) -> usize {
        self.doubts().count()
    }

    /// The reasons for doubt of each finished case that has any.
    pub(super) fn doubts(&self) -> impl Iterator<Item = &str> {
        let outcomes = self.records().filter_map(|record| record.outcome.as_ref());
        outcomes.filter_map(|outcome| outcome.doubtful_reason.as_deref())
    }

    /// What coarse particles mean for each finished case that has them.
    pub(super) fn coarse(&self, job: &Job) -> Vec<String> {
        let told = |record: &CaseRecord| {
            let config = &job.study.cases[record.index].config;
            let case =
                record.outcome.is_some().then(|| record.reported(config, Bars::default()))?;
            match COARSE_SPACING.value(&case)? {
                Cell::Text(why) => Some(why),
                _ => None,
            }
        };
        self.records().filter_map(told).collect()
    }

    pub(super) fn failed(&self) -> usize {
        self.records().filter(|record| !record.is_ok()).count()
    }

    pub(super) fn exit_code(&self) -> u8 {
        match self.ending {
            Ending::Interrupted => INTERRUPTED,
            Ending::Finished if self.failed() > 0 => CASES_FAILED,
            Ending::Finished => SUCCESS,
        }
    }

    /// The finished cases with all that the journal holds of them, in grid order.
    pub(super) fn whole(&self, study: &Study) -> Result<Vec<CaseRecord>, SweepError> {
        let whole = finished_whole(self.directory.path(), study)?.into_iter();
        let whole = whole.zip(self.directory.case_records());
        Ok(whole.filter_map(|(record, here)| record.filter(|_| here.is_some())).collect())
    }

    /// A record with its error bars, for programs; null where there is none. Companions that failed
    /// are told with their reasons.
    pub(super) fn in_full(&self, study: &Study, record: &CaseRecord) -> Value {
        let mut value = json!(record);
        let bars = study.error_bars(record.index, self.directory.records());
        let bars = [
            (&FORCE_ERROR, bars.force),
            (&RUNUP_ERROR, bars.runup),
            (&DISPLACEMENT_ERROR, bars.displacement),
            (&FORCE_MAX_ERROR, bars.whole_force),
            (&RUNUP_MAX_ERROR, bars.whole_runup),
            (&OVERTOPPING_VOLUME_ERROR, bars.overtopping),
            (&MOMENT_ERROR, bars.moment),
            (&MOMENT_MAX_ERROR, bars.whole_moment),
        ];
        let bars = bars.into_iter().map(|(column, bar)| (column.name.to_owned(), json!(bar)));
        value["error_bars"] = Value::Object(bars.collect());
        value["failed_companions"] = lost_bars::json(study, record, self.directory.records());
        value
    }

    /// Tells programs what is known of a job that was interrupted, and returns its exit code.
    pub(super) fn interrupted(&self, job: &Job, output: &Output) -> anyhow::Result<u8> {
        let value = json!({
            "interrupted": true,
            "name": job.study.name,
            "out": json_path(self.directory.path()),
            "cases": job.study.cases.len(),
            "done": self.records().count(),
        });
        output.result("", &value)?;
        Ok(INTERRUPTED)
    }

    pub(super) fn json(&self, job: &Job, report: Option<&Path>) -> Result<Value, SweepError> {
        let records = self.whole(&job.study)?;
        let records: Vec<_> =
            records.iter().map(|record| self.in_full(&job.study, record)).collect();
        Ok(json!({
            "name": job.study.name,
            "out": json_path(self.directory.path()),
            "report": report.map(json_path),
            "cases": job.study.cases.len(),
            "ok": self.records().count() - self.failed(),
            "failed": self.failed(),
            "doubtful": self.doubtful(),
            "coarse": self.coarse(job).len(),
            "wall_time_s": self.wall_time_s,
            "film_time_s": self.film_time_s,
            "savings": self.savings,
            "records": records,
        }))
    }
}
