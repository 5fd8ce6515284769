//! What a run reports on its way and at its end.

use super::doubt::Evidence;
use super::energy::WaterEnergy;
use super::measures::MEAN_SPAN;
use super::named_readings::{NamedReading, Readings};
use super::outcome::{CaseResult, EnergyBudget, EnvelopeRow, Outcome, PhaseShare};
use super::overtopping::Overtopping;
use super::readings;
use super::run::Run;
use super::settling::Prospect;
use super::waves::Waves;
use super::{Film, Monitor};
use crate::body::{Motions, Place};
use crate::scene::SeawallScene;

impl Run {
    /// Gives the water to a monitor that films, at the monitor's times and at the end.
    pub(super) fn film(&mut self, monitor: &dyn Monitor, time: f64, last: bool) {
        let Some(interval) = monitor.film_interval() else { return };
        if last || time >= interval * self.films as f64 * (1.0 - 1e-12) {
            self.films = (time / interval * (1.0 + 2e-12) + 1e-9) as u64 + 1;
            let bodies = self.tank.motions(time);
            let faces = if monitor.films_faces() { self.faces(&bodies) } else { Vec::new() };
            monitor.film(&Film {
                time_s: time,
                walls: [Place::Left, Place::Right].map(|place| bodies[place].offset),
                fluid: self.tank.water.fluid(),
                pressure: self.tank.water.pressures(),
                faces: &faces,
            });
        }
    }

    /// Records the water's motion once the paddle stands, for [`Run::has_settled`].
    pub(super) fn note_liveliness(&mut self, bodies: &Motions, energy: &EnergyBudget) {
        let Some(paddle) = &self.tank.paddle else { return };
        if self.config.numerics.stop_when_settled && self.clock.time > paddle.still_from() {
            let frame = self.tank.frame;
            // A standing wave as long as two tanks has its largest motion once in this time.
            let crossing = self.length_now(bodies) / (frame.gravity * frame.depth).sqrt();
            self.logbook.liveliness.note(self.clock.time, energy.kinetic, crossing);
        }
    }

    /// Whether a run may end early within this time, seconds, in a step before which its state can
    /// only be stored now.
    pub(super) fn may_settle_within(&self, seconds: f64) -> bool {
        let Some(paddle) = &self.tank.paddle else { return false };
        let then = self.clock.time + seconds;
        let due = self.clock.looks.due(0.0, self.tank.frame.intervals());
        let can_stop = self.config.numerics.stop_when_settled && then > paddle.still_from();
        can_stop && then > due && self.tank.water.can_be_kept()
    }

    /// Whether no reported maximum can still be exceeded. For that paddle and wall must stand, and
    /// too little energy must be left above that of still water between them. See [`Prospect`].
    /// Always false until the liveliness of the water is known.
    pub(super) fn has_settled(&self, bodies: &Motions, energy: &EnergyBudget) -> bool {
        let Some(lively) = self.logbook.liveliness.energy() else { return false };
        let farthest = self.logbook.measures.displacement.map_or(0.0, |maximum| maximum.value);
        if !self.tank.wall.rests() && !Prospect::stood(farthest) {
            return false;
        }
        let (frame, static_force) = (self.tank.frame, self.tank.static_force);
        // Still water has ρ g V²/(2 L) between walls at the distance L.
        let raised =
            self.logbook.ledger.start.potential * (frame.length / self.length_now(bodies) - 1.0);
        let left = energy.kinetic + (energy.potential - raised).max(0.0);
        let left = left.max(lively) + energy.wall_kinetic + energy.spring;
        let unit = frame.density * frame.gravity * frame.depth.powi(3);
        let held = self.tank.wall.restraint().map(|held| {
            [held.threshold / static_force, held.stiffness * frame.depth / static_force]
        });
        Prospect::of(left / unit, held).leaves(&self.logbook.measures)
    }

