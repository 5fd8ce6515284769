//! A small standing wave in a box: its period and its decay are known exactly.

use super::contract::SceneOfKind;
use super::frame::Frame;
use super::numerics::Numerics;
use super::still_water::still_water;
use super::tank::Tank;
use crate::keys::section;
use crate::math::simd::SimdPath;
use crate::theory::standing_wave::StandingWave;

section! {
    /// The `[scene]` table with `kind = "standing-wave"`, complete. The surface starts flat, and the
    /// water at its fastest.
    pub struct StandingWaveScene in "scene" {
        /// Still water depth h.
        still_water_depth_m: f64 = 0.3, unit("m").above_zero();
        /// Between the walls.
        tank_length_m: f64 = 0.6, unit("m").above_zero();
        /// Half wavelengths between the walls.
        half_waves: u32 = 1, plain().within(1.0, 64.0);
        /// Amplitude of the surface over h.
        amplitude_ratio: f64 = 0.02, plain().within(1e-6, 0.3);
        /// Gravity g.
        gravity_m_per_s2: f64 = 9.81, unit("m/s²").above_zero();
        /// Density of still water at zero pressure.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// The run ends after this many periods of linear theory.
        end_after_periods: f64 = 5.25, plain().above_zero();
        /// Spacing of the history's samples.
        history_interval_s: Option<f64> = None, unit("s").above_zero().otherwise("a 200th of a period");
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
}

impl SceneOfKind for StandingWaveScene {
    fn frame(&self) -> Frame {
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

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, wave, speed) = (self.frame(), self.wave(), self.surface_speed());
        let still = still_water(&frame, self.lattice(numerics), numerics);
        let filling = still.moving(|place| wave.velocity(place).map(|part| speed * part));
        filling.tank(frame, numerics, path)
    }
}
