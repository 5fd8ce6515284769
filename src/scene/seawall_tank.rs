//! Builds the tank of a seawall scene.

use super::contract::SceneOfKind;
use super::filling::{Basin, Filling};
use super::frame::Frame;
use super::lattice::Lattice;
use super::leaning;
use super::numerics::Numerics;
use super::seawall::SeawallScene;
use super::still_water::{basin, still_water, still_water_over};
use super::tank::Tank;
use crate::keys::ConfigError;
use crate::math::simd::SimdPath;

/// The bed extends this many still water depths beyond a wall that may move.
const BED_BEYOND: f64 = 12.0;

/// And as many before a paddle that absorbs waves.
const BED_BEFORE: f64 = 12.0;
/// A crest passes its gauge no earlier than after this share of the theoretical time.
const EARLY: f64 = 0.9;
/// A paddle that moves back by less than this, in depths, needs no bed behind it.
const LEAST_BACK: f64 = 2e-3;

impl SeawallScene {
    /// When the run ends, seconds.
    fn end_time(&self) -> f64 {
        self.end_time_s.unwrap_or_else(|| {
            let centre = self.paddle().and_then(|paddle| paddle.stroke_centre());
            centre.unwrap_or(0.0) + self.end_after_stroke_centre_s
        })
    }

    /// The still water behind the wall, where there is any.
    fn basin(&self, frame: &Frame, numerics: &Numerics) -> Option<Basin> {
        let (lattice, level) = (self.basin_lattice(numerics)?, self.basin_level()?);
        let (crest, floor) = (self.crest.as_ref()?, self.floor.as_ref()?);
        let start = self.tank_length_m + crest.crest_width_m;
        Some(basin(frame, lattice, [start, floor.floor_height_m, level], numerics))
    }

    /// The earliest time at which the crest of a solitary wave may be at a place, s. It leaves the
    /// paddle in the middle of the stroke, and is no faster than over the paddle's depth.
    pub(super) fn crest_may_pass(&self, place: f64) -> Option<f64> {
        let paddle = self.paddle()?;
        let centre = paddle.stroke_centre()?;
        Some(centre + (place - paddle.motion(centre).offset) / self.celerity())
    }

    /// Speed of a solitary wave over the paddle's depth, m/s.
    pub(super) fn celerity(&self) -> f64 {
        let frame = self.frame();
        (frame.gravity * frame.depth * (1.0 + self.wave_height_ratio)).sqrt()
    }

    /// How far the bed goes on behind the paddle, metres. An absorbing paddle moves back beyond its
    /// start, and a train or a record may do so as well.
    fn bed_before_paddle(&self) -> f64 {
        let depth = self.still_water_depth_m;
        let back = self.paddle().map_or(0.0, |paddle| paddle.goes_back());
        if self.absorption || back > LEAST_BACK * depth { BED_BEFORE * depth + back } else { 0.0 }
    }
}

impl SceneOfKind for SeawallScene {
    fn frame(&self) -> Frame {
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

    fn water_area(&self) -> f64 {
        let frame = self.frame();
        let bed = self.uneven_bed().map(|bed| bed.area_below(frame.depth));
        let before = bed.unwrap_or_else(|| leaning::water_area(self.wall_angle_deg, &frame));
        before + self.basin_area()
    }

    fn lattice(&self, numerics: &Numerics) -> Lattice {
        let lattice = Lattice::whole(&self.frame(), numerics, self.wall_angle_deg);
        if self.is_still() { lattice.squared() } else { lattice }
    }

    fn particles(&self, numerics: &Numerics) -> usize {
        if self.bed.is_some() {
            return (self.water_area() / numerics.particle_spacing_m.powi(2)).round() as usize;
        }
        let behind = self.basin_lattice(numerics).map_or(0, |lattice| lattice.particles());
        self.lattice(numerics).particles() + behind
    }

    fn validate(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        self.validate_parts()?;
        self.validate_bed(numerics)?;
        self.validate_runup(numerics)?;
        self.validate_crest(numerics)?;
        self.validate_absorption(numerics)
    }

    /// A lattice of particles in hydrostatic balance between ghost walls.
    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let lattice = self.lattice(numerics);
        let still = match self.uneven_bed() {
            Some(profile) => still_water_over(profile, &frame, lattice, numerics),
            None => still_water(&frame, lattice, numerics),
        };
        let filling = Filling {
            wall_angle_deg: self.wall_angle_deg,
            crest: self.crest_shape(numerics),
            basin: self.basin(&frame, numerics),
            bed_before_paddle: self.bed_before_paddle(),
            // The same for a fixed wall, so that both share a trunk to the bit.
            bed_beyond_wall: if self.wall_angle_deg == 90.0 {
                BED_BEYOND * frame.depth
            } else {
                0.0
            },
            ..still
        };
        let mass_behind = filling.mass_behind();
        let static_force = frame.static_force(self.force_depth_m());
        Tank {
            paddle: self.paddle(),
            absorbs: self.absorption && self.wave_height_ratio > 0.0,
            wall: self.law(static_force),
            least_depth: self.least_depth_m(),
            mass_behind,
            other_speed: self.fall_speed(),
            static_force,
            start_time: self.start_s(),
            // A dry wall has no hydrostatic force of its own.
            from_rest: self.depth_at_wall_m() > 0.0,
            threshold_ratio: self.onset_ratio(static_force),
            impact_ratio: self.threshold_ratio,
            wave_height_ratio: self.wave_height_ratio,
            wave_gauge: Some(self.wave_gauge_m),
            crest_from: self.crest_may_pass(self.wave_gauge_m).map_or(0.0, |time| EARLY * time),
            ..filling.tank(frame, numerics, path)
        }
    }
}
