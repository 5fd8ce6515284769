//! What every scene has: a tank's length, a depth, gravity, water, an end.

use super::numerics::{GRAVITY_COURANT_NUMBER, Numerics, Scheme};

/// The scales of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Between the faces of both end walls at rest, along the bed, metres.
    pub length: f64,
    /// Depth that scales the results: of the still water, or of the column that collapses, metres.
    pub depth: f64,
    /// Gravity g, m/s².
    pub gravity: f64,
    /// ρ0, kg/m³.
    pub density: f64,
    /// When the run ends, seconds.
    pub end_time: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval: f64,
}

impl Frame {
    /// c0, m/s: `sound_speed_ratio` times √(g depth).
    pub fn sound_speed(&self, numerics: &Numerics) -> f64 {
        numerics.sound_speed_ratio * (self.gravity * self.depth).sqrt()
    }

    /// Time step, seconds: bounded by c0 Δt/Δx, or Δt/√(Δx/g) where the water is incompressible,
    /// and by `time_step_s`.
    pub fn time_step(&self, numerics: &Numerics) -> f64 {
        let spacing = numerics.particle_spacing_m;
        let bound = match numerics.scheme {
            Scheme::Wcsph => numerics.courant_number * spacing / self.sound_speed(numerics),
            Scheme::Isph => {
                let number = numerics.gravity_courant_number.unwrap_or(GRAVITY_COURANT_NUMBER);
                number * (spacing / self.gravity).sqrt()
            }
        };
        numerics.time_step_s.map_or(bound, |step| step.min(bound))
    }
}
