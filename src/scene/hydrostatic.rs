//! Still water in a box: Huang et al. 2019, Figs. 2-4.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use super::filling::{Filling, still_water};
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::math::simd::SimdPath;

/// The `[scene]` table with `kind = "hydrostatic"`, complete.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HydrostaticScene {
    /// Still water depth h, metres.
    pub still_water_depth_m: f64,
    /// Between the toes of the end walls, metres.
    pub tank_length_m: f64,
    /// Gravity g, m/s².
    pub gravity_m_per_s2: f64,
    /// Density of still water at zero pressure, kg/m³.
    pub water_density_kg_per_m3: f64,
    /// Angle of the right wall from the bed, degrees; 90 is vertical, 120 leans away from the water.
    pub wall_angle_deg: f64,
    /// The run ends at this time, seconds.
    pub end_time_s: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval_s: f64,
}

impl Default for HydrostaticScene {
    fn default() -> Self {
        HydrostaticScene {
            still_water_depth_m: 0.3,
            tank_length_m: 1.0,
            gravity_m_per_s2: 9.81,
            water_density_kg_per_m3: 1000.0,
            wall_angle_deg: 90.0,
            end_time_s: 35.0,
            history_interval_s: 0.05,
        }
    }
}

impl HydrostaticScene {
    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("still_water_depth_m", self.still_water_depth_m)?;
        check.positive("tank_length_m", self.tank_length_m)?;
        check.positive("gravity_m_per_s2", self.gravity_m_per_s2)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        check.wall_angle(self.wall_angle_deg, self.still_water_depth_m, self.tank_length_m)?;
        check.positive("end_time_s", self.end_time_s)?;
        check.positive("history_interval_s", self.history_interval_s)
    }

    pub(super) fn frame(&self) -> Frame {
        Frame {
            length: self.tank_length_m,
            depth: self.still_water_depth_m,
            gravity: self.gravity_m_per_s2,
            speed: None,
            density: self.water_density_kg_per_m3,
            end_time: self.end_time_s,
            history_interval: self.history_interval_s,
        }
    }

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, self.wall_angle_deg)
    }

    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let filling = Filling {
            wall_angle_deg: self.wall_angle_deg,
            dry_bed: false,
            bed_beyond_wall: 0.0,
            ..still_water(&frame, self.lattice(numerics), numerics)
        };
        filling.tank(frame, numerics, path)
    }
}
