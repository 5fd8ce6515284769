//! `sweep --max-error`: numerics chosen case by case, verified with error bars, refined where they
//! miss.

use std::collections::BTreeMap;

use serde_json::json;

use super::execute::Done;
use super::failure::BadInput;
use super::output::{Output, short};
use crate::quantities::summary::{CASE_ID, PARTICLE_SPACING};
use crate::scene::CaseConfig;
use crate::sweep::tuning::{AccuracyTable, Choice, bar_percent, differences};
use crate::sweep::{Study, counted};

/// Largest spacing over the depth whose choice can be verified: its companion for the error bars has
/// twice that, and no case may have more than a quarter.
const COARSEST: f64 = 0.125;

/// A wanted error and what is known about meeting it.
pub(super) struct Aim {
    percent: f64,
    table: AccuracyTable,
}

/// Whether a case came out as accurate as wanted.
struct Verified {
    index: usize,
    spacing: f64,
    /// The larger of the bars of force and displacement, percent; `None` without bars.
    bar: Option<f64>,
}

impl Aim {
    /// An aim in percent.
    pub(super) fn new(percent: f64, study: &Study) -> Result<Aim, BadInput> {
        if !(percent.is_finite() && percent > 0.0) {
            let told = format!("accuracy.max_error_percent = {percent}: must be a number above 0");
            return Err(BadInput(told));
        }
        if study.keys.iter().any(|key| key == "particle_spacing_m") {
            let told =
                "--max-error chooses the particle spacing, but [grid] sweeps it: leave one out";
            return Err(BadInput(told.to_owned()));
        }
        Ok(Aim { percent, table: AccuracyTable::stored() })
    }

    fn choose(&self, config: &CaseConfig, at_most: f64, swept: &[String]) -> Option<Choice> {
        self.table.choose(config, self.percent, at_most, swept)
    }

    /// The study with the numerics that are expected to do, and why, told.
    pub(super) fn first(&self, study: &Study, output: &Output) -> Study {
        let mut told: BTreeMap<String, usize> = BTreeMap::new();
        for case in &study.cases {
            let Some(choice) = self.choose(&case.config, COARSEST, &study.keys) else { continue };
            let doubt = if choice.meets { "the cheapest expected to do" } else { "the best known" };
            let line = format!(
                "{}: {doubt}, {} % of force and displacement in {} s of {}",
                choice.method,
                short(choice.expected_percent),
                short(choice.cost_s),
                choice.because
            );
            *told.entry(line).or_default() += 1;
        }
        for (line, cases) in told {
            output.note(format_args!("{} with {line}", counted(cases, "case")));
        }
        let chosen = study
            .with_choices(|_, config| Some(self.choose(config, COARSEST, &study.keys)?.config));
        chosen.aiming_at(self.percent)
    }

    /// The study with finer spacings where the bars are too wide and the table has any.
    pub(super) fn refine(&self, study: &Study, done: &Done, output: &Output) -> Option<Study> {
        let mut finer = BTreeMap::new();
        for case in self.verify(study, done) {
            if case.bar.is_none_or(|bar| bar <= self.percent) {
                continue;
            }
            let config = &study.cases[case.index].config;
            let depth = config.scene.seawall()?.still_water_depth_m;
            let at_most = 0.99 * case.spacing / depth;
            if let Some(choice) = self.choose(config, at_most, &study.keys) {
                finer.insert(case.index, choice.config);
            }
        }
        if finer.is_empty() {
            return None;
        }
        output.note(format_args!(
            "bars wider than {} % in {}: once more, finer",
            self.percent,
            counted(finer.len(), "case")
        ));
        Some(study.with_choices(|index, _| finer.get(&index).cloned()))
    }

    /// Writes `max_error.csv`: which case got which numerics and whether its bars keep to the aim.
    pub(super) fn report(
        &self,
        study: &Study,
        done: &Done,
    ) -> anyhow::Result<(String, serde_json::Value)> {
        let verified = self.verify(study, done);
        let met = |case: &Verified| case.bar.is_some_and(|bar| bar <= self.percent);
        let mut table = csv::Writer::from_path(done.directory.path().join("max_error.csv"))?;
        table.write_record([
            CASE_ID.name,
            PARTICLE_SPACING.name,
            "numerics",
            "error_bar_percent",
            "max_error_percent",
            "met",
        ])?;
        for case in &verified {
            let bar = case.bar.map(|bar| bar.to_string()).unwrap_or_default();
            let own = &study.cases[case.index];
            table.write_record([
                own.id.to_string(),
                case.spacing.to_string(),
                differences(&own.config.numerics),
                bar,
                self.percent.to_string(),
                met(case).to_string(),
            ])?;
        }
        table.flush()?;
        let count = verified.iter().filter(|case| met(case)).count();
        let told = format!(
            "bars of force and displacement within {} %: {count} of {} (max_error.csv)\n",
            self.percent,
            counted(study.cases.len(), "case")
        );
        let value = json!({ "max_error_percent": self.percent, "met": count });
        Ok((told, value))
    }

    fn verify(&self, study: &Study, done: &Done) -> Vec<Verified> {
        let records = done.directory.runs();
        let of = |case: &crate::sweep::Case| {
            let record = records[case.index].as_ref().filter(|record| record.is_ok())?;
            let bars = study.error_bars(case.index, records);
            let spacing = case.config.numerics.particle_spacing_m;
            Some(Verified { index: case.index, spacing, bar: bar_percent(record, &bars) })
        };
        study.cases.iter().filter_map(of).collect()
    }
}
