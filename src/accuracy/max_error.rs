//! A wanted error (`--max-error`). Numerics are chosen case by case, verified with error bars, and
//! refined if they miss.

use std::collections::BTreeMap;

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::table::{AccuracyTable, Choice, differences};
use crate::math::comma::csv_of;
use crate::math::digest::digits;
use crate::quantities::max_error::Line;
use crate::results::{CaseRecord, ErrorBars, narrowest_bar_percent};
use crate::scene::CaseConfig;
use crate::simulation::{Maximum, finer_particles_may_clear};
use crate::study::{Case, CaseId, Study};

/// Largest spacing over the depth that can be verified. Its companion for the error bars has twice
/// that, and no case may have more than a quarter.
const COARSEST: f64 = 0.125;

/// Choices by the number of their case.
pub type Choices = BTreeMap<usize, Choice>;

/// A wanted error of force and displacement, with the data to meet it.
#[derive(Debug, Clone)]
pub struct MaxError {
    percent: f64,
    table: AccuracyTable,
}

/// The accuracy of a finished case.
#[derive(Debug, Clone, Copy)]
pub struct Verified {
    /// The case.
    pub index: usize,
    /// Its spacing, metres.
    pub spacing_m: f64,
    /// The larger of the bars of force and displacement, percent; `None` without bars.
    pub bar_percent: Option<f64>,
    /// Why it misses the wanted error; `None` if it does not.
    pub missed: Option<Missed>,
    /// Whether finer particles may help.
    may_be_finer: bool,
}

/// Why a case is not as accurate as wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Missed {
    /// It failed.
    Failed,
    /// A quoted number is doubtful.
    Doubtful,
    /// It has no error bars.
    WithoutBars,
    /// Its error bars are too wide.
    Wide,
}

impl MaxError {
    /// A wanted error in percent.
    ///
    /// # Errors
    /// A percentage that is not allowed, or a study that sweeps a key that is to be chosen.
    pub fn new(percent: f64, study: &Study) -> Result<MaxError, String> {
        if !(percent.is_finite() && percent > 0.0) {
            return Err(format!(
                "accuracy.max_error_percent = {percent}: must be a number above 0"
            ));
        }
        if study.keys.iter().any(|key| key == "particle_spacing_m") {
            let told =
                "--max-error chooses the particle spacing, but [grid] sweeps it: leave one out";
            return Err(told.to_owned());
        }
        Ok(MaxError { percent, table: AccuracyTable::stored() })
    }

    /// The wanted error, percent.
    pub fn percent(&self) -> f64 {
        self.percent
    }

    /// The first choice of numerics: those that are expected to meet it.
    pub fn first(&self, study: &Study) -> Choices {
        let choose = |case: &Case| Some((case.index, self.choose(study, case, COARSEST)?));
        study.cases.iter().filter_map(choose).collect()
    }

    /// Finer spacings for the cases that miss the wanted error, if that may help and the table has
    /// any. `records` are those of the runs.
    pub fn finer(&self, study: &Study, records: &[Option<CaseRecord>]) -> Choices {
        let verified = self.verify(study, records).into_iter();
        let missed = verified.filter(|case| case.missed.is_some() && case.may_be_finer);
        missed.filter_map(|case| self.next(study, &study.cases[case.index])).collect()
    }

    /// The same, as if the bars of all cases were too wide.
    pub fn all_finer(&self, study: &Study) -> Choices {
        study.cases.iter().filter_map(|case| self.next(study, case)).collect()
    }

    /// The next finer spacing of a case, with its number.
    fn next(&self, study: &Study, case: &Case) -> Option<(usize, Choice)> {
        if self.is_out_of_reach(case) {
            return None; // finer particles would make its bar no narrower
        }
        let depth = case.config.scene.seawall()?.still_water_depth_m;
        let spacing = case.config.numerics.particle_spacing_m;
        Some((case.index, self.choose(study, case, 0.99 * spacing / depth)?))
    }

    /// The cases whose bars cannot be as narrow as wanted: the narrowest bar among them, percent,
    /// and their number. `None` if there are none.
    pub fn floor(&self, study: &Study) -> Option<(f64, usize)> {
        let beyond = study.cases.iter().filter(|case| self.is_out_of_reach(case));
        let floors: Vec<_> =
            beyond.filter_map(|case| narrowest_bar_percent(&case.config)).collect();
        let least = floors.iter().copied().min_by(f64::total_cmp)?;
        Some((least, floors.len()))
    }

    fn is_out_of_reach(&self, case: &Case) -> bool {
        narrowest_bar_percent(&case.config).is_some_and(|floor| floor > self.percent)
    }

