//! A square patch of water in free rotation: tension inside, arms that grow from its corners.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use super::filling::{Filling, Walls};
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::math::simd::SimdPath;
use crate::theory::rotating_patch::RotatingPatch;

/// The `[scene]` table with `kind = "rotating-patch"`, complete: no walls, no gravity, the patch's
/// centre at the origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotatingPatchScene {
    /// Side L, metres.
    pub side_m: f64,
    /// ω at the start, 1/s; `sound_speed_ratio` is over ω L.
    pub rotation_rate_per_s: f64,
    /// ρ0, kg/m³.
    pub water_density_kg_per_m3: f64,
    /// The run ends at this time, seconds.
    pub end_time_s: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval_s: f64,
}

impl Default for RotatingPatchScene {
    fn default() -> Self {
        RotatingPatchScene {
            side_m: 1.0,
            rotation_rate_per_s: 1.0,
            water_density_kg_per_m3: 1000.0,
            end_time_s: 2.0,
            history_interval_s: 0.02,
        }
    }
}

impl RotatingPatchScene {
    /// The patch at its start.
    pub fn patch(&self) -> RotatingPatch {
        RotatingPatch { side: self.side_m, rate: self.rotation_rate_per_s }
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("side_m", self.side_m)?;
        check.positive("rotation_rate_per_s", self.rotation_rate_per_s)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        check.positive("end_time_s", self.end_time_s)?;
        check.positive("history_interval_s", self.history_interval_s)
    }

    pub(super) fn frame(&self) -> Frame {
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

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, 90.0)
    }

    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, patch, lattice) = (self.frame(), self.patch(), self.lattice(numerics));
        let half = 0.5 * self.side_m;
        let points = lattice.points(|_, _| [frame.density; 2]);
        let centred =
            points.into_iter().map(|[x, y, of_state, mass]| [x - half, y - half, of_state, mass]);
        let filling = Filling {
            walls: Walls::None,
            ..Filling::of(lattice, centred.collect(), frame.density)
        };
        let filling = filling
            .under(&frame, numerics, |place| frame.density * patch.pressure_over_density(place))
            .moving(|place| patch.velocity(place));
        filling.tank(frame, numerics, path)
    }
}
