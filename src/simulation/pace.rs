//! How long a step is, and what may end a run between the checks of its health.

use super::Monitor;
use super::failure::{Failure, FailureKind, Stopped};
use super::run::Run;
use crate::body::Motions;

/// Steps shorter than this share of the longest ones are a sign of particles that run away.
const SHORTEST: f64 = 0.01;
/// Steps between two questions whether to stop. Checks of health come by simulated time, and there
/// may be very many steps between two of them.
const STEPS_PER_QUESTION: u64 = 50;

impl Run {
    /// The length of the next step, seconds.
    ///
    /// # Errors
    /// The water is not healthy. It is asked where the steps become so short that the next check,
    /// which comes by simulated time, may never come.
    pub(super) fn step(&mut self, bodies: &Motions) -> Result<f64, Failure> {
        let dt = self.time_step.min(self.tank.water.step_limit());
        if dt < SHORTEST * self.time_step {
            self.check_health(bodies)?;
        }
        Ok(dt)
    }

    /// Whether the run is to stop as soon as its state can be kept.
    ///
    /// # Errors
    /// It stops at once, as nobody keeps its state.
    pub(super) fn is_to_stop(&self, monitor: &dyn Monitor) -> Result<bool, Stopped> {
        let stops = monitor.cancelled();
        if stops && monitor.keeper().is_none() { Err(Stopped::Interrupted) } else { Ok(stops) }
    }

    /// The same every so many steps. In between it is what it was.
    pub(super) fn is_still_to_stop(
        &self,
        was: bool,
        monitor: &dyn Monitor,
    ) -> Result<bool, Stopped> {
        let asks = self.clock.steps.is_multiple_of(STEPS_PER_QUESTION);
        if asks { self.is_to_stop(monitor) } else { Ok(was) }
    }

    /// Ends a run that takes more than it may.
    pub(super) fn hold_to_limits(&self, monitor: &dyn Monitor) -> Result<(), Failure> {
        let over = monitor.over_limit(self.clock.steps);
        over.map_or(Ok(()), |detail| Err(self.failure(FailureKind::OverLimit, detail)))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;
    use crate::math::simd::SimdPath;
    use crate::math::team::Team;
    use crate::scene::CaseConfig;

    /// Counts steps, stops after some, and ends a run that goes on nevertheless.
    struct Watch {
        steps: AtomicU64,
        stops_after: u64,
    }

    impl Monitor for Watch {
        fn cancelled(&self) -> bool {
            self.steps.load(Ordering::Relaxed) >= self.stops_after
        }

        fn over_limit(&self, steps: u64) -> Option<String> {
            self.steps.store(steps, Ordering::Relaxed);
            (steps > 500).then(|| "no end".to_owned())
        }
    }

    fn still_water(numerics: &str) -> Run {
        let config = CaseConfig::of(
            "kind = \"hydrostatic\"\nend_time_s = 1",
            &format!("scheme = \"isph\"\nparticle_spacing_m = 0.05\n{numerics}"),
        );
        Run::start(&config, SimdPath::widest(), &Team::default())
    }

    /// The story: a particle ran away. Steps became ever shorter, and the time stood still before the
    /// next check.
    #[test]
    fn a_particle_that_runs_away_between_two_checks_ends_the_run() {
        let mut run = still_water("");
        let mut state = run.state();
        let mut water = serde_json::to_value(&state.water).unwrap();
        let speeds = water.pointer_mut("/Isph/fluid/vx").unwrap();
        speeds[7] = serde_json::json!(1e6);
        state.water = serde_json::from_value(water).unwrap();
        run.restore(state);
        let ended = run.advance(&Watch { steps: AtomicU64::new(0), stops_after: u64::MAX });
        let Err(Stopped::Failed(failure)) = ended else { panic!("{ended:?}") };
        assert_eq!(failure.kind, FailureKind::RunawaySpeed, "{failure}");
    }

    /// The story: steps of 1e-7 s were asked for. Ctrl-C was heeded after 20 ms of simulated time.
    #[test]
    fn short_steps_do_not_keep_a_run_from_stopping() {
        let mut run = still_water("time_step_s = 1e-7");
        let ended = run.advance(&Watch { steps: AtomicU64::new(0), stops_after: 60 });
        assert!(matches!(ended, Err(Stopped::Interrupted)), "{ended:?}");
    }
}
