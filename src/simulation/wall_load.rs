//! The water's load on the wall, and its error at rest.

use super::failure::{Failure, FailureKind};
use super::run::Run;
use crate::body::Place;
use crate::scheme::Load;

/// A paddle is at rest if it is no faster than this, m/s, and its acceleration over g is no larger.
const STILL: f64 = 1e-6;

impl Run {
    /// The water's load on the wall, corrected by the difference of the force at rest from ρgh²/2.
    ///
    /// Under its surface a coarse lattice presses a little too little, in still water and in waves
    /// alike. With supports of 5 spacings the error is about (Δx/h)² of the force at rest. The
    /// first force of a run gives it.
    pub(super) fn wall_load(&mut self) -> Load {
        let load = self.tank.water.load(Place::Right.number());
        if self.logbook.force_at_rest.is_none() {
            self.logbook.force_at_rest = Some(load.force);
            self.logbook.lopsided = self.lopsided(load.force);
        }
        Load { force: load.force + self.lacking_at_rest(), ..load }
    }

    /// The same; an error if it is not a number.
    pub(super) fn finite_load(&mut self) -> Result<Load, Failure> {
        let load = self.wall_load();
        if load.force.is_finite() {
            return Ok(load);
        }
        Err(self.failure(FailureKind::NotANumber, "the wall's force".to_owned()))
    }

    /// Force of still water on the wall, which is this at the start, less that on the paddle, over
    /// ρgh²/2. None if the paddle is not at rest.
    fn lopsided(&self, force: f64) -> Option<f64> {
        let motion = self.tank.motions(self.clock.time)[Place::Left];
        let gravity = self.tank.frame.gravity;
        // Walls in water of different depths cannot be compared.
        let alike = self.tank.water.walls().profile.is_none();
        let stands =
            alike && motion.velocity.abs() < STILL && motion.acceleration.abs() < STILL * gravity;
        let paddle = self.tank.water.load(Place::Left.number()).force;
        stands.then(|| (force + paddle) / self.tank.static_force)
    }

    /// What the force on the wall lacks at rest, N per metre of width; zero if the force is not
    /// corrected.
    pub(super) fn lacking_at_rest(&self) -> f64 {
        let at_rest = self.logbook.force_at_rest.filter(|_| self.tank.from_rest);
        at_rest.map_or(0.0, |force| self.tank.static_force - force)
    }
}
