//! The driver: advances one tank step by step.

use std::time::Instant;

use super::Monitor;
use super::energy::WaterEnergy;
use super::failure::{Failure, FailureKind, Stopped};
use super::health::{Crowding, HealthBounds};
use super::kept::Attempt;
use super::logbook::Logbook;
use super::sounding::Near;
use super::state::{Clock, RunState};
use super::surface::Lens;
use super::tongue::Tongue;
use super::watch::{self, Watch};
use crate::body::{Motions, Place, Wall, WallStep};
use crate::math::simd::SimdPath;
use crate::math::team::Team;
use crate::scene::{CaseConfig, Tank};
use crate::scheme::{Load, NextStep, StepError, StepWalls};
use crate::theory::hydrostatics::wall_force;

/// Looks at the force gap between two checks of health and of the monitor.
const LOOKS_PER_CHECK: u64 = 4;

pub(super) struct Run {
    pub(super) tank: Tank,
    pub(super) config: CaseConfig,
    pub(super) attempt: Attempt,
    pub(super) watch: Option<Box<dyn Watch>>,
    pub(super) lens: Lens,
    /// If the bed is not level: heights of its end and its highest place over its start, metres.
    pub(super) bed: Option<[f64; 2]>,
    /// Water on a beach, if runups are read at a given thickness.
    pub(super) tongue: Option<Tongue>,
    pub(super) films: u64,
    pub(super) time_step: f64,
    pub(super) bounds: HealthBounds,
    pub(super) clock: Clock,
    pub(super) logbook: Logbook,
    /// Memory for samples and checks, so that they allocate none.
    pub(super) near: Near,
    pub(super) crowding: Crowding,
    /// Pressures along the wall, Pa, at the present step.
    pub(super) pressed: Vec<f64>,
    /// Seconds spent in readings.
    pub(super) reading_time: f64,
}

impl Run {
    /// A tank at rest.
    pub fn start(config: &CaseConfig, path: SimdPath, team: &Team) -> Run {
        let mut tank = config.scene.build(&config.numerics, path);
        tank.water.take_on(team);
        let frame = tank.frame;
        let profile = tank.water.walls().profile.as_ref();
        let start = WaterEnergy::of(tank.water.as_ref(), frame.gravity);
        Run {
            time_step: frame.time_step(&config.numerics),
            bounds: HealthBounds::of(&tank, &start),
            clock: Clock { time: tank.start_time, ..Clock::default() },
            logbook: Logbook::open(config, &tank, start),
            watch: watch::of(config, &tank),
            lens: Lens::of(tank.water.kernel()),
            bed: profile.map(|bed| [bed.end()[1], bed.range()[1]]),
            tongue: profile.and_then(|bed| Tongue::of(config, bed)),
            films: 0,
            near: Near::default(),
            crowding: Crowding::default(),
            pressed: Vec::new(),
            reading_time: 0.0,
            config: config.clone(),
            attempt: Attempt::default(),
            tank,
        }
    }

    /// Advances to the end.
    pub fn advance(&mut self, monitor: &dyn Monitor) -> Result<(), Stopped> {
        self.go(false, monitor)?;
        let mount = self.mount();
        self.logbook.measures.finish(mount);
        Ok(())
    }

    /// Advances to the last state that all walls of this trunk share, and returns it. This is
    /// before one of them could first move, or end its run early.
    pub fn advance_to_onset(&mut self, monitor: &dyn Monitor) -> Result<RunState, Stopped> {
        let state = self.go(true, monitor)?;
        Ok(state.expect("a run settles in a step in which its state was kept, or soon after one"))
    }

    /// Advances to the end; with `until_onset` to a trunk's end, and returns the state there.
    fn go(
        &mut self,
        until_onset: bool,
        monitor: &dyn Monitor,
    ) -> Result<Option<RunState>, Stopped> {
        let frame = self.tank.frame;
        let (mut kept, mut stopping) = (None, false);
        self.logbook.make_room(&frame);
        loop {
            let time = self.clock.time;
            self.hold_to_limits(monitor)?;
            let last = time >= frame.end_time * (1.0 - 1e-12);
            let due = frame.history_interval * self.clock.samples as f64 * (1.0 - 1e-12);
            let sample = last || time >= due;
            let look = last || self.clock.looks.comes(time, 0.0, frame.intervals());
            let bodies = self.tank.motions(time);
            let dt = self.step(&bodies)?;
            stopping = self.is_still_to_stop(stopping, monitor)?;
            self.tank.water.prepare(&bodies, dt).map_err(|error| self.step_failure(&error))?;
            let load = self.finite_load()?;
            if until_onset && self.is_onset(load.force, dt) {
                return Ok(Some(self.state()));
            }
            self.keep(monitor, stopping);
            if stopping && self.tank.water.can_be_kept() {
                return Err(Stopped::Interrupted);
            }
            if until_onset && self.may_settle_within(self.to_full_step(dt)) {
                kept = Some(self.state());
            }
            let (moved, step, force) = self.answer(load, dt)?;
            self.tank.water.settle(step.acceleration);
            self.film(monitor, time, last);
            let start = Instant::now();
            let reading = self.read((force, step.acceleration));
            self.logbook.measures.note(time, dt, &step, self.tank.wall.rests());
            if sample {
                self.sample(&reading, &bodies);
            }
            if look {
                self.look(&reading, &bodies, (force, step.acceleration))?;
            }
            self.reading_time += start.elapsed().as_secs_f64();
            if last {
                return Ok(kept);
            }
            if look && self.clock.looks.complete(LOOKS_PER_CHECK) {
                let start = Instant::now();
                let energy = self.check_health(&bodies)?;
                self.reading_time += start.elapsed().as_secs_f64();
                // In trunks, too: their results must not depend on where they end. No wall that
                // moves settles before the wall that never moves.
                self.note_liveliness(&bodies, &energy);
                if self.has_settled(&bodies, &energy) {
                    if !sample {
                        self.sample(&reading, &bodies);
                    }
                    self.film(monitor, time, true);
                    return Ok(kept);
                }
                monitor.reached(time);
                stopping = self.is_to_stop(monitor)?;
            }
            self.tank.wall = moved;
            self.finish_step(dt, bodies, force, step, look);
        }
    }

