//! Taylor-Green vortices in a closed box that the water fills: viscosity alone slows them.

use super::contract::{SceneOfKind, Walls};
use super::filling::Filling;
use super::frame::Frame;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::section;
use crate::math::simd::SimdPath;
use crate::theory::taylor_green::TaylorGreen;

section! {
    /// The `[scene]` table with `kind = "taylor-green"`, complete. Walls let the water slip unless
    /// `slip = "no"`; without gravity, under a pressure that keeps the water whole.
    pub struct TaylorGreenScene in "scene" {
        /// Side of the box.
        box_side_m: f64 = 1.0, unit("m").above_zero();
        /// Vortices along each side.
        cells: u32 = 2, plain().within(1.0, 64.0);
        /// Largest speed U at the start; `sound_speed_ratio` is over it.
        speed_m_per_s: f64 = 1.0, unit("m/s").above_zero();
        /// ρ0.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// Mean pressure over ρ U².
        background_pressure_ratio: f64 = 1.0, plain().within(0.0, 10.0).label("mean pressure/ρU²");
        /// The run ends at this time.
        end_time_s: f64 = 1.0, unit("s").above_zero();
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.02, unit("s").above_zero();
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
}

impl SceneOfKind for TaylorGreenScene {
    fn depth_name(&self) -> &'static str {
        "box's side"
    }

    fn walls(&self) -> Walls {
        Walls::Closed
    }

    fn not_for_isph(&self) -> Option<&'static str> {
        Some("has no surface, which isph takes its pressure from")
    }

    fn frame(&self) -> Frame {
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

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, flow, lattice) = (self.frame(), self.flow(), self.lattice(numerics));
        let mean = self.background_pressure_ratio * flow.speed * flow.speed;
        let points = lattice.points(|_, _| [frame.density; 2]);
        let filling =
            Filling { walls: self.walls(), ..Filling::of(lattice, points, frame.density) };
        let pressure = |place| frame.density * (mean + flow.pressure_over_density(place));
        let filling =
            filling.under(&frame, numerics, pressure).moving(|place| flow.velocity(place));
        filling.tank(frame, numerics, path)
    }
}
