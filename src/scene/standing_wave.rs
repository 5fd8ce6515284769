//! A small standing wave in a box: its period and its decay are known exactly.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use super::filling::still_water;
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::math::simd::SimdPath;
use crate::theory::standing_wave::StandingWave;

/// The `[scene]` table with `kind = "standing-wave"`, complete. The surface starts flat, and the
/// water at its fastest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StandingWaveScene {
    /// Still water depth h, metres.
    pub still_water_depth_m: f64,
    /// Between the walls, metres.
    pub tank_length_m: f64,
    /// Half wavelengths between the walls.
    pub half_waves: u32,
    /// Amplitude of the surface over h.
    pub amplitude_ratio: f64,
    /// Gravity g, m/s².
    pub gravity_m_per_s2: f64,
    /// Density of still water at zero pressure, kg/m³.
    pub water_density_kg_per_m3: f64,
    /// The run ends after this many periods of linear theory.
    pub end_after_periods: f64,
    /// Spacing of the history samples, seconds; a 200th of a period by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history_interval_s: Option<f64>,
}

impl Default for StandingWaveScene {
    fn default() -> Self {
        StandingWaveScene {
            still_water_depth_m: 0.3,
            tank_length_m: 0.6,
            half_waves: 1,
            amplitude_ratio: 0.02,
            gravity_m_per_s2: 9.81,
            water_density_kg_per_m3: 1000.0,
            end_after_periods: 5.25,
            history_interval_s: None,
        }
    }
}

impl StandingWaveScene {
    /// The wave.
    pub fn wave(&self) -> StandingWave {
        StandingWave {
            depth: self.still_water_depth_m,
            wavenumber: std::f64::consts::PI * f64::from(self.half_waves) / self.tank_length_m,
            gravity: self.gravity_m_per_s2,
        }
    }

    /// Largest vertical speed of the surface, m/s.
    pub fn surface_speed(&self) -> f64 {
        self.amplitude_ratio * self.still_water_depth_m * self.wave().frequency()
    }

    fn period(&self) -> f64 {
        std::f64::consts::TAU / self.wave().frequency()
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("still_water_depth_m", self.still_water_depth_m)?;
        check.positive("tank_length_m", self.tank_length_m)?;
        check.range("half_waves", f64::from(self.half_waves), 1.0, 64.0)?;
        check.range("amplitude_ratio", self.amplitude_ratio, 1e-6, 0.3)?;
        check.positive("gravity_m_per_s2", self.gravity_m_per_s2)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        check.positive("end_after_periods", self.end_after_periods)?;
        self.history_interval_s.map_or(Ok(()), |span| check.positive("history_interval_s", span))
    }

    pub(super) fn frame(&self) -> Frame {
        Frame {
            length: self.tank_length_m,
            depth: self.still_water_depth_m,
            gravity: self.gravity_m_per_s2,
            speed: None,
            density: self.water_density_kg_per_m3,
            end_time: self.end_after_periods * self.period(),
            history_interval: self.history_interval_s.unwrap_or(self.period() / 200.0),
        }
    }

    pub(super) fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, 90.0)
    }

    pub(super) fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, wave, speed) = (self.frame(), self.wave(), self.surface_speed());
        let still = still_water(&frame, self.lattice(numerics), numerics);
        let filling = still.moving(|place| wave.velocity(place).map(|part| speed * part));
        filling.tank(frame, numerics, path)
    }
}
