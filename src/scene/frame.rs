//! The scales of every scene: a tank's length, a depth, gravity, water, an end.

use super::numerics::{Numerics, Scheme};
use crate::scheme::StateEquation;
use crate::scheme::wcsph::DensityDiffusion;
use crate::theory::hydrostatics::wall_force;

/// ν n Δt/R² of explicit viscosity. With it Taylor-Green vortices stay stable for any kernel and
/// support radius R, with artificial viscosity added. With half as much again they do not.
const VISCOUS_NUMBER: f64 = 1.0 / 128.0;

/// α n c0 Δt/Δx of artificial viscosity, explicit over n steps: from about 2.4 on it is unstable.
const ARTIFICIAL_NUMBER: f64 = 1.5;

/// δ c0 Δt/R of density diffusion, explicit over a step. Waves at walls on springs end early from
/// 0.15 on, with Wendland C4 from 0.14 on.
const DIFFUSION_NUMBER: f64 = 0.12;

/// The speed that scales the viscosity of incompressible SPH and its correction of volume, over √(g
/// d). In δ-SPH the speed of sound does so.
const VISCOUS_SPEED: f64 = 8.0;

/// Support radius, in spacings, from which the full Courant number is used. At 3.0 energy grows
/// from a number of 1.7 on, at 4.0 from 2.3 on.
const BROAD_SUPPORT: f64 = 3.9;

/// The scales of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Distance between the faces of both end walls at rest, along the bed, metres.
    pub length: f64,
    /// Depth that scales the results, metres: of the still water, or of the column of a dam break.
    pub depth: f64,
    /// Gravity g, m/s²; 0 for none.
    pub gravity: f64,
    /// Speed that scales the speed of sound, m/s; √(g depth) if it is not given.
    pub speed: Option<f64>,
    /// ρ0, kg/m³.
    pub density: f64,
    /// When the run ends, seconds.
    pub end_time: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval: f64,
}

impl Frame {
    /// The square of the speed that scales the speed of sound, m²/s²: g depth, or from the scene's
    /// own speed.
    pub fn speed_squared(&self) -> f64 {
        self.speed.map_or(self.gravity * self.depth, |speed| speed * speed)
    }

    /// Interval of the history, and √(h/g), s.
    pub fn intervals(&self) -> (f64, f64) {
        (self.history_interval, self.unit_time())
    }

    /// √(h/g), s.
    pub fn unit_time(&self) -> f64 {
        (self.depth / self.acceleration()).sqrt()
    }

    /// What F* is over, N/m: the force of still water of a depth, m, on an upright wall. Without
    /// gravity it is that of ρU² on the box's side.
    pub fn static_force(&self, depth: f64) -> f64 {
        if self.gravity > 0.0 {
            return wall_force(depth, self.density, self.gravity);
        }
        self.density * self.speed_squared() * depth
    }

