//! A column of water that collapses: Huang et al. 2019, Figs. 5-9.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use super::filling::Filling;
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
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

/// The `[scene]` table with `kind = "dam-break"`, complete.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DamBreakScene {
    /// Height H of the column, metres.
    pub column_height_m: f64,
    /// Length L of the column, metres.
    pub column_length_m: f64,
    /// Between the end walls, metres.
    pub tank_length_m: f64,
    /// Gravity g, m/s².
    pub gravity_m_per_s2: f64,
    /// ρ0, kg/m³, the density at zero pressure.
    pub water_density_kg_per_m3: f64,
    /// Density at the instant of release.
    pub initial_density: InitialDensity,
    /// The run ends at this time, seconds; 8 √(H/g) by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_time_s: Option<f64>,
    /// Spacing of the history samples, seconds.
    pub history_interval_s: f64,
}

impl Default for DamBreakScene {
    fn default() -> Self {
        DamBreakScene {
            column_height_m: 0.6,
            column_length_m: 1.2,
            tank_length_m: 3.2196,
            gravity_m_per_s2: 9.81,
            water_density_kg_per_m3: 1000.0,
            initial_density: InitialDensity::DamBreak,
            end_time_s: None,
            history_interval_s: 0.002,
        }
    }
}

/// Where no end is given, a run lasts this many √(H/g).
const END: f64 = 8.0;

impl DamBreakScene {
    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("column_height_m", self.column_height_m)?;
        check.positive("column_length_m", self.column_length_m)?;
        check.positive("tank_length_m", self.tank_length_m)?;
        if self.tank_length_m < self.column_length_m {
            let allowed = "must be at least column_length_m";
            return Err(check.error("tank_length_m", self.tank_length_m, allowed));
        }
        check.positive("gravity_m_per_s2", self.gravity_m_per_s2)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        if let Some(end) = self.end_time_s {
            check.positive("end_time_s", end)?;
        }
        check.positive("history_interval_s", self.history_interval_s)
    }

    pub(super) fn frame(&self) -> Frame {
        let unit = (self.column_height_m / self.gravity_m_per_s2).sqrt();
        Frame {
            length: self.tank_length_m,
            depth: self.column_height_m,
            gravity: self.gravity_m_per_s2,
            speed: None,
            density: self.water_density_kg_per_m3,
            end_time: self.end_time_s.unwrap_or(END * unit),
            history_interval: self.history_interval_s,
        }
    }

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        let size = [self.column_length_m, self.column_height_m];
        Lattice::new(size, numerics.particle_spacing_m, 90.0)
    }

    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let frame = self.frame();
        let lattice = self.lattice(numerics);
        let sound_speed = frame.sound_speed(numerics);
        let pressures = match self.initial_density {
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
        Tank {
            front_speed: 2.0 * (frame.gravity * frame.depth).sqrt(),
            ..filling.tank(frame, numerics, path)
        }
    }
}
