//! `summary.csv`: one row per finished case, in grid order, made from the journal.

use std::path::Path;

use serde::Serialize;

use super::error::SweepError;
use super::error_bars::ErrorBars;
use super::record::CaseRecord;
use super::{atomic_file, number};
use crate::scene::{CaseConfig, SeawallScene, WallChoice};
use crate::simulation::{Maximum, Outcome};
use crate::study::{Case, Study};

/// One column: its name and its text for a case.
type Column = (&'static str, fn(&Row<'_>) -> String);

struct Row<'a> {
    config: &'a CaseConfig,
    record: &'a CaseRecord,
    bars: ErrorBars,
}

impl Row<'_> {
    /// A value of the seawall's scene, empty for other scenes.
    fn scene(&self, value: impl Fn(&SeawallScene) -> f64) -> String {
        self.config.scene.seawall().map(|scene| number::text(value(scene))).unwrap_or_default()
    }

    fn movable(&self, value: impl Fn(&SeawallScene) -> Option<f64>) -> String {
        let scene = self.config.scene.seawall();
        let value = scene.filter(|scene| scene.wall == WallChoice::Movable).and_then(value);
        value.map(number::text).unwrap_or_default()
    }

    /// A number of a case that went well, empty otherwise.
    fn number(&self, value: impl Fn(&Outcome) -> Option<f64>) -> String {
        let value = self.record.outcome.as_ref().and_then(value);
        value.map(number::text).unwrap_or_default()
    }

    fn bar(&self, bar: Option<f64>) -> String {
        bar.map(number::text).unwrap_or_default()
    }

    /// Likewise for counts and flags.
    fn word<T: ToString>(&self, value: impl Fn(&Outcome) -> Option<T>) -> String {
        let value = self.record.outcome.as_ref().and_then(value);
        value.map(|value| value.to_string()).unwrap_or_default()
    }

    fn value(&self, maximum: impl Fn(&Outcome) -> Option<Maximum>) -> String {
        self.number(|outcome| maximum(outcome).map(|maximum| maximum.value))
    }

    fn time(&self, maximum: impl Fn(&Outcome) -> Option<Maximum>) -> String {
        self.number(|outcome| maximum(outcome).map(|maximum| maximum.time_s))
    }
}

/// The name that a choice has in scene files.
fn name(choice: impl Serialize) -> String {
    match serde_json::to_value(choice) {
        Ok(serde_json::Value::String(name)) => name,
        _ => String::new(),
    }
}

/// log10(k/(ρ h² g)); `None` for k = 0.
fn log10_k_star(scene: &SeawallScene) -> Option<f64> {
    let stiffness = scene.spring_stiffness_n_per_m.filter(|&stiffness| stiffness > 0.0)?;
    let depth = scene.still_water_depth_m;
    let scale = scene.water_density_kg_per_m3 * depth * depth * scene.gravity_m_per_s2;
    Some(libm::log10(stiffness / scale))
}

/// m/(ρ h²).
fn m_star(scene: &SeawallScene) -> Option<f64> {
    let depth = scene.still_water_depth_m;
    let scale = scene.water_density_kg_per_m3 * depth * depth;
    scene.seawall_mass_kg_per_m.map(|mass| mass / scale)
}

