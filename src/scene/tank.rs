//! A tank ready to run.

use super::frame::Frame;
use super::numerics::Numerics;
use crate::body::{BodyMotion, FixedWall, Motions, Paddle, Place, Wall};
use crate::scheme::Scheme;

/// A tank, ready to run.
#[derive(Debug)]
pub struct Tank {
    /// The water and its walls, at rest.
    pub water: Box<dyn Scheme>,
    /// The paddle at the start of the tank; none for still water.
    pub paddle: Option<Paddle>,
    /// The motion that an absorbing paddle has added to its own so far.
    pub added: BodyMotion,
    /// Whether the paddle absorbs waves that come back to it.
    pub absorbs: bool,
    /// The wall at its end.
    pub wall: Wall,
    /// Hydrostatic force on the right wall along x, N per metre of width.
    pub static_force: f64,
    /// Whether the wall's force, as reported and in its motion, is relative to the run's own force
    /// at rest.
    pub from_rest: bool,
    /// F_th over the hydrostatic force; infinite without a threshold.
    pub threshold_ratio: f64,
    /// F* below which an impact is over. It is that of spring walls, for any wall.
    pub impact_ratio: f64,
    /// H/h of the wave; 0 for none.
    pub wave_height_ratio: f64,
    /// Where the wave height is measured, metres from the left wall; none for no wave.
    pub wave_gauge: Option<f64>,
    /// Before this time, seconds, no wave at the gauge is the paddle's.
    pub crest_from: f64,
    /// Speed of a front that may hit a wall at once, m/s; 0 for none.
    pub front_speed: f64,
    /// Speed of water that falls onto a floor behind the wall, or of a drop that starts to stretch,
    /// m/s; 0 for none.
    pub other_speed: f64,
    /// c0, m/s.
    pub sound_speed: f64,
    /// Particle spacing along the bed, metres.
    pub spacing: f64,
    /// The smaller of the still water's depths at the paddle and, if there is any, at the wall,
    /// metres.
    pub least_depth: f64,
    /// Mass of the still water behind the wall, kg per metre of width.
    pub mass_behind: f64,
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
        Tank {
            water,
            paddle: None,
            added: BodyMotion::default(),
            absorbs: false,
            wall: Wall::Fixed(FixedWall::ALONE),
            static_force: frame.static_force(frame.depth),
            from_rest: false,
            threshold_ratio: f64::INFINITY,
            impact_ratio: f64::INFINITY,
            wave_height_ratio: 0.0,
            wave_gauge: None,
            crest_from: 0.0,
            front_speed: 0.0,
            other_speed: 0.0,
            sound_speed: frame.sound_speed(numerics),
            spacing,
            least_depth: frame.depth,
            mass_behind: 0.0,
            start_time: 0.0,
            frame,
        }
    }

    /// Motions of all bodies at a time, seconds, with the wall at its present place.
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

    /// Whether the right wall is vertical.
    pub fn upright(&self) -> bool {
        let wall = self.water.walls().bodies.get(Place::Right.number());
        wall.is_some_and(|wall| wall.plane.normal[1] == 0.0)
    }
}