    /// Distance from the paddle to the wall, metres.
    fn length_now(&self, bodies: &Motions) -> f64 {
        self.tank.frame.length + bodies[Place::Right].offset - bodies[Place::Left].offset
    }

    /// The results of a run at its end.
    pub fn result(self) -> CaseResult {
        let now = WaterEnergy::of(self.tank.water.as_ref(), self.tank.frame.gravity);
        let energy = self.logbook.ledger.close(now, &self.tank.wall);
        let (outcome, readings) = (self.outcome(&energy), self.readings());
        let envelope = self.envelope();
        let waves = self.logbook.measures.waves.as_ref().map(Waves::rows).unwrap_or_default();
        let water = &self.tank.water;
        let phases = water
            .phases()
            .into_iter()
            .chain([("readings", self.reading_time)])
            // Phases that the scene does not use have taken no time.
            .filter(|&(_, seconds)| seconds > 0.0)
            .map(|(phase, seconds)| PhaseShare { phase: phase.to_owned(), seconds })
            .collect();
        let list_rebuilds = water.list_rebuilds();
        let (history, probes) = (self.logbook.history, self.logbook.probes);
        CaseResult {
            outcome,
            history,
            envelope,
            waves,
            probes,
            readings,
            energy,
            phases,
            list_rebuilds,
        }
    }

    /// The largest pressures up the wall.
    fn envelope(&self) -> Vec<EnvelopeRow> {
        let walls = self.tank.water.walls();
        let heights = &walls.target_y[walls.up(Place::Right.number())];
        let measures = &self.logbook.measures;
        let mut rows = measures.pressed.envelope(heights, &measures.first);
        if !self.has_first_impact() {
            rows.iter_mut().for_each(|row| row.first_pressure_max_pa = None);
        }
        rows
    }

    /// Whether the impact of one wave is told by itself. Scenes without a wave have none. Of a stroke
    /// that plays one wave after another the first is mostly the smallest.
    fn has_first_impact(&self) -> bool {
        let scene = self.config.scene.seawall();
        self.tank.wave_gauge.is_some()
            && !scene.is_some_and(SeawallScene::plays_one_wave_after_another)
    }