#[rustfmt::skip]
const COLUMNS: &[Column] = &[
    ("case_id", |row| row.record.id.to_string()),
    ("status", |row| if row.record.is_ok() { "ok" } else { "failed" }.to_owned()),
    ("reason", |row| row.record.reason.clone()),
    ("wave_height_ratio", |row| row.scene(|scene| scene.wave_height_ratio)),
    ("spring_stiffness_n_per_m", |row| row.movable(|scene| scene.spring_stiffness_n_per_m)),
    ("seawall_mass_kg_per_m", |row| row.movable(|scene| scene.seawall_mass_kg_per_m)),
    ("log10_k_star", |row| row.movable(log10_k_star)),
    ("m_star", |row| row.movable(m_star)),
    ("measured_wave_height_ratio", |row| row.number(|outcome| outcome.measured_wave_height_ratio)),
    ("force_max", |row| row.value(|outcome| Some(outcome.force_max))),
    ("force_max_time_s", |row| row.time(|outcome| Some(outcome.force_max))),
    ("runup_max", |row| row.value(|outcome| Some(outcome.runup_max))),
    ("runup_max_time_s", |row| row.time(|outcome| Some(outcome.runup_max))),
    ("displacement_max", |row| row.value(|outcome| outcome.displacement_max)),
    ("displacement_max_time_s", |row| row.time(|outcome| outcome.displacement_max)),
    ("first_force_max", |row| row.value(|outcome| outcome.first_force_max)),
    ("first_force_max_time_s", |row| row.time(|outcome| outcome.first_force_max)),
    ("first_runup_max", |row| row.value(|outcome| outcome.first_runup_max)),
    ("first_runup_max_time_s", |row| row.time(|outcome| outcome.first_runup_max)),
    ("first_displacement_max", |row| row.value(|outcome| outcome.first_displacement_max)),
    ("first_displacement_max_time_s", |row| row.time(|outcome| outcome.first_displacement_max)),
    ("first_force_peak", |row| row.number(|outcome| outcome.first_force_peak)),
    ("first_runup_peak", |row| row.number(|outcome| outcome.first_runup_peak)),
    ("force_max_raw", |row| row.number(|outcome| Some(outcome.force_max_raw))),
    ("force_end", |row| row.number(|outcome| Some(outcome.force_end))),
    ("runup_end", |row| row.number(|outcome| Some(outcome.runup_end))),
    ("displacement_end", |row| row.number(|outcome| outcome.displacement_end)),
    ("onset_time_s", |row| row.number(|outcome| outcome.onset_time_s)),
    ("stroke_centre_s", |row| row.number(|outcome| outcome.stroke_centre_s)),
    ("displacement_truncated", |row| row.word(|outcome| outcome.displacement_truncated)),
    ("stops", |row| row.word(|outcome| outcome.stops)),
    ("force_gap_percent", |row| row.number(|outcome| Some(outcome.force_gap_percent))),
    ("energy_gap_percent", |row| row.number(|outcome| Some(outcome.energy_gap_percent))),
    ("particles_lost", |row| row.word(|outcome| Some(outcome.particles_lost))),
    ("force_error", |row| row.bar(row.bars.force)),
    ("runup_error", |row| row.bar(row.bars.runup)),
    ("displacement_error", |row| row.bar(row.bars.displacement)),
    ("steps", |row| row.word(|outcome| Some(outcome.steps))),
    ("particles", |row| row.word(|outcome| Some(outcome.particles))),
    ("pair_evaluations", |row| row.word(|outcome| Some(outcome.pair_evaluations))),
    ("wall_time_s", |row| number::text(row.record.wall_time_s)),
    ("scheme", |row| name(row.config.numerics.scheme)),
    ("boundary", |row| name(row.config.numerics.boundary)),
    ("kernel", |row| name(row.config.numerics.kernel)),
    ("particle_spacing_m", |row| number::text(row.config.numerics.particle_spacing_m)),
    ("force_coupling", |row| row.scene(|scene| scene.force_coupling)),
    ("force_at_rest", |row| row.number(|outcome| Some(outcome.force_at_rest))),
    ("boundary_fallbacks", |row| row.word(|outcome| Some(outcome.boundary_fallbacks))),
    ("force_max_gap_percent", |row| row.number(|outcome| Some(outcome.force_max_gap_percent))),
    ("stop_impulse", |row| row.value(|outcome| outcome.stop_impulse)),
    ("stop_impulse_time_s", |row| row.time(|outcome| outcome.stop_impulse.filter(|stop| stop.value != 0.0))),
    ("force_max_error", |row| row.bar(row.bars.whole_force)),
    ("runup_max_error", |row| row.bar(row.bars.whole_runup)),
    ("doubtful", |row| row.word(|outcome| Some(outcome.doubtful_reason.is_some()))),
    ("doubtful_reason", |row| row.word(|outcome| outcome.doubtful_reason.clone())),
];

/// The columns that every summary has, in order.
pub fn fixed_columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(name, _)| *name)
}

