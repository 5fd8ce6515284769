//! Water that comes to rest before the clock starts.

use super::Monitor;
use super::energy::WaterEnergy;
use super::failure::Stopped;
use super::logbook::Logbook;
use super::rested_water::{self, Key};
use super::run::Run;
use crate::body::{BodyMotion, Place};
use crate::math::simd::SimdPath;
use crate::scheme::{NextStep, StepWalls};

/// The water is slowed down over this share of the relaxation time.
const SLOWED_OVER: f64 = 1.0 / 6.0;

impl Run {
    /// Lets the water come to rest between walls at rest, if the scene asks for it.
    ///
    /// A lattice cannot fill the wedge before a shore. Water that does not fit there runs down into
    /// the tank as a wave. So it is slowed down, u' = -u/τ, until it has spread. The clock and the
    /// energy budget start after that.
    pub(super) fn relax(&mut self, path: SimdPath, monitor: &dyn Monitor) -> Result<(), Stopped> {
        if self.config.numerics.relaxation_time_s == 0.0 {
            return Ok(());
        }
        let key = Key::of(self, path);
        match rested_water::recall(&key) {
            Some((water, steps)) if monitor.over_limit(steps).is_none() => {
                self.tank.water.restore(water);
                self.clock.steps = steps;
            }
            _ => {
                self.come_to_rest(monitor)?;
                // The memory of a case must stay within its limit, so no state is kept for others.
                if monitor.limits().memory_mib.is_none() {
                    rested_water::keep(key, &self.tank.water.state(), self.clock.steps);
                }
            }
        }
        let start = WaterEnergy::of(self.tank.water.as_ref(), self.tank.frame.gravity);
        self.logbook = Logbook::open(&self.config, &self.tank, start);
        Ok(())
    }

    /// Lets the water come to rest, and stops it in the end.
    fn come_to_rest(&mut self, monitor: &dyn Monitor) -> Result<(), Stopped> {
        let time = self.config.numerics.relaxation_time_s;
        let mut bodies = self.tank.motions(self.clock.time);
        for place in [Place::Left, Place::Right] {
            bodies[place] = BodyMotion { offset: bodies[place].offset, ..BodyMotion::default() };
        }
        let next = NextStep { bodies: &bodies, dt: self.time_step };
        let walls = StepWalls { bodies: &bodies, acceleration: 0.0, next };
        let (mut gone, mut slowed) = (0.0, 0.0);
        while gone < time || !self.tank.water.can_be_kept() {
            self.hold_to_limits(monitor)?;
            let dt = self.step(&bodies)?;
            self.tank.water.prepare(&bodies, dt).map_err(|error| self.step_failure(&error))?;
            self.tank.water.finish(dt, &walls, false);
            self.clock.steps += 1;
            gone += dt;
            if self.tank.water.can_be_kept() {
                self.tank.water.slow_down(libm::exp((slowed - gone) / (SLOWED_OVER * time)));
                slowed = gone;
                monitor.reached(self.clock.time - (time - gone).max(0.0));
                if monitor.cancelled() {
                    return Err(Stopped::Interrupted);
                }
            }
        }
        self.tank.water.slow_down(0.0);
        Ok(())
    }
}