    /// What F* is over, in symbols. L is the side of the box, U the speed.
    pub fn force_unit(&self) -> &'static str {
        if self.gravity > 0.0 { "½ρgh²" } else { "ρU²L" }
    }

    /// g; if the scene has its own speed, the square of that over the depth, m/s².
    pub fn acceleration(&self) -> f64 {
        self.speed.map_or(self.gravity, |speed| speed * speed / self.depth)
    }

    /// c0, m/s: `sound_speed_ratio` times √(g depth), or times the scene's own speed.
    pub fn sound_speed(&self, numerics: &Numerics) -> f64 {
        numerics.sound_speed_ratio * self.speed_squared().sqrt()
    }

    /// The state equation of water with this density at zero pressure, kg/m³.
    pub(super) fn state_equation(
        &self,
        numerics: &Numerics,
        surface_density: f64,
    ) -> StateEquation {
        StateEquation {
            choice: numerics.state_equation,
            surface_density,
            sound_speed: self.sound_speed(numerics),
        }
    }

    /// The speed that scales viscosity and volume correction in incompressible SPH, m/s.
    pub(super) fn viscous_speed(&self) -> f64 {
        VISCOUS_SPEED * self.speed_squared().sqrt()
    }

    /// Δt/√(Δx/g) of incompressible water. `time_step_s` may make it less than the key tells.
    pub fn gravity_number(&self, numerics: &Numerics) -> f64 {
        let unit = (numerics.particle_spacing_m / self.acceleration()).sqrt();
        let most = numerics.time_step_s.map_or(f64::INFINITY, |step| step / unit);
        numerics.incompressible().gravity_courant_number.min(most)
    }

    /// Time step, seconds.
    ///
    /// Sound bounds c0 Δt/Δx, more tightly for supports narrower than 3.9 Δx. In incompressible
    /// water gravity bounds Δt/√(Δx/g) instead. Viscosity is explicit over n steps (one in
    /// incompressible water). It bounds α n c0 Δt/Δx and ν n Δt/R². Density diffusion bounds
    /// δ c0 Δt/R. The step is never longer than `time_step_s`.
    pub fn time_step(&self, numerics: &Numerics) -> f64 {
        let spacing = numerics.particle_spacing_m;
        let mut bound = match numerics.scheme {
            Scheme::Wcsph => courant_number(numerics) * spacing / self.sound_speed(numerics),
            Scheme::Isph => {
                let number = numerics.incompressible().gravity_courant_number;
                let explicit = numerics.artificial_viscosity * self.viscous_speed();
                let viscous = ARTIFICIAL_NUMBER * spacing / explicit;
                (number * (spacing / self.acceleration()).sqrt()).min(viscous)
            }
        };
        let viscosity = numerics.kinematic_viscosity_m2_per_s.unwrap_or(0.0);
        if viscosity > 0.0 {
            let steps = match numerics.scheme {
                Scheme::Wcsph => numerics.acoustic_substeps,
                Scheme::Isph => 1,
            };
            let explicit = viscosity * f64::from(steps);
            let support_radius = numerics.support_radius_ratio * spacing;
            bound = bound.min(VISCOUS_NUMBER * support_radius * support_radius / explicit);
        }
        numerics.time_step_s.map_or(bound, |step| step.min(bound))
    }
}

/// c0 Δt/Δx as artificial viscosity and density diffusion allow it. It is less for narrow supports,
/// because the shortest sound waves on them are faster in proportion.
fn courant_number(numerics: &Numerics) -> f64 {
    let explicit = numerics.artificial_viscosity * f64::from(numerics.acoustic_substeps);
    let breadth = (numerics.support_radius_ratio / BROAD_SUPPORT).min(1.0);
    let diffused = match numerics.density_diffusion {
        DensityDiffusion::None => f64::INFINITY,
        _ => {
            DIFFUSION_NUMBER * numerics.support_radius_ratio
                / numerics.density_diffusion_coefficient
        }
    };
    (numerics.courant_number * breadth).min(ARTIFICIAL_NUMBER / explicit).min(diffused)
}

#[cfg(test)]
mod tests {
    use crate::scene::CaseConfig;

    fn step(numerics: &str) -> f64 {
        let config = CaseConfig::of("", numerics);
        config.scene.frame().time_step(&config.numerics)
    }

    /// δ of 0.5 and more, which a file may have, once ended as density-out-of-bounds or
    /// energy-growth.
    #[test]
    fn strong_density_diffusion_shortens_the_step() {
        let delta = |value: f64| step(&format!("density_diffusion_coefficient = {value}"));
        assert_eq!(delta(0.3).to_bits(), step("").to_bits());
        assert_eq!(delta(0.0).to_bits(), step("").to_bits());
        let ratio = delta(1.0) / step("");
        assert!((ratio - 0.12 * 5.0 / 1.8).abs() < 1e-12, "{ratio}");
    }
}
