//! The driver: one tank, step by step.

use serde::{Deserialize, Serialize};

use super::Monitor;
use super::energy::{Ledger, WaterEnergy};
use super::failure::{Failure, FailureKind, Stopped};
use super::gauge::CrestGauge;
use super::health::{HealthBounds, HealthState, Vitals};
use super::measures::{Measures, Reading};
use super::outcome::{EnergyBudget, HistoryRow, ProbeTable};
use super::probes;
use super::settling::Liveliness;
use super::sounding::Sounding;
use super::watch::{self, Watch};
use crate::body::{BodyMotion, SpringWall, WallStep};
use crate::math::simd::SimdPath;
use crate::math::team::Team;
use crate::scene::{CaseConfig, PADDLE, Tank, WALL};
use crate::scheme::{NextStep, SchemeState, StepError, StepWalls};

/// Samples of the history between two checks of health and of the monitor.
const SAMPLES_PER_CHECK: u64 = 4;
/// Samples between two looks for clusters.
const SAMPLES_PER_CLUSTER_CHECK: u64 = 20;
/// A scene has at most so many bodies.
const MOST_BODIES: usize = 4;
/// Share of m/(ρ c0 d) that a light wall's time step may be.
const WALL_COURANT: f64 = 1.0;

/// Everything that changes during a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RunState {
    water: SchemeState,
    clock: Clock,
    wall: Option<SpringWall>,
    measures: Measures,
    gauge: CrestGauge,
    ledger: Ledger,
    history: Vec<HistoryRow>,
    level_at_rest: Option<f64>,
    gauge_at_rest: Option<f64>,
    worst_gap: f64,
    health: HealthState,
    liveliness: Liveliness,
    probes: Option<ProbeTable>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    pub(super) time: f64,
    pub(super) steps: u64,
    samples: u64,
}

/// Where a run came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reached {
    /// The end of the run.
    End,
    /// The last step before the force first exceeds the threshold.
    Onset,
}

/// A tank under way.
pub(super) struct Run {
    pub(super) tank: Tank,
    pub(super) config: CaseConfig,
    pub(super) watch: Option<Box<dyn Watch>>,
    pub(super) films: u64,
    pub(super) time_step: f64,
    pub(super) bounds: HealthBounds,
    pub(super) clock: Clock,
    pub(super) measures: Measures,
    pub(super) gauge: CrestGauge,
    pub(super) ledger: Ledger,
    pub(super) history: Vec<HistoryRow>,
    pub(super) level_at_rest: Option<f64>,
    pub(super) gauge_at_rest: Option<f64>,
    pub(super) worst_gap: f64,
    pub(super) health: HealthState,
    pub(super) liveliness: Liveliness,
    pub(super) probes: Option<ProbeTable>,
}

impl Run {
    /// A tank at rest.
    pub fn start(config: &CaseConfig, path: SimdPath, team: &Team) -> Run {
        let mut tank = config.scene.build(&config.numerics, path);
        tank.water.take_on(team);
        let frame = tank.frame;
        let start = WaterEnergy::of(tank.water.as_ref(), frame.gravity);
        Run {
            time_step: frame.time_step(&config.numerics),
            bounds: HealthBounds::of(&tank, &start),
            clock: Clock::default(),
            measures: Measures::new(tank.threshold_ratio, frame.depth, frame.acceleration()),
            gauge: CrestGauge::default(),
            ledger: Ledger::open(start),
            history: Vec::new(),
            level_at_rest: None,
            gauge_at_rest: None,
            worst_gap: 0.0,
            health: HealthState::default(),
            liveliness: Liveliness::default(),
            probes: probes::table(&config.probes),
            watch: watch::of(config, &tank),
            films: 0,
            config: config.clone(),
            tank,
        }
    }

    /// Goes back to a kept state. A wall that was held fixed until then keeps this case's law.
    pub fn restore(&mut self, state: RunState) {
        self.tank.water.restore(state.water);
        self.clock = state.clock;
        if state.wall.is_some() {
            self.tank.wall = state.wall;
        }
        self.measures = state.measures;
        self.gauge = state.gauge;
        self.ledger = state.ledger;
        self.history = state.history;
        self.level_at_rest = state.level_at_rest;
        self.gauge_at_rest = state.gauge_at_rest;
        self.worst_gap = state.worst_gap;
        self.health = state.health;
        self.liveliness = state.liveliness;
        self.probes = state.probes;
    }

    /// All that is needed to go on.
    pub fn state(&self) -> RunState {
        RunState {
            water: self.tank.water.state(),
            clock: self.clock,
            wall: self.tank.wall,
            measures: self.measures.clone(),
            gauge: self.gauge.clone(),
            ledger: self.ledger,
            history: self.history.clone(),
            level_at_rest: self.level_at_rest,
            gauge_at_rest: self.gauge_at_rest,
            worst_gap: self.worst_gap,
            health: self.health,
            liveliness: self.liveliness,
            probes: self.probes.clone(),
        }
    }

    /// Simulated seconds and steps so far.
    pub fn progress(&self) -> (f64, u64) {
        (self.clock.time, self.clock.steps)
    }

