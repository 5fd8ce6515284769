//! A tank ready to run, and how a seawall scene becomes one.

use super::filling::Filling;
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::seawall::SeawallScene;
use super::still_water::{still_water, still_water_over};
use crate::body::{BodyMotion, FixedWall, Motions, Paddle, Place, Wall};
use crate::math::simd::SimdPath;
use crate::scheme::Scheme;
use crate::theory::hydrostatics::wall_force;

/// The bed reaches this many still water depths beyond a wall that may move.
const BED_BEYOND: f64 = 12.0;

/// And as many before a paddle that gives way to waves.
const BED_BEFORE: f64 = 12.0;

/// A tank, ready to run.
#[derive(Debug)]
pub struct Tank {
    /// The water and its walls, at rest.
    pub water: Box<dyn Scheme>,
    /// The paddle at the start of the tank; none for still water.
    pub paddle: Option<Paddle>,
    /// What an absorbing paddle has added to its own motion so far.
    pub added: BodyMotion,
    /// Whether the paddle lets waves go that come back to it.
    pub absorbs: bool,
    /// The wall at its end.
    pub wall: Wall,
    /// Hydrostatic force on the right wall along x, N per metre of width.
    pub static_force: f64,
    /// The wall's force is told, and moves the wall, relative to the run's own force at rest.
    pub from_rest: bool,
    /// F_th over the hydrostatic force; infinite where there is no threshold.
    pub threshold_ratio: f64,
    /// H/h of the wave; 0 for none.
    pub wave_height_ratio: f64,
    /// Where the wave height is measured, metres from the left wall; none for no wave.
    pub wave_gauge: Option<f64>,
    /// Speed of a front that may hit a wall at once, m/s; 0 for none.
    pub front_speed: f64,
    /// c0, m/s.
    pub sound_speed: f64,
    /// Particle spacing along the bed, metres.
    pub spacing: f64,
    /// The clock at the start, seconds.
    pub start_time: f64,
    /// Scales of the scene.
    pub frame: Frame,
}

impl Tank {
    /// A tank without paddle, moving wall, wave or front; `spacing` is along the bed, metres.
    pub(super) fn of(
        water: Box<dyn Scheme>,
        frame: Frame,
        numerics: &Numerics,
        spacing: f64,
    ) -> Tank {
        let head = frame.speed_squared() * frame.depth;
        Tank {
            water,
            paddle: None,
            added: BodyMotion::default(),
            absorbs: false,
            wall: Wall::Fixed(FixedWall::ALONE),
            static_force: if frame.gravity > 0.0 {
                wall_force(frame.depth, frame.density, frame.gravity)
            } else {
                frame.density * head
            },
            from_rest: false,
            threshold_ratio: f64::INFINITY,
            wave_height_ratio: 0.0,
            wave_gauge: None,
            front_speed: 0.0,
            sound_speed: frame.sound_speed(numerics),
            spacing,
            start_time: 0.0,
            frame,
        }
    }
}

impl Tank {
    /// Motions of all bodies at a time, seconds, with the wall where it is.
    pub fn motions(&self, time: f64) -> Motions {
        let mut motions = Motions::at_rest(self.water.walls().bodies.len());
        if let Some(paddle) = &self.paddle {
            motions[Place::Left] = paddle.motion(time);
            if self.absorbs {
                motions[Place::Left].add(&self.added);
            }
        }
        if let Some(wall) = self.wall.state() {
            motions[Place::Right].offset = wall.displacement;
            motions[Place::Right].velocity = wall.velocity;
        }
        motions
    }

    /// Whether the right wall stands upright.
    pub fn upright(&self) -> bool {
        let wall = self.water.walls().bodies.get(Place::Right.number());
        wall.is_some_and(|wall| wall.plane.normal[1] == 0.0)
    }
}

impl SeawallScene {
    /// When the run ends, seconds.
    fn end_time(&self) -> f64 {
        self.end_time_s.unwrap_or_else(|| {
            let centre = self.paddle().and_then(|paddle| paddle.stroke_centre());
            centre.unwrap_or(0.0) + self.end_after_stroke_centre_s
        })
    }

    pub(super) fn frame(&self) -> Frame {
        Frame {
            length: self.tank_length_m,
            depth: self.still_water_depth_m,
            gravity: self.gravity_m_per_s2,
            speed: None,
            density: self.water_density_kg_per_m3,
            end_time: self.end_time(),
            history_interval: self.history_interval_s,
        }
    }

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, self.wall_angle_deg)
    }

    /// Builds the tank: a lattice of particles in hydrostatic balance between ghost walls.
    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let lattice = self.lattice(numerics);
        let still = match &self.bed {
            Some(profile) => still_water_over(profile, &frame, lattice, numerics),
            None => still_water(&frame, lattice, numerics),
        };
        let filling = Filling {
            wall_angle_deg: self.wall_angle_deg,
            crest: self.crest_shape(),
            // A paddle that gives way goes back past where it stood.
            bed_before_paddle: if self.absorption { BED_BEFORE * frame.depth } else { 0.0 },
            // The same for a fixed wall, so that both share a trunk to the bit.
            bed_beyond_wall: if self.wall_angle_deg == 90.0 {
                BED_BEYOND * frame.depth
            } else {
                0.0
            },
            ..still
        };
        // A wall that stands dry has no hydrostatic force of its own to be measured by.
        let at_wall = self.depth_at_wall_m();
        let depth = if at_wall > 0.0 { at_wall } else { frame.depth };
        let static_force = wall_force(depth, frame.density, frame.gravity);
        Tank {
            paddle: self.paddle(),
            absorbs: self.absorption && self.wave_height_ratio > 0.0,
            wall: self.law(static_force),
            static_force,
            start_time: self.start_s(),
            from_rest: at_wall > 0.0,
            threshold_ratio: self.onset_ratio(static_force),
            wave_height_ratio: self.wave_height_ratio,
            wave_gauge: Some(self.wave_gauge_m),
            ..filling.tank(frame, numerics, path)
        }
    }
}
