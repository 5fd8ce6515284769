//! Made-up results, for tests of everything around the physics.

use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, EnergyBudget, EnvelopeRow, HistoryRow, Maximum, Outcome, PhaseShare,
};
use crate::study::CaseId;

/// Numbers that are a function of the case's id.
pub fn made_up(config: &CaseConfig) -> CaseResult {
    let id = CaseId::of(config).to_string();
    let number = u64::from_str_radix(&id, 16).unwrap_or(1) as f64 / u64::MAX as f64;
    let movable = config.scene.seawall().is_some_and(|scene| scene.wall.moves());
    let maximum = |value| Maximum { value, time_s: number };
    let outcome = Outcome {
        measured_wave_height_ratio: Some(number),
        force_max: maximum(1.0 + number),
        runup_max: maximum(number / 3.0),
        displacement_max: movable.then(|| maximum(number / 7.0)),
        first_force_max: Some(maximum(1.0 + number / 2.0)),
        first_displacement_max: movable.then(|| maximum(number / 11.0)),
        first_force_peak: Some(1.0 + number / 5.0),
        force_max_raw: 2.0 * number,
        force_at_rest: 1.0,
        force_end: 1.0,
        runup_end: 1e-300 * number,
        displacement_end: movable.then_some(0.0),
        onset_time_s: Some(0.1),
        stroke_centre_s: Some(0.2),
        displacement_truncated: movable.then_some(false),
        moment_max: Some(maximum(1.0 + number / 4.0)),
        first_impulse: Some(number),
        rise_time_s: Some(0.1 + number),
        stops: movable.then_some(3),
        stop_impulse: movable.then(|| maximum(-number)),
        force_gap_percent: 0.3,
        force_max_gap_percent: 0.1,
        energy_gap_percent: -0.1,
        doubtful_reason: (number > 0.5).then(|| "made up".to_owned()),
        steps: 1000,
        particles: 100,
        pair_evaluations: 12_345,
        ..Outcome::default()
    };
    let row = |step: u32| HistoryRow {
        time_s: f64::from(step) * 0.005,
        force: 1.0 + number * f64::from(step),
        runup: number,
        displacement: 0.0,
        wall_velocity_m_per_s: 0.0,
    };
    let envelope = |height_m| EnvelopeRow {
        height_m,
        pressure_max_pa: 1e3 * number,
        first_pressure_max_pa: Some(1e3 * number),
    };
    CaseResult {
        outcome,
        history: (0..20).map(row).collect(),
        envelope: vec![envelope(0.1), envelope(0.3)],
        waves: Vec::new(),
        probes: None,
        readings: Vec::new(),
        energy: EnergyBudget { paddle_work: 43.0, kinetic: 43.0 * number, ..Default::default() },
        phases: vec![PhaseShare { phase: "made up".to_owned(), seconds: 0.0 }],
        list_rebuilds: 0,
    }
}
