//! Readings of the water at every step, at every sample, and in a health check.

use super::energy::WaterEnergy;
use super::failure::{Failure, FailureKind};
use super::first_impact::StepReading;
use super::health::Vitals;
use super::looks::{next, passed};
use super::outcome::{EnergyBudget, HistoryRow};
use super::overtopping::Overtopping;
use super::probes;
use super::quiet_travel::Mount;
use super::run::Run;
use super::sounding::Sounding;
use super::surface::APART;
use super::tongue::Tongue;
use super::wall_pressures::Lever;
use crate::body::{BodyMotion, Motions, Place};
use crate::scene::FARTHEST_WALL;
use crate::theory::hydrostatics::wall_force;

/// Looks between two checks for clusters.
const LOOKS_PER_CLUSTER_CHECK: u64 = 20;
/// Where the water at a wall is shallower than this many support radii, its level is read only at
/// the wall.
const SHALLOW: f64 = 3.0;

impl Run {
    /// Takes a step's reading, and the wave gauge's if it is due, before the wall moves. The force
    /// on the wall is in N per metre of width, the wall's acceleration in m/s².
    pub(super) fn read(&mut self, (force, acceleration): (f64, f64)) -> StepReading {
        let Run { tank, logbook, clock, lens, bed, tongue, .. } = self;
        let (frame, depth) = (tank.frame, tank.frame.depth);
        let at_wall = tank.water.level_at(Place::Right.number());
        let on_beach = |tongue: &mut Tongue| tongue.level(tank.water.fluid(), at_wall);
        let at_wall = tongue.as_mut().map_or(at_wall, on_beach);
        let wall = tank.wall.state();
        let (_, radius) = tank.water.kernel();
        let toe = bed.map_or(0.0, |[toe, _]| toe);
        // Over a level bed the water must now be deeper than a support radius.
        let deep = if toe == 0.0 { at_wall > radius } else { depth - toe > SHALLOW * radius };
        // Above a crest the surface goes on, and no wall determines its slope.
        let top = tank.water.walls().crest.as_ref().map(|crest| crest.height);
        let deep = deep && top.is_none_or(|top| at_wall < top);
        let inside = (tank.wave_gauge.is_some() && tank.upright() && deep).then(|| {
            let face = frame.length + wall.unwrap_or_default().displacement;
            tank.water.level_in_water(face - APART * radius, lens.from(at_wall, toe))
        });
        logbook.level.feel(clock.time, (acceleration, at_wall), frame.acceleration());
        let runup = logbook.level.over_rest(lens, at_wall, inside);
        let runup = bed.map_or(runup, |bed| logbook.level.over_dry(runup, [at_wall, depth], bed));
        // Where water is about to go over the crest, it is as high as the crest.
        let runup = top.map_or(runup, |top| runup.min(top.max(at_wall) - logbook.level.at_rest()));
        let reading = StepReading {
            time: clock.time,
            force: force / tank.static_force,
            // Without gravity there is no level. A gap in a box full of water is none.
            runup: if frame.gravity > 0.0 { runup / depth } else { 0.0 },
            displacement: wall.map_or(0.0, |wall| wall.displacement / depth),
            stops: wall.map_or(0, |wall| wall.stops),
        };
        let motion = BodyMotion {
            offset: wall.unwrap_or_default().displacement,
            velocity: wall.unwrap_or_default().velocity,
            ..BodyMotion::default()
        };
        let compression = logbook.sound.as_mut().and_then(|sound| {
            // φ is that of a wall that no water goes over.
            if top.is_some_and(|top| at_wall >= top) {
                return sound.miss();
            }
            let (place, now) = ((frame.length, motion), (clock.time, at_wall));
            sound.hear(tank.water.as_ref(), now, place, (force, tank.static_force))
        });
        let mount = self.mount();
        self.logbook.measures.push(reading, compression, mount);
        self.press(&reading, acceleration);
        let Run { tank, logbook, clock, lens, .. } = self;
        let intervals = frame.intervals();
        if let (Some(crest), Some(overtopping)) =
            (&tank.water.walls().crest, &mut logbook.overtopping)
            && overtopping.is_due(clock.time, tank.start_time, intervals)
        {
            overtopping.look(clock.time, tank, crest);
        }
        if let Some(gauge) = tank.wave_gauge {
            let crest = logbook.gauge.is_due(clock.time, intervals);
            let waves = logbook.measures.waves.as_mut();
            let waves =
                waves.and_then(|waves| waves.is_due(clock.time, intervals).then_some(waves));
            if crest || waves.is_some() {
                let bed = tank.water.walls().profile.as_ref().map_or(0.0, |bed| bed.height(gauge));
                let from = (0.5 * depth).max(bed + 0.5 * radius);
                let level = lens.level_in_water(tank.water.as_mut(), gauge, from);
                if crest {
                    logbook.gauge.read(level, depth, clock.time >= tank.crest_from);
                }
                waves.into_iter().for_each(|waves| waves.rise(clock.time, level));
            }
        }
        reading
    }

