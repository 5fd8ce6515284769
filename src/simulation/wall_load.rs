//! The water's load on the wall, and what it lacks at rest.

use super::failure::{Failure, FailureKind};
use super::run::Run;
use crate::body::Place;
use crate::scheme::Load;

/// A paddle stands that moves no faster than this, m/s and, over g, accelerates no more.
const STILL: f64 = 1e-6;

impl Run {
    /// The water's load on the wall, made up for what the force at rest lacks of ρgh²/2.
    ///
    /// A coarse lattice under its surface presses a little too little, in still water and in waves
    /// alike: about (Δx/h)² of it at rest, with supports of 5 spacings. The first force of a run tells how much.
    pub(super) fn wall_load(&mut self) -> Load {
        let load = self.tank.water.load(Place::Right.number());
        if self.logbook.force_at_rest.is_none() {
            self.logbook.force_at_rest = Some(load.force);
            self.logbook.lopsided = self.lopsided(load.force);
        }
        Load { force: load.force + self.lacking_at_rest(), ..load }
    }

    /// The same, which must be a number.
    pub(super) fn finite_load(&mut self) -> Result<Load, Failure> {
        let load = self.wall_load();
        if load.force.is_finite() {
            return Ok(load);
        }
        Err(self.failure(FailureKind::NotANumber, "the wall's force".to_owned()))
    }

    /// How much more than the paddle still water presses the wall with this force at the start, over
    /// ρgh²/2; nothing where the paddle does not stand.
    fn lopsided(&self, force: f64) -> Option<f64> {
        let motion = self.tank.motions(self.clock.time)[Place::Left];
        let gravity = self.tank.frame.gravity;
        // Walls in water of different depths say nothing of one another.
        let alike = self.tank.water.walls().profile.is_none();
        let stands =
            alike && motion.velocity.abs() < STILL && motion.acceleration.abs() < STILL * gravity;
        let paddle = self.tank.water.load(Place::Left.number()).force;
        stands.then(|| (force + paddle) / self.tank.static_force)
    }

    /// What the force on the wall lacks, N per metre of width; nothing where it counts as it is.
    pub(super) fn lacking_at_rest(&self) -> f64 {
        let at_rest = self.logbook.force_at_rest.filter(|_| self.tank.from_rest);
        at_rest.map_or(0.0, |force| self.tank.static_force - force)
    }
}