    /// Whether a trunk ends before a step of `dt` seconds, under this force on the wall, N per
    /// metre of width. It ends in a full step; without an onset, in the last one.
    fn is_onset(&self, force: f64, dt: f64) -> bool {
        let ending = self.clock.time + self.to_full_step(dt) > self.tank.frame.end_time;
        self.tank.water.can_be_kept() && (ending || self.tank.wall.lets_go(force))
    }

    /// With steps of `dt` seconds the next full step comes well within this time, seconds.
    fn to_full_step(&self, dt: f64) -> f64 {
        2.0 * f64::from(self.config.numerics.acoustic_substeps) * dt
    }

    /// The wall's response to the water's load over a step of `dt` seconds: its new state, its
    /// step, and the force on it, N per metre of width.
    fn answer(&mut self, mut load: Load, dt: f64) -> Result<(Wall, WallStep, f64), Failure> {
        let mut wall = self.tank.wall;
        if wall.state().is_some() && (!wall.rests() || wall.lets_go(load.force)) {
            self.tank.water.respond(dt).map_err(|error| self.step_failure(&error))?;
            load = self.wall_load();
        }
        let step = match self.tank.water.kicks() {
            // A wall first leaves its place in a full step: a trunk can only end there.
            _ if !self.tank.water.can_be_kept() && !wall.has_moved() => WallStep::default(),
            true => wall.kick(load.force, load.added_mass, dt),
            false => wall.advance(load.force, load.added_mass, dt),
        };
        Ok((wall, step, load.force - load.added_mass * step.acceleration))
    }

    /// Moves the water under the wall's force, N per metre of width, and records the step.
    fn finish_step(
        &mut self,
        dt: f64,
        mut bodies: Motions,
        force: f64,
        step: WallStep,
        look: bool,
    ) {
        let time = self.clock.time;
        self.give_way(dt, bodies[Place::Left]);
        let after = self.tank.motions(time + dt);
        let paddle_travel = after[Place::Left].offset - bodies[Place::Left].offset;
        bodies[Place::Left].velocity = paddle_travel / dt;
        bodies[Place::Right].velocity = step.travel / dt;
        let paddle_force = self.tank.water.load(Place::Left.number()).force;
        if let Some(watch) = &mut self.watch {
            let on_walls = (0..bodies.len()).map(|body| self.tank.water.load(body).force);
            watch.push(on_walls.sum(), dt);
        }
        let uncounted = force - self.lacking_at_rest();
        let frame = &self.tank.frame;
        let push = wall_force(frame.depth, frame.density, frame.gravity);
        let ledger = &mut self.logbook.ledger;
        ledger.book_paddle([paddle_force, -push], paddle_travel);
        ledger.book_wall(&self.tank.wall, [uncounted, force], step);
        // Splashes dissipate in bursts, and swirls from the start. So sum at every step.
        let look = look || self.watch.is_some();
        self.clock.time += dt;
        self.clock.steps += 1;
        let walls = StepWalls {
            bodies: &bodies,
            acceleration: step.acceleration,
            next: NextStep { bodies: &after, dt: self.time_step },
        };
        let losses = self.tank.water.finish(dt, &walls, look);
        self.logbook.ledger.book_losses(time, look, losses);
    }

    pub(super) fn failure(&self, kind: FailureKind, detail: String) -> Failure {
        Failure { kind, time_s: self.clock.time, detail }
    }

    pub(super) fn step_failure(&self, error: &StepError) -> Failure {
        let kind = match error {
            StepError::SolverDiverged { .. } => FailureKind::SolverDiverged,
        };
        self.failure(kind, error.to_string())
    }
}
