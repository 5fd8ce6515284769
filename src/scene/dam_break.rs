//! A column of water that collapses: Huang et al. 2019, Figs. 5-9.

use serde::{Deserialize, Serialize};

use super::contract::SceneOfKind;
use super::filling::Filling;
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::{ConfigError, section};
use crate::math::simd::SimdPath;
use crate::theory::dam_break::ReleasedColumn;

/// Density, and with it pressure, at the instant of release.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InitialDensity {
    /// Of the column just released, Huang et al. 2019, Eqs. 22-25.
    DamBreak,
    /// Of the column at rest behind its gate.
    Hydrostatic,
}

section! {
    /// The `[scene]` table with `kind = "dam-break"`, complete.
    pub struct DamBreakScene in "scene" {
        /// Height H of the column.
        column_height_m: f64 = 0.6, unit("m").above_zero();
        /// Length L of the column.
        column_length_m: f64 = 1.2, unit("m").above_zero();
        /// Between the end walls, at least the column's length.
        tank_length_m: f64 = 3.2196, unit("m").above_zero();
        /// Gravity g.
        gravity_m_per_s2: f64 = 9.81, unit("m/s²").above_zero();
        /// ρ0, the density at zero pressure.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// Density at the instant of release. A column that fills its tank stays at rest, and has
        /// `hydrostatic` by default. `dam-break` would have no pressure at the wall before it.
        initial_density: Option<InitialDensity> = None,
            plain().otherwise("dam-break; hydrostatic where L is the tank's length");
        /// The run ends at this time.
        end_time_s: Option<f64> = None, unit("s").above_zero().otherwise("8 √(H/g)");
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.002, unit("s").above_zero();
    }
}

/// Default end of a run, in √(H/g).
const END: f64 = 8.0;
/// From the column to the wall it is at least this far, over H, where the front has not come back
/// for long by then.
const FAR_WALL: f64 = 3.3;

impl DamBreakScene {
    /// Whether it runs on until the front comes back from the wall and plunges onto the water
    /// behind it, or until nothing is left of the column.
    pub(super) fn plunges(&self) -> bool {
        let nearer = FAR_WALL * self.column_height_m + self.column_length_m - self.tank_length_m;
        let earlier = nearer.max(0.0) / self.front_speed();
        // An end in a file may be rounded.
        self.frame().end_time > 1.001 * self.usual_end() * self.slenderness() - earlier
    }

    /// 2√(gH), m/s.
    fn front_speed(&self) -> f64 {
        2.0 * (self.gravity_m_per_s2 * self.column_height_m).sqrt()
    }

    /// Whether the column stands between both walls, so that nothing of it is released.
    pub(super) fn fills_tank(&self) -> bool {
        self.column_length_m >= self.tank_length_m
    }

    fn starts_with(&self) -> InitialDensity {
        self.initial_density.unwrap_or(match self.fills_tank() {
            true => InitialDensity::Hydrostatic,
            false => InitialDensity::DamBreak,
        })
    }

    /// The default end, seconds.
    fn usual_end(&self) -> f64 {
        END * (self.column_height_m / self.gravity_m_per_s2).sqrt()
    }

    /// A column shorter than twice its height collapses earlier by this factor: a long wave crosses
    /// it in L/√(gH).
    fn slenderness(&self) -> f64 {
        (0.5 * self.column_length_m / self.column_height_m).min(1.0)
    }

    /// Rows of particles over the depth of the water once it covers the tank.
    pub(super) fn rows_in_the_end(&self, spacing: f64) -> f64 {
        self.column_length_m * self.column_height_m / (self.tank_length_m * spacing)
    }
}

impl SceneOfKind for DamBreakScene {
    fn depth_name(&self) -> &'static str {
        "column height"
    }

    fn frame(&self) -> Frame {
        Frame {
            length: self.tank_length_m,
            depth: self.column_height_m,
            gravity: self.gravity_m_per_s2,
            speed: None,
            density: self.water_density_kg_per_m3,
            end_time: self.end_time_s.unwrap_or(self.usual_end()),
            history_interval: self.history_interval_s,
        }
    }

    fn water_area(&self) -> f64 {
        self.column_length_m * self.column_height_m
    }

    fn lattice(&self, numerics: &Numerics) -> Lattice {
        let size = [self.column_length_m, self.column_height_m];
        Lattice::new(size, numerics.particle_spacing_m, 90.0)
    }

    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        if self.tank_length_m < self.column_length_m {
            let allowed = "must be at least column_length_m";
            return Err(ConfigError::new("scene.tank_length_m", self.tank_length_m, allowed));
        }
        Ok(())
    }

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let lattice = self.lattice(numerics);
        let sound_speed = frame.sound_speed(numerics);
        let pressures = match self.starts_with() {
            InitialDensity::DamBreak => {
                let column = ReleasedColumn {
                    length: self.column_length_m,
                    height: self.column_height_m,
                    density: frame.density,
                    gravity: frame.gravity,
                    sound_speed,
                };
                column.pressures(lattice.columns, lattice.rows)
            }
            InitialDensity::Hydrostatic => {
                let scale = frame.gravity / (sound_speed * sound_speed);
                let rise = |y: f64| libm::expm1(scale * (frame.depth - y));
                let stiffness = frame.density * sound_speed * sound_speed;
                (0..lattice.columns)
                    .flat_map(|_| 0..lattice.rows)
                    .map(|row| stiffness * rise((row as f64 + 0.5) * lattice.spacing[1]))
                    .collect()
            }
        };
        let state = frame.state_equation(numerics, frame.density);
        let points = lattice.points(|_, number| [state.density(pressures[number]); 2]);
        let filling = Filling {
            dry_bed: true,
            bed_beyond_wall: numerics.support_radius_ratio * numerics.particle_spacing_m,
            ..Filling::of(lattice, points, frame.density)
        };
        Tank { front_speed: self.front_speed(), ..filling.tank(frame, numerics, path) }
    }
}
