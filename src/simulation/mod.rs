//! One case from start to end: [`run_case`]; or the part that it shares with others: [`run_trunk`].

mod absorption;
mod blows;
mod cost;
mod doubt;
mod doubt_reasons;
mod ending;
mod energy;
mod face_gaps;
mod faces;
mod failure;
mod first_impact;
mod force_rise;
mod found_energy;
mod gauge;
mod health;
mod keeping;
mod kept;
mod limits;
mod logbook;
mod looks;
mod measures;
mod named_readings;
mod outcome;
mod overtopping;
mod pace;
mod peak;
#[cfg(test)]
mod planted_faults;
mod probes;
mod quiet_force;
mod quiet_travel;
mod readings;
mod relaxation;
mod rested_water;
mod run;
mod sampling;
mod settling;
mod sound;
mod sounding;
mod state;
mod surface;
mod tongue;
mod wall_load;
mod wall_pressures;
mod watch;
mod waves;
mod window;

pub use cost::{Cost, Resources, cost};
pub use doubt_reasons::{finer_particles_may_clear, kinds_of_doubt};
pub use faces::Face;
pub use failure::{Failure, FailureKind, Stopped};
pub use health::HealthMargins;
pub use kept::Keeper;
pub use limits::Limits;
pub use named_readings::{NamedReading, ProbeColumn, ProbeTable};
pub use outcome::{
    CaseResult, EnergyBudget, EnvelopeRow, HistoryRow, Maximum, Outcome, Overtopped, PhaseShare,
    TrunkResult,
};
pub use probes::probe_columns;
pub use waves::WaveRow;

use crate::pairs::Fluid;
use crate::scene::CaseConfig;
use kept::{Attempt, Kept};
use run::Run;

/// Watches a run and may end it.
pub trait Monitor: Sync {
    /// Another monitor that answers in its place, except for films and stored states.
    fn inner(&self) -> Option<&dyn Monitor> {
        None
    }
    /// Interval of calls to [`Monitor::film`], seconds of simulated time; none by default.
    fn film_interval(&self) -> Option<f64> {
        None
    }
    /// Whether [`Film::faces`] are wanted; not by default.
    fn films_faces(&self) -> bool {
        false
    }
    /// Called at the first step at or after each such time, and at the end.
    fn film(&self, _film: &Film<'_>) {}
    /// Called from time to time with the simulated time reached, seconds. While the water comes to
    /// rest, this is before the start.
    fn reached(&self, time_s: f64) {
        if let Some(inner) = self.inner() {
            inner.reached(time_s);
        }
    }
    /// True when the run should stop at the next step.
    fn cancelled(&self) -> bool {
        self.inner().is_some_and(|inner| inner.cancelled())
    }
    /// The message for a run that takes more than it may by this step. Asked at every step.
    fn over_limit(&self, steps: u64) -> Option<String> {
        self.inner()?.over_limit(steps)
    }
    /// The limits for [`Monitor::over_limit`].
    fn limits(&self) -> Limits {
        self.inner().map_or_else(Limits::default, |inner| inner.limits())
    }
    /// Stores the run's state; none by default.
    fn keeper(&self) -> Option<&dyn Keeper> {
        None
    }
}

/// The water at an instant, for display.
#[derive(Debug, Clone, Copy)]
pub struct Film<'a> {
    /// Simulated time, seconds.
    pub time_s: f64,
    /// Positions of the left and the right wall, metres from rest.
    pub walls: [f64; 2],
    /// The particles.
    pub fluid: &'a Fluid,
    /// Their pressures, Pa.
    pub pressure: &'a [f64],
    /// The faces of the walls; empty unless they are wanted.
    pub faces: &'a [Face],
}

/// A monitor that never interferes.
pub struct Unwatched;

impl Monitor for Unwatched {}

/// Where an attempt starts.
enum Start<'a> {
    Rest,
    Trunk(&'a [u8]),
    Kept(Box<Kept>),
}

/// Runs a case to its end. It starts from rest, from its trunk's checkpoint, or from the state that
/// its monitor has stored; the bits are the same. If it becomes unstable, up to `retries` further
/// attempts from rest follow, each with half the time step of the last. The outcome then says so.
///
/// # Errors
/// The failure of the last attempt, or an interruption.
pub fn run_case(
    config: &CaseConfig,
    checkpoint: Option<&[u8]>,
    resources: impl Into<Resources>,
    monitor: &dyn Monitor,
) -> Result<CaseResult, Stopped> {
    let resources = resources.into();
    let team = resources.team(config);
    let (mut attempt, mut start) = match Kept::of(config, monitor) {
        Some(kept) => (kept.attempt.clone(), Start::Kept(Box::new(kept))),
        None => (Attempt::default(), checkpoint.map_or(Start::Rest, Start::Trunk)),
    };
    loop {
        let tried = attempt.config(config);
        let result = team.lead(|| {
            let mut run = Run::start(&tried, resources.simd, &team);
            run.attempt = attempt.clone();
            match start {
                Start::Rest => run.relax(resources.simd, monitor)?,
                Start::Trunk(bytes) => run.restore(state::decode(bytes, &tried)?),
                Start::Kept(kept) => run.take_up(*kept)?,
            }
            run.advance(monitor)?;
            Ok(run.result())
        });
        match result {
            Err(Stopped::Failed(failure))
                if attempt.retry < config.numerics.retries && failure.kind.is_instability() =>
            {
                attempt.retry += 1;
                let part = 1_u64 << attempt.retry;
                attempt.told =
                    Some(format!("recovered with 1/{part} of the time step after {failure}"));
                start = Start::Rest;
            }
            Ok(mut result) => {
                result.outcome.recovered = attempt.told;
                return Ok(result);
            }
            Err(stopped) => return Err(stopped),
        }
    }
}

/// Runs a trunk ([`CaseConfig::trunk`]) to the last step before the force first exceeds the
/// threshold, or before a run could end early. It starts from rest, or from the state that its
/// monitor has stored.
pub fn run_trunk(
    config: &CaseConfig,
    resources: impl Into<Resources>,
    monitor: &dyn Monitor,
) -> Result<TrunkResult, Stopped> {
    let resources = resources.into();
    let team = resources.team(config);
    let kept = Kept::of(config, monitor);
    team.lead(|| {
        let mut run = Run::start(config, resources.simd, &team);
        match kept {
            Some(kept) => run.take_up(kept)?,
            None => run.relax(resources.simd, monitor)?,
        }
        let state = run.advance_to_onset(monitor)?;
        let (time_s, steps) = state.progress();
        Ok(TrunkResult { checkpoint: state::encode(&state, config), time_s, steps })
    })
}