    /// Steps to the end, or with `until_onset` to the last state before the force first exceeds
    /// the threshold.
    pub fn advance(
        &mut self,
        until_onset: bool,
        monitor: &dyn Monitor,
    ) -> Result<Reached, Stopped> {
        loop {
            let time = self.clock.time;
            let last = time >= self.tank.frame.end_time * (1.0 - 1e-12);
            let interval = self.tank.frame.history_interval;
            let sample = last || time >= interval * self.clock.samples as f64 * (1.0 - 1e-12);
            let motions = self.motions();
            let bodies = &motions[..self.tank.water.walls().bodies.len()];
            let dt = self.next_step().min(self.tank.water.step_limit());
            self.tank.water.prepare(bodies, dt).map_err(|error| self.step_failure(&error))?;
            self.film(monitor, time, last);
            let mut load = self.tank.water.load(WALL);
            if !load.force.is_finite() {
                return Err(self
                    .failure(FailureKind::NotANumber, "the wall's force".into())
                    .into());
            }
            let full = self.tank.water.can_be_kept();
            let threshold = self.tank.threshold_ratio * self.tank.static_force;
            // A trunk ends in a full step, so ahead of the last one where nothing happens before.
            let soon = 2.0 * f64::from(self.config.numerics.acoustic_substeps) * dt;
            let ending = time + soon > self.tank.frame.end_time;
            if until_onset && full && (ending || load.force > threshold) {
                return Ok(Reached::Onset);
            }
            if self.tank.wall.is_some_and(|wall| {
                wall.displacement > 0.0 || wall.velocity != 0.0 || load.force > wall.threshold
            }) {
                self.tank.water.respond(dt).map_err(|error| self.step_failure(&error))?;
                load = self.tank.water.load(WALL);
            }
            let before = self.tank.wall;
            // A wall first leaves its stop in a full step: only there can a trunk end.
            let step = self
                .tank
                .wall
                .as_mut()
                .filter(|wall| full || wall.has_moved())
                .map(|wall| wall.advance(load.force, load.added_mass, dt));
            let acceleration = step.map_or(0.0, |step| step.acceleration);
            let force = load.force - load.added_mass * acceleration;
            self.read(force, before.as_ref(), sample, bodies, acceleration)?;
            if last {
                return Ok(Reached::End);
            }
            if sample && self.clock.samples.is_multiple_of(SAMPLES_PER_CHECK) {
                let energy = self.check_health(bodies)?;
                // In trunks, too: what they leave must not depend on where they end.
                self.note_liveliness(bodies, &energy);
                if !until_onset && self.has_settled(bodies, &energy) {
                    self.film(monitor, time, true);
                    return Ok(Reached::End);
                }
                monitor.progress(time / self.tank.frame.end_time);
                if monitor.cancelled() {
                    return Err(Stopped::Interrupted);
                }
            }
            self.finish_step(dt, motions, force, step, sample);
        }
    }

    /// Motions of bed, paddle, wall and lid at this instant.
    fn motions(&self) -> [BodyMotion; MOST_BODIES] {
        let mut bodies = [BodyMotion::default(); MOST_BODIES];
        if let Some(piston) = &self.tank.piston {
            let motion = piston.motion(self.clock.time);
            bodies[PADDLE] = BodyMotion {
                offset: motion.position,
                velocity: motion.velocity,
                acceleration: motion.acceleration,
            };
        }
        if let Some(wall) = &self.tank.wall {
            bodies[WALL].offset = wall.displacement;
            bodies[WALL].velocity = wall.velocity;
        }
        bodies
    }

    /// The time step; shorter while a wall moves that is light against the sound it makes.
    fn next_step(&self) -> f64 {
        let Some(wall) = &self.tank.wall else { return self.time_step };
        if self.tank.water.state_equation().is_none() {
            return self.time_step;
        }
        if wall.displacement == 0.0 {
            return self.time_step;
        }
        let depth = self.tank.frame.depth * (1.0 + self.measures.last[1].max(0.0));
        let impedance = self.tank.frame.density * self.tank.sound_speed * depth;
        self.time_step.min(WALL_COURANT * wall.mass / impedance)
    }

