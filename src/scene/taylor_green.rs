//! Taylor-Green vortices in a closed box that the water fills: viscosity alone slows them.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use super::filling::{Filling, Walls};
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::math::simd::SimdPath;
use crate::theory::taylor_green::TaylorGreen;

/// The `[scene]` table with `kind = "taylor-green"`, complete. Walls let the water slip unless
/// `slip = "no"`; without gravity, under a pressure that keeps the water whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TaylorGreenScene {
    /// Side of the box, metres.
    pub box_side_m: f64,
    /// Vortices along each side.
    pub cells: u32,
    /// Largest speed U at the start, m/s; `sound_speed_ratio` is over it.
    pub speed_m_per_s: f64,
    /// ρ0, kg/m³.
    pub water_density_kg_per_m3: f64,
    /// Mean pressure over ρ U².
    pub background_pressure_ratio: f64,
    /// The run ends at this time, seconds.
    pub end_time_s: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval_s: f64,
}

impl Default for TaylorGreenScene {
    fn default() -> Self {
        TaylorGreenScene {
            box_side_m: 1.0,
            cells: 2,
            speed_m_per_s: 1.0,
            water_density_kg_per_m3: 1000.0,
            background_pressure_ratio: 1.0,
            end_time_s: 1.0,
            history_interval_s: 0.02,
        }
    }
}

impl TaylorGreenScene {
    /// The vortices.
    pub fn flow(&self) -> TaylorGreen {
        TaylorGreen {
            wavenumber: std::f64::consts::PI * f64::from(self.cells) / self.box_side_m,
            speed: self.speed_m_per_s,
        }
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("box_side_m", self.box_side_m)?;
        check.range("cells", f64::from(self.cells), 1.0, 64.0)?;
        check.positive("speed_m_per_s", self.speed_m_per_s)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        check.range("background_pressure_ratio", self.background_pressure_ratio, 0.0, 10.0)?;
        check.positive("end_time_s", self.end_time_s)?;
        check.positive("history_interval_s", self.history_interval_s)
    }

    pub(super) fn frame(&self) -> Frame {
        Frame {
            length: self.box_side_m,
            depth: self.box_side_m,
            gravity: 0.0,
            speed: Some(self.speed_m_per_s),
            density: self.water_density_kg_per_m3,
            end_time: self.end_time_s,
            history_interval: self.history_interval_s,
        }
    }

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, 90.0)
    }

    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, flow, lattice) = (self.frame(), self.flow(), self.lattice(numerics));
        let mean = self.background_pressure_ratio * flow.speed * flow.speed;
        let points = lattice.points(|_, _| [frame.density; 2]);
        let filling =
            Filling { walls: Walls::Closed, ..Filling::of(lattice, points, frame.density) };
        let pressure = |place| frame.density * (mean + flow.pressure_over_density(place));
        let filling =
            filling.under(&frame, numerics, pressure).moving(|place| flow.velocity(place));
        filling.tank(frame, numerics, path)
    }
}
