//! Made-up physics: deterministic numbers in no time, for tests of everything around the physics.

use std::time::{Duration, Instant};

use super::runner::Runner;
use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, Cost, EnergyBudget, Failure, FailureKind, HealthMargins, HistoryRow, Maximum,
    Monitor, Outcome, PhaseShare, Stopped, TrunkResult,
};
use crate::study::CaseId;

/// A made-up cost: trunks take half of a case.
pub fn cost(_config: &CaseConfig) -> Cost {
    Cost { particles: 100, steps: 1000, trunk_share: 0.5, memory_bytes: 1 << 20 }
}

/// What a fake case does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It ends well.
    Well,
    /// It fails with a line break in its reason.
    Fails,
    /// It panics.
    Panics,
}

/// A runner whose numbers are a function of the case's id.
#[derive(Debug, Clone, Copy)]
pub struct FakeRunner {
    /// How long each case takes.
    pub delay: Duration,
    /// What becomes of a case.
    pub fate: fn(&CaseConfig) -> Fate,
    /// Whether every trunk fails.
    pub trunks_fail: bool,
}

impl Default for FakeRunner {
    fn default() -> FakeRunner {
        FakeRunner { delay: Duration::ZERO, fate: |_| Fate::Well, trunks_fail: false }
    }
}

impl FakeRunner {
    fn wait(&self, monitor: &dyn Monitor) -> Result<(), Stopped> {
        let start = Instant::now();
        while start.elapsed() < self.delay {
            if monitor.cancelled() {
                return Err(Stopped::Interrupted);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    }
}

fn failure(detail: &str) -> Stopped {
    let detail = detail.to_owned();
    Stopped::Failed(Failure { kind: FailureKind::RunawaySpeed, time_s: 0.5, detail })
}

impl Runner for FakeRunner {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        self.wait(monitor)?;
        if self.trunks_fail {
            return Err(failure("a trunk"));
        }
        let checkpoint = CaseId::of(config).to_string().repeat(1000).into_bytes();
        Ok(TrunkResult { checkpoint, time_s: 1.0, steps: 500 })
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        self.wait(monitor)?;
        if let (Some(checkpoint), Some(trunk)) = (checkpoint, config.trunk()) {
            let expected = CaseId::of(&trunk).to_string();
            assert!(checkpoint.starts_with(expected.as_bytes()), "a checkpoint of another trunk");
        }
        match (self.fate)(config) {
            Fate::Well => Ok(made_up(config)),
            Fate::Fails => Err(failure("first line\nsecond line")),
            Fate::Panics => panic!("a fake panic"),
        }
    }
}

fn made_up(config: &CaseConfig) -> CaseResult {
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
        first_runup_max: None,
        first_displacement_max: movable.then(|| maximum(number / 11.0)),
        first_force_peak: Some(1.0 + number / 5.0),
        first_runup_peak: None,
        force_max_raw: 2.0 * number,
        force_at_rest: 1.0,
        force_end: 1.0,
        runup_end: 1e-300 * number,
        displacement_end: movable.then_some(0.0),
        onset_time_s: Some(0.1),
        stroke_centre_s: Some(0.2),
        displacement_truncated: movable.then_some(false),
        stops: movable.then_some(3),
        stop_impulse: movable.then(|| maximum(-number)),
        force_gap_percent: 0.3,
        force_max_gap_percent: 0.1,
        energy_gap_percent: -0.1,
        particles_lost: 0,
        health: HealthMargins::default(),
        doubtful_reason: (number > 0.5).then(|| "made up".to_owned()),
        recovered: None,
        steps: 1000,
        particles: 100,
        pair_evaluations: 12_345,
        boundary_fallbacks: 0,
    };
    let row = |step: u32| HistoryRow {
        time_s: f64::from(step) * 0.005,
        force: 1.0 + number * f64::from(step),
        runup: number,
        displacement: 0.0,
        wall_velocity_m_per_s: 0.0,
    };
    CaseResult {
        outcome,
        history: (0..20).map(row).collect(),
        probes: None,
        readings: Vec::new(),
        energy: EnergyBudget { paddle_work: 43.0, kinetic: 43.0 * number, ..Default::default() },
        phases: vec![PhaseShare { phase: "made up".to_owned(), seconds: 0.0 }],
        list_rebuilds: 0,
    }
}
