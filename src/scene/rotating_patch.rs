//! A square patch of water in free rotation: tension inside, arms that grow from its corners.

use super::contract::{SceneOfKind, Walls};
use super::filling::Filling;
use super::frame::Frame;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::section;
use crate::math::simd::SimdPath;
use crate::theory::rotating_patch::RotatingPatch;

section! {
    /// The `[scene]` table with `kind = "rotating-patch"`, complete: no walls, no gravity, the patch's
    /// centre at the origin.
    pub struct RotatingPatchScene in "scene" {
        /// Side L.
        side_m: f64 = 1.0, unit("m").above_zero();
        /// ω at the start; `sound_speed_ratio` is over ω L.
        rotation_rate_per_s: f64 = 1.0, unit("1/s").above_zero();
        /// ρ0.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// The run ends at this time.
        end_time_s: f64 = 2.0, unit("s").above_zero();
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.02, unit("s").above_zero();
    }
}

impl RotatingPatchScene {
    /// The patch at its start.
    pub fn patch(&self) -> RotatingPatch {
        RotatingPatch { side: self.side_m, rate: self.rotation_rate_per_s }
    }
}

impl SceneOfKind for RotatingPatchScene {
    fn depth_name(&self) -> &'static str {
        "patch's side"
    }

    fn walls(&self) -> Walls {
        Walls::None
    }

    fn frame(&self) -> Frame {
        Frame {
            length: self.side_m,
            depth: self.side_m,
            gravity: 0.0,
            speed: Some(self.rotation_rate_per_s * self.side_m),
            density: self.water_density_kg_per_m3,
            end_time: self.end_time_s,
            history_interval: self.history_interval_s,
        }
    }

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, patch, lattice) = (self.frame(), self.patch(), self.lattice(numerics));
        let half = 0.5 * self.side_m;
        let points = lattice.points(|_, _| [frame.density; 2]);
        let centred =
            points.into_iter().map(|[x, y, of_state, mass]| [x - half, y - half, of_state, mass]);
        let filling = Filling {
            walls: self.walls(),
            ..Filling::of(lattice, centred.collect(), frame.density)
        };
        let filling = filling
            .under(&frame, numerics, |place| frame.density * patch.pressure_over_density(place))
            .moving(|place| patch.velocity(place));
        filling.tank(frame, numerics, path)
    }
}
