//! Still water in a box: Huang et al. 2019, Figs. 2-4.

use super::contract::SceneOfKind;
use super::filling::Filling;
use super::frame::Frame;
use super::lattice::Lattice;
use super::leaning;
use super::numerics::Numerics;
use super::still_water::still_water;
use super::tank::Tank;
use crate::keys::{ConfigError, section};
use crate::math::simd::SimdPath;

section! {
    /// The `[scene]` table with `kind = "hydrostatic"`, complete.
    pub struct HydrostaticScene in "scene" {
        /// Still water depth h.
        still_water_depth_m: f64 = 0.3, unit("m").above_zero();
        /// Between the toes of the end walls.
        tank_length_m: f64 = 1.0, unit("m").above_zero();
        /// Gravity g.
        gravity_m_per_s2: f64 = 9.81, unit("m/s²").above_zero();
        /// Density of still water at zero pressure.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// Angle of the right wall from the bed; 90 is vertical, 120 leans away from the water.
        wall_angle_deg: f64 = 90.0, unit("°").within(30.0, 150.0);
        /// The run ends at this time.
        end_time_s: f64 = 35.0, unit("s").above_zero();
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.05, unit("s").above_zero();
    }
}

impl SceneOfKind for HydrostaticScene {
    fn frame(&self) -> Frame {
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

    fn water_area(&self) -> f64 {
        leaning::water_area(self.wall_angle_deg, &self.frame())
    }

    fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, self.wall_angle_deg).squared()
    }

    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        leaning::validate(self.wall_angle_deg, self.still_water_depth_m, self.tank_length_m)
    }

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let filling = Filling {
            wall_angle_deg: self.wall_angle_deg,
            ..still_water(&frame, self.lattice(numerics), numerics)
        };
        filling.tank(frame, numerics, path)
    }
}