    /// Advances a paddle that absorbs waves by `dt` seconds; `motion` is that at the start.
    pub(super) fn give_way(&mut self, dt: f64, motion: BodyMotion) {
        let Run { tank, logbook, clock, lens, .. } = self;
        let Some((absorption, paddle)) = logbook.absorption.as_mut().zip(tank.paddle.as_ref())
        else {
            return;
        };
        let (_, radius) = tank.water.kernel();
        let at_face = tank.water.level_at(Place::Left.number());
        let inside =
            tank.water.level_in_water(motion.offset + APART * radius, lens.from(at_face, 0.0));
        let levels = (at_face, inside);
        absorption.advance((clock.time, dt), levels, (paddle, motion), (lens, &tank.frame));
        tank.added = absorption.added();
    }

    /// The wall's mass and spring, if something drives it back.
    pub(super) fn mount(&self) -> Option<Mount> {
        let frame = &self.tank.frame;
        let held = self.tank.wall.restraint()?;
        let sound_speed = frame.sound_speed(&self.config.numerics);
        Mount::new(&held, frame.depth, frame.acceleration(), self.tank.static_force, sound_speed)
    }

    /// Reads the pressures along the wall, and the moment about its foot. The moment is that of the
    /// force, with the arm from the pressures. The wall's acceleration is in m/s².
    fn press(&mut self, reading: &StepReading, acceleration: f64) {
        let Run { tank, logbook, pressed, .. } = self;
        let wall = Place::Right.number();
        if tank.water.walls().bodies.len() <= wall {
            return;
        }
        let motion = BodyMotion { acceleration, ..Default::default() };
        tank.water.face_pressures(wall, &motion, pressed);
        let ghosts = tank.water.walls();
        let (plane, faces) = (ghosts.bodies[wall].plane, ghosts.up(wall));
        let across = plane.normal[0].abs();
        let along = |y: f64| (y - plane.point[1]) / across;
        let end = ghosts.crest.as_ref().map(|crest| along(crest.height));
        let lever = Lever::of(pressed, ghosts.target_y[faces].iter().map(|&y| along(y)), end);
        // Forces are over ½ρgd², moments over ρgd³/6; d is the depth at the wall.
        let weight = tank.frame.density * tank.frame.acceleration();
        let depth = (2.0 * tank.static_force / weight).sqrt();
        let moment = reading.force * 3.0 * lever.arm / (depth * across);
        logbook.measures.press(reading.time, moment, pressed);
    }