/// Writes the summary of the finished cases; `records` holds the companions, too.
pub(super) fn write(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<(), SweepError> {
    let path = directory.join("summary.csv");
    let text = table(study, records).map_err(|error| SweepError::io(&path)(error.into()))?;
    atomic_file::write(&path, &text)
}

fn table(study: &Study, records: &[Option<CaseRecord>]) -> csv::Result<Vec<u8>> {
    let further: Vec<_> = study
        .keys
        .iter()
        .enumerate()
        .filter(|(_, key)| fixed_columns().all(|name| name != key.as_str()))
        .collect();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut names: Vec<&str> = fixed_columns().collect();
    names.extend(further.iter().map(|(_, key)| key.as_str()));
    writer.write_record(names)?;
    for (case, record) in study.cases.iter().zip(records) {
        let Some(record) = record else { continue };
        let row = Row { config: &case.config, record, bars: study.error_bars(case.index, records) };
        let fixed = COLUMNS.iter().map(|(_, text)| text(&row));
        writer.write_record(fixed.chain(further.iter().map(|&(place, _)| swept(case, place))))?;
    }
    writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))
}

fn swept(case: &Case, place: usize) -> String {
    match &case.assignments[place] {
        None => String::new(),
        Some(toml::Value::String(text)) => text.clone(),
        Some(toml::Value::Float(value)) => number::text(*value),
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::simulation::{Failure, FailureKind};
    use crate::study::SweepFile;

    #[test]
    fn the_columns_are_those_of_the_contract() {
        let names: Vec<_> = fixed_columns().collect();
        let contract = "case_id,status,reason,wave_height_ratio,spring_stiffness_n_per_m,\
            seawall_mass_kg_per_m,log10_k_star,m_star,measured_wave_height_ratio,\
            force_max,force_max_time_s,runup_max,runup_max_time_s,displacement_max,\
            displacement_max_time_s,first_force_max,first_force_max_time_s,first_runup_max,\
            first_runup_max_time_s,first_displacement_max,first_displacement_max_time_s,\
            first_force_peak,first_runup_peak,force_max_raw,force_end,runup_end,displacement_end,\
            onset_time_s,stroke_centre_s,displacement_truncated,stops,force_gap_percent,\
            energy_gap_percent,particles_lost,force_error,runup_error,displacement_error,\
            steps,particles,pair_evaluations,wall_time_s,scheme,boundary,kernel,\
            particle_spacing_m,force_coupling,force_at_rest,boundary_fallbacks,force_max_gap_percent,stop_impulse,\
            stop_impulse_time_s,force_max_error,runup_max_error,doubtful,doubtful_reason";
        assert_eq!(names.join(","), contract);
    }

    #[test]
    fn rows_are_in_grid_order_and_leave_out_what_is_not_there() {
        let text = "name = \"a\"\n[scene]\nseawall_mass_kg_per_m = 50\n[grid]\n\
            wall = [\"fixed\", \"movable\"]\nspring_stiffness_n_per_m = [0, 10]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let record =
            |case: &Case, result| Some(CaseRecord::new(&study, case, &result, 1.0, "here"));
        let good = |case: &Case| record(case, Ok(made_up(&case.config)));
        let detail = "first line\nsecond line".to_owned();
        let failure = Failure { kind: FailureKind::RunawaySpeed, time_s: 0.5, detail };
        let records =
            [good(&study.cases[0]), record(&study.cases[1], Err(failure)), good(&study.cases[2])];
        let bytes = table(&study, &records).unwrap();
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        let headers = reader.headers().unwrap().clone();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        let cell = |row: usize, name: &str| {
            rows[row][headers.iter().position(|header| header == name).unwrap()].to_owned()
        };
        assert_eq!(headers.iter().next_back(), Some("wall"));
        assert_eq!(
            ["spring_stiffness_n_per_m", "m_star", "displacement_max", "wall"]
                .map(|name| cell(0, name)),
            ["", "", "", "fixed"]
        );
        assert_eq!(
            ["status", "log10_k_star", "m_star", "force_max"].map(|name| cell(1, name)),
            ["failed", "", "1.25", ""]
        );
        assert_eq!(cell(1, "reason"), "runaway-speed at t = 0.5000 s: first line second line");
        assert_eq!(cell(2, "status"), "ok");
        let k_star: f64 = cell(2, "log10_k_star").parse().unwrap();
        assert!((10_f64.powf(k_star) - 10.0 / 392.4).abs() < 1e-12);
    }
}