    /// Takes this step's readings.
    fn read(
        &mut self,
        force: f64,
        wall: Option<&SpringWall>,
        sample: bool,
        bodies: &[BodyMotion],
        acceleration: f64,
    ) -> Result<(), Stopped> {
        let depth = self.tank.frame.depth;
        let time = self.clock.time;
        let level = self.tank.water.level_at(WALL);
        let at_rest = *self.level_at_rest.get_or_insert(level);
        let runup = (level - at_rest) / depth;
        let force_ratio = force / self.tank.static_force;
        let displacement = wall.map(|wall| wall.displacement / depth);
        self.measures.push(Reading {
            time,
            force: force_ratio,
            runup,
            displacement,
            stops: wall.map_or(0, |wall| wall.stops),
        });
        if !sample {
            return Ok(());
        }
        self.clock.samples += 1;
        while self.tank.frame.history_interval * self.clock.samples as f64 <= time {
            self.clock.samples += 1;
        }
        self.history.push(HistoryRow {
            time_s: time,
            force: force_ratio,
            runup,
            displacement: displacement.unwrap_or(0.0),
            wall_velocity_m_per_s: wall.map_or(0.0, |wall| wall.velocity),
        });
        if let Some(gauge) = self.tank.wave_gauge {
            let crest = self.tank.water.level_in_water(gauge, 0.5 * depth);
            let at_rest = *self.gauge_at_rest.get_or_insert(crest);
            self.gauge.push((crest - at_rest) / depth);
        }
        if let Some(table) = &mut self.probes {
            let scales = (self.tank.frame.gravity, self.tank.spacing, self.tank.frame.density);
            let water = Sounding::new(self.tank.water.as_ref(), bodies, scales);
            table.time_s.push(time);
            table.rows.push(probes::read(&self.config.probes, &water, 4.0 * depth));
        }
        if let Some(watch) = &mut self.watch {
            watch.sample(time, self.tank.water.fluid());
        }
        let motion = BodyMotion { acceleration, ..bodies[WALL] };
        let face = self.tank.water.face_force(WALL, &motion);
        let gap = 100.0 * (face - force).abs() / force.abs().max(self.tank.static_force);
        self.worst_gap = self.worst_gap.max(gap);
        self.health.see_gap(gap / 100.0);
        if displacement.is_some_and(|x| !x.is_finite() || x > 11.0) {
            let detail = format!("the wall is at X = {:.3} h", displacement.unwrap_or(f64::NAN));
            return Err(self.failure(FailureKind::WallUnstable, detail).into());
        }
        Ok(())
    }

    fn finish_step(
        &mut self,
        dt: f64,
        mut motions: [BodyMotion; MOST_BODIES],
        force: f64,
        wall_step: Option<WallStep>,
        sample: bool,
    ) {
        let time = self.clock.time;
        let bodies = &mut motions[..self.tank.water.walls().bodies.len()];
        let paddle_travel = self
            .tank
            .piston
            .as_ref()
            .map_or(0.0, |piston| piston.motion(time + dt).position - bodies[PADDLE].offset);
        bodies[PADDLE].velocity = paddle_travel / dt;
        bodies[WALL].velocity = wall_step.map_or(0.0, |step| step.travel) / dt;
        let paddle_force = self.tank.water.load(PADDLE).force;
        if let Some(watch) = &mut self.watch {
            let on_walls = (0..bodies.len()).map(|body| self.tank.water.load(body).force);
            watch.push(on_walls.sum(), dt);
        }
        let wall = self.tank.wall.as_ref().zip(wall_step).map(|(law, step)| (law, force, step));
        self.ledger.book_walls((paddle_force, paddle_travel), wall);
        // Splashes dissipate in bursts, and swirls from the start: summed at every step.
        let sample = sample || self.watch.is_some();
        self.clock.time += dt;
        self.clock.steps += 1;
        let after = self.motions();
        let walls = StepWalls {
            bodies,
            acceleration: wall_step.map_or(0.0, |step| step.acceleration),
            next: NextStep { bodies: &after[..bodies.len()], dt: self.next_step() },
        };
        let losses = self.tank.water.finish(dt, &walls, sample);
        self.ledger.book_losses(time, sample, losses);
    }

    fn check_health(&mut self, bodies: &[BodyMotion]) -> Result<EnergyBudget, Failure> {
        let now = WaterEnergy::of(self.tank.water.as_ref(), self.tank.frame.gravity);
        let energy = self.ledger.close(now, self.tank.wall.as_ref());
        let across = self.tank.water.walls().bodies[WALL].plane.normal;
        let vitals = Vitals {
            time_s: self.clock.time,
            extent: self.extent(bodies),
            lean: -across[1] / across[0],
            spacing: self.tank.spacing,
            energy_residual: energy.residual(),
            work: energy.paddle_work,
            clusters: self.clock.samples.is_multiple_of(SAMPLES_PER_CLUSTER_CHECK),
        };
        self.health.check(&self.bounds, self.tank.water.fluid(), &vitals)?;
        Ok(energy)
    }

    /// Where water may be, metres: left, right at the bed, bottom, top. Anywhere without walls.
    fn extent(&self, bodies: &[BodyMotion]) -> [f64; 4] {
        if self.tank.water.walls().is_empty() {
            let anywhere = f64::INFINITY;
            return [-anywhere, anywhere, -anywhere, anywhere];
        }
        let (frame, room) = (self.tank.frame, self.tank.spacing);
        let right = frame.length + bodies[WALL].offset + room;
        [bodies[PADDLE].offset - room, right, 0.0, 4.0 * frame.depth]
    }

    fn failure(&self, kind: FailureKind, detail: String) -> Failure {
        Failure { kind, time_s: self.clock.time, detail }
    }

    fn step_failure(&self, error: &StepError) -> Failure {
        let kind = match error {
            StepError::SolverDiverged { .. } => FailureKind::SolverDiverged,
        };
        self.failure(kind, error.to_string())
    }
}