    fn choose(&self, study: &Study, case: &Case, at_most: f64) -> Option<Choice> {
        self.table.choose(&case.config, self.percent, at_most, &study.keys)
    }

    /// The accuracy of the finished cases; `records` are those of the runs.
    pub fn verify(&self, study: &Study, records: &[Option<CaseRecord>]) -> Vec<Verified> {
        let verified = |case: &Case| {
            let record = records[case.index].as_ref()?;
            let bar_percent = bar_percent(record, &study.error_bars(case.index, records));
            let (missed, may_be_finer) = self.judge(record, bar_percent);
            let spacing_m = case.config.numerics.particle_spacing_m;
            Some(Verified { index: case.index, spacing_m, bar_percent, missed, may_be_finer })
        };
        study.cases.iter().filter_map(verified).collect()
    }

    /// Why a case misses what is wanted, and whether finer particles may help.
    fn judge(&self, record: &CaseRecord, bar_percent: Option<f64>) -> (Option<Missed>, bool) {
        if let Some(failure) = record.failure {
            return (Some(Missed::Failed), failure.is_instability());
        }
        let Some(outcome) = &record.outcome else { return (Some(Missed::WithoutBars), false) };
        if let Some(reasons) = &outcome.doubtful_reason {
            return (Some(Missed::Doubtful), finer_particles_may_clear(reasons));
        }
        match bar_percent {
            None => (Some(Missed::WithoutBars), outcome.first_force_max.is_some()),
            Some(bar) => ((bar > self.percent).then_some(Missed::Wide), true),
        }
    }

    /// `max_error.csv`: the numerics of each case, and whether its bars meet the aim.
    pub fn csv(&self, study: &Study, verified: &[Verified]) -> String {
        let line = |of: &Verified| Line {
            case_id: study.cases[of.index].id.to_string(),
            particle_spacing_m: of.spacing_m,
            numerics: differences(&study.cases[of.index].config),
            error_bar_percent: of.bar_percent,
            max_error_percent: self.percent,
            met: of.missed.is_none(),
        };
        csv_of(&verified.iter().map(line).collect::<Vec<_>>())
    }
}

/// The larger of the bars of force and displacement, percent of their values.
fn bar_percent(record: &CaseRecord, bars: &ErrorBars) -> Option<f64> {
    let outcome = record.outcome.as_ref()?;
    let share = |bar: Option<f64>, value: Option<Maximum>| {
        let value = value?.value;
        (value > 0.0).then_some(100.0 * bar? / value)
    };
    let force = share(bars.force, outcome.first_force_max);
    let displacement = share(bars.displacement, outcome.displacement_max);
    force.into_iter().chain(displacement).max_by(f64::total_cmp)
}

impl Study {
    /// The same cases as a sweep that aims at an error in percent.
    pub fn aiming_at(mut self, percent: f64) -> Study {
        let aim = format!("{} max-error {percent}", self.identity);
        self.identity = digits(Sha256::new_with_prefix(aim));
        self.max_error_percent = Some(percent);
        self
    }

    /// The same sweep, with a pair of error bars. Cases for which `choose` returns one are
    /// replaced. The sweep keeps its identity through every such choice, so that its directory
    /// takes all of them.
    pub fn with_choices(&self, choose: impl Fn(usize) -> Option<CaseConfig>) -> Study {
        let mut cases = self.cases.clone();
        for case in &mut cases {
            if let Some(config) = choose(case.index) {
                case.id = CaseId::of(&config);
                case.config = config;
            }
        }
        let bars = vec![crate::scene::ErrorBars::Pair; cases.len()];
        let (name, keys) = (self.name.clone(), self.keys.clone());
        let study = Study::of(name, keys, cases, &bars, &self.file_text);
        let (limits, max_error_percent) = (self.limits, self.max_error_percent);
        let (identity, sets, unread) =
            (self.identity.clone(), self.sets.clone(), self.unread.clone());
        Study { identity, limits, max_error_percent, sets, unread, ..study }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_keep_the_sweeps_identity() {
        let text = "name = \"a\"\n[grid]\nwave_height_ratio = [0.2, 0.3]";
        let study = Study::new(&crate::study::SweepFile::read(text, &[]).unwrap()).unwrap();
        let mut finer = study.cases[1].config.clone();
        finer.numerics.particle_spacing_m = 0.016;
        let chosen = study.with_choices(|index| (index == 1).then(|| finer.clone()));
        assert_eq!(chosen.identity, study.identity);
        assert_eq!(chosen.cases[0].id, study.cases[0].id);
        assert_ne!(chosen.cases[1].id, study.cases[1].id);
        assert_eq!(chosen.companions.len(), 2);
    }
}
