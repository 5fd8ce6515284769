//! A tank ready to run, and how a seawall scene becomes one.

use super::filling::{Filling, still_water};
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::seawall::{SeawallScene, WallChoice};
use crate::body::SpringWall;
use crate::math::simd::SimdPath;
use crate::scheme::Scheme;
use crate::theory::goring::GoringPiston;
use crate::theory::hydrostatics::wall_force;

/// Number of the bed among the bodies.
pub const BED: usize = 0;
/// Number of the left wall: the paddle, where there is one.
pub const PADDLE: usize = 1;
/// Number of the right wall: the seawall.
pub const WALL: usize = 2;

/// The bed reaches this many still water depths beyond a wall that may move.
const BED_BEYOND: f64 = 12.0;

/// A tank, ready to run.
#[derive(Debug)]
pub struct Tank {
    /// The water and its walls, at rest.
    pub water: Box<dyn Scheme>,
    /// The paddle's law; none for still water.
    pub piston: Option<GoringPiston>,
    /// The wall's law; none for a fixed wall.
    pub wall: Option<SpringWall>,
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
            piston: None,
            wall: None,
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
            frame,
        }
    }
}

impl Tank {
    /// Whether the right wall stands upright.
    pub fn upright(&self) -> bool {
        self.water.walls().bodies.get(WALL).is_some_and(|wall| wall.plane.normal[1] == 0.0)
    }
}

impl SeawallScene {
    /// The paddle's law; none for still water.
    pub fn piston(&self) -> Option<GoringPiston> {
        (self.wave_height_ratio > 0.0).then(|| {
            GoringPiston::new(
                self.wave_height_ratio,
                self.still_water_depth_m,
                self.gravity_m_per_s2,
                self.paddle_ramp_fraction,
            )
        })
    }

    /// When the run ends, seconds.
    fn end_time(&self) -> f64 {
        let after_stroke =
            |piston: GoringPiston| piston.stroke_centre() + self.end_after_stroke_centre_s;
        self.end_time_s
            .or_else(|| self.piston().map(after_stroke))
            .unwrap_or(self.end_after_stroke_centre_s)
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
        let filling = Filling {
            wall_angle_deg: self.wall_angle_deg,
            // The same for a fixed wall, so that both share a trunk to the bit.
            bed_beyond_wall: if self.wall_angle_deg == 90.0 {
                BED_BEYOND * frame.depth
            } else {
                0.0
            },
            ..still_water(&frame, self.lattice(numerics), numerics)
        };
        let static_force = wall_force(frame.depth, frame.density, frame.gravity);
        let threshold = self.threshold_ratio * static_force;
        let wall = match (self.wall, self.seawall_mass_kg_per_m, self.spring_stiffness_n_per_m) {
            (WallChoice::Movable, Some(mass), Some(stiffness)) => {
                Some(SpringWall::at_rest(mass, stiffness, threshold, self.force_coupling))
            }
            _ => None,
        };
        Tank {
            piston: self.piston(),
            wall,
            from_rest: true,
            threshold_ratio: self.threshold_ratio,
            wave_height_ratio: self.wave_height_ratio,
            wave_gauge: Some(self.wave_gauge_m),
            ..filling.tank(frame, numerics, path)
        }
    }
}