    /// The scalars of the summary, with their doubts.
    fn outcome(&self, energy: &EnergyBudget) -> Outcome {
        let Run { tank, logbook, .. } = self;
        let (water, m) = (&tank.water, &logbook.measures);
        let worked = logbook.ledger.worked(tank.absorbs);
        // A paddle that has never moved has done no work.
        let moves = tank.paddle.is_some() && worked > 0.0;
        let scale = if moves { worked } else { logbook.ledger.start.given() };
        let (has_wave, hits_first) = (tank.wave_gauge.is_some(), self.has_first_impact());
        let wall = tank.wall.state();
        let outcome = Outcome {
            measured_wave_height_ratio: logbook.gauge.crest(),
            force_max: m.force.unwrap_or_default(),
            runup_max: m.runup.unwrap_or_default(),
            displacement_max: m.displacement.filter(|_| wall.is_some()),
            first_force_max: m.first.force().filter(|_| hits_first),
            first_runup_max: m.first.runup().filter(|_| hits_first),
            first_displacement_max: m.first.displacement().filter(|_| wall.is_some() && hits_first),
            first_force_peak: m.first.force_peak().filter(|_| hits_first),
            first_runup_peak: m.first.runup_peak().filter(|_| hits_first),
            force_max_raw: m.force_raw.unwrap_or(0.0),
            force_at_rest: logbook.force_at_rest.unwrap_or(0.0) / tank.static_force,
            force_end: m.last[0],
            runup_end: m.last[1],
            displacement_end: wall.map(|_| m.last[2]),
            onset_time_s: m.first.onset(),
            stroke_centre_s: tank.paddle.as_ref().and_then(|paddle| paddle.stroke_centre()),
            displacement_truncated: wall.map(|_| {
                m.displacement
                    .is_some_and(|x| x.value > 0.0 && x.time_s >= self.clock.time - self.time_step)
            }),
            stops: wall.map(|wall| wall.stops),
            stop_impulse: wall.map(|_| m.blows.strongest().unwrap_or_default()),
            doubtful_reason: None,
            moment_max: m.pressed.moment.filter(|_| tank.frame.gravity > 0.0),
            first_moment_max: m.pressed.first_moment(&m.first).filter(|_| hits_first),
            first_impulse: m.first.impulse().filter(|_| hits_first).map(|seconds| {
                let frame = &tank.frame;
                seconds / frame.unit_time()
            }),
            rise_time_s: m.first.rise_time().filter(|_| hits_first),
            force_gap_percent: logbook.worst_gap,
            force_max_gap_percent: m.force.map_or(0.0, |m| logbook.face_gaps.around(m.time_s)),
            energy_gap_percent: 100.0 * energy.residual() / scale,
            particles_lost: logbook.health.lost,
            health: logbook.health.margins,
            recovered: None,
            steps: self.clock.steps,
            overtopped: logbook.overtopping.as_ref().map(Overtopping::overtopped),
            particles: water.fluid().len() as u32 + water.taken().particles,
            pair_evaluations: water.pair_evaluations(),
            boundary_fallbacks: water.boundary_fallbacks(),
        };
        let depth_speed = tank.frame.speed_squared();
        let compressible = water.state_equation().is_some();
        let seawall = self.config.scene.seawall();
        let on_way = seawall.map_or(tank.least_depth, SeawallScene::least_depth_on_way_m);
        // Still water alone moves no wall that needs more than its force.
        let stands = |scene: &SeawallScene| {
            !scene.wall.moves() || scene.onset_ratio(tank.static_force) > 1.0
        };
        // Every end cuts something off a train.
        let single = hits_first && m.waves.is_none();
        let evidence = Evidence {
            gaps: &logbook.face_gaps,
            blows: &m.blows,
            kicked: m.kicked,
            farthest: m.farthest,
            largest_gap: logbook.health.largest_gap(&self.bounds),
            found: &logbook.found,
            work: scale,
            counted_in: match (moves, tank.absorbs) {
                (true, false) => "the paddle's work",
                (true, true) => "the work that passed between paddle and water",
                (false, _) => "the water's initial energy",
            },
            spacing: tank.spacing / tank.least_depth,
            spacing_on_way: tank.spacing / on_way,
            is_wave: has_wave && tank.paddle.is_some(),
            // Means end half their span earlier.
            end: self.clock.time - MEAN_SPAN * tank.frame.unit_time() - self.time_step,
            in_impact: single && wall.is_none() && m.first.is_under_way(),
            goes_over: single && logbook.overtopping.as_ref().is_some_and(Overtopping::goes_on),
            lopsided: logbook.lopsided.filter(|_| compressible && has_wave && tank.upright()),
            over_bed: has_wave && tank.upright() && water.walls().profile.is_some(),
            stays_still: self.config.scene.is_still() && seawall.is_none_or(stands),
            compression_percent: if compressible {
                100.0 * depth_speed / tank.sound_speed.powi(2)
            } else {
                0.0
            },
        };
        Outcome { doubtful_reason: evidence.doubt(&outcome), ..outcome }
    }

    /// Other results of the scene: of the solver, of its flow, of its probes.
    fn readings(&self) -> Vec<NamedReading> {
        let mut all = Readings::default();
        if let Some(solver) = self.tank.water.solver() {
            readings::tell_solver(&mut all, &solver);
        }
        if let Some(watch) = &self.watch {
            watch.tell(self.tank.water.fluid(), &mut all);
        }
        if let Some(overtopping) = &self.logbook.overtopping {
            overtopping.tell(self.tank.water.as_ref(), &mut all);
        }
        if let Some(table) = &self.logbook.probes {
            readings::tell_probes(&mut all, &self.config.scene, &self.config.probes, table);
        }
        all.0
    }
}