    /// Takes a sample of history and probes; `bodies` are the present motions.
    pub(super) fn sample(&mut self, reading: &StepReading, bodies: &Motions) {
        let Run { tank, logbook, clock, .. } = self;
        let (time, depth) = (reading.time, tank.frame.depth);
        let interval = tank.frame.history_interval;
        clock.samples =
            next(clock.samples, passed(time, interval), |count| interval * count as f64 <= time);
        logbook.history.push(HistoryRow {
            time_s: time,
            force: reading.force,
            runup: reading.runup,
            displacement: reading.displacement,
            wall_velocity_m_per_s: tank.wall.state().unwrap_or_default().velocity,
        });
        if let Some(table) = &mut logbook.probes {
            let scales = (tank.frame.gravity, tank.spacing, tank.frame.density);
            let mut water = Sounding::new(tank.water.as_ref(), bodies, scales, &mut self.near);
            table.time_s.push(time);
            table.values.extend(probes::read(&self.config.probes, &mut water, depth));
            table.values.extend(logbook.overtopping.iter().flat_map(Overtopping::values));
        }
        if let Some(watch) = &mut self.watch {
            watch.sample(time, tank.water.fluid());
        }
    }

    /// Compares the pressure on the wall's face with the force, N per metre of width. `bodies` have
    /// the motions before the wall responded, with `acceleration`, m/s².
    ///
    /// # Errors
    /// The wall is too far away.
    pub(super) fn look(
        &mut self,
        reading: &StepReading,
        bodies: &Motions,
        (force, acceleration): (f64, f64),
    ) -> Result<(), Failure> {
        let lacking = self.lacking_at_rest();
        let Run { tank, logbook, clock, .. } = self;
        let (time, depth) = (reading.time, tank.frame.depth);
        clock.looks.is_due(time, 0.0, tank.frame.intervals());
        let motion = BodyMotion { acceleration, ..bodies[Place::Right] };
        let face = tank.water.face_force(Place::Right.number(), &motion);
        let force = force - lacking;
        // At the end of a beach the wall may stand in hardly any water.
        let scale = match &tank.water.walls().profile {
            Some(_) => wall_force(depth, tank.frame.density, tank.frame.gravity),
            None => tank.static_force,
        };
        let gap = 100.0 * (face - force).abs() / force.abs().max(scale);
        logbook.worst_gap = logbook.worst_gap.max(gap);
        logbook.face_gaps.push(time, [face, force].map(|force| force / tank.static_force));
        logbook.health.see_gap(gap / 100.0);
        let x = reading.displacement;
        if x.is_finite() && x.abs() <= FARTHEST_WALL {
            return Ok(());
        }
        Err(self.failure(FailureKind::WallUnstable, format!("the wall is at X = {x:.3} h")))
    }

    /// Checks the water's health. Returns the present energy budget.
    pub(super) fn check_health(&mut self, bodies: &Motions) -> Result<EnergyBudget, Failure> {
        let now = WaterEnergy::of(self.tank.water.as_ref(), self.tank.frame.gravity);
        let energy = self.logbook.ledger.close(now, &self.tank.wall);
        self.logbook.found.push(self.clock.time, -energy.residual());
        let across = self.tank.water.walls().bodies[Place::Right.number()].plane.normal;
        let vitals = Vitals {
            time_s: self.clock.time,
            extent: self.extent(bodies),
            lean: -across[1] / across[0],
            spacing: self.tank.spacing,
            energy_residual: energy.residual(),
            work: energy.paddle_work,
            clusters: self.clock.looks.complete(LOOKS_PER_CLUSTER_CHECK),
        };
        let fluid = self.tank.water.fluid();
        self.logbook.health.check(&self.bounds, fluid, &vitals, &mut self.crowding)?;
        Ok(energy)
    }

    /// The box in which water may be, metres: left, right at the bed, bottom, top. Infinite without
    /// walls.
    fn extent(&self, bodies: &Motions) -> [f64; 4] {
        if self.tank.water.walls().is_empty() {
            let anywhere = f64::INFINITY;
            return [-anywhere, anywhere, -anywhere, anywhere];
        }
        let (frame, room) = (self.tank.frame, self.tank.spacing);
        let right = match &self.tank.water.walls().crest {
            Some(crest) => crest.farthest(room),
            None => frame.length + bodies[Place::Right].offset + room,
        };
        // A floor behind the wall may lie lower than the bed.
        let lowest = self.tank.water.walls().lowest();
        [bodies[Place::Left].offset - room, right, lowest, 4.0 * frame.depth]
    }
}
