//! Pressure from density, and the elastic energy.

use serde::{Deserialize, Serialize};

/// Names of the state equations, as scene files spell them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StateEquationChoice {
    /// p = c0² (ρ - ρ_s), Huang et al. 2019, Eq. 3.
    Linear,
    /// p = ρ_s c0²/7 ((ρ/ρ_s)⁷ - 1), Huang et al. 2019, Eq. 4.
    Tait,
}

/// A state equation with its constants; ρ_s is the density at zero pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateEquation {
    /// Linear or Tait.
    pub choice: StateEquationChoice,
    /// ρ_s, kg/m³.
    pub surface_density: f64,
    /// c0, m/s.
    pub sound_speed: f64,
}

const GAMMA: f64 = 7.0;

impl StateEquation {
    /// Pressure, Pa.
    #[inline(always)]
    pub fn pressure(&self, density: f64) -> f64 {
        let c2 = self.sound_speed * self.sound_speed;
        match self.choice {
            StateEquationChoice::Linear => c2 * (density - self.surface_density),
            StateEquationChoice::Tait => {
                let ratio = density / self.surface_density;
                let cube = ratio * ratio * ratio;
                self.surface_density * c2 / GAMMA * (cube * cube * ratio - 1.0)
            }
        }
    }

    /// Density at a pressure, kg/m³.
    pub fn density(&self, pressure: f64) -> f64 {
        let c2 = self.sound_speed * self.sound_speed;
        match self.choice {
            StateEquationChoice::Linear => self.surface_density + pressure / c2,
            StateEquationChoice::Tait => {
                let scaled = 1.0 + GAMMA * pressure / (self.surface_density * c2);
                self.surface_density * libm::pow(scaled, 1.0 / GAMMA)
            }
        }
    }

    /// ρ_s ∫ c²/(c0² ρ) dρ from ρ_s, kg/m³. In still water this and ρ_s g y/c0² add up to a constant.
    #[inline(always)]
    pub fn raised(&self, density: f64) -> f64 {
        let ratio = density / self.surface_density;
        match self.choice {
            StateEquationChoice::Linear => self.surface_density * small_log(ratio - 1.0),
            StateEquationChoice::Tait => {
                let cube = ratio * ratio * ratio;
                self.surface_density * (cube * cube - 1.0) / 6.0
            }
        }
    }

    /// ∫ p/ρ² dρ from ρ_s: elastic energy per unit of mass, J/kg.
    pub fn elastic_energy(&self, density: f64) -> f64 {
        let c2 = self.sound_speed * self.sound_speed;
        // u = ρ/ρ_s - 1 is small: ln(1+u) - u/(1+u) without cancellation.
        let u = density / self.surface_density - 1.0;
        match self.choice {
            StateEquationChoice::Linear => c2 * (libm::log1p(u) - u / (1.0 + u)),
            StateEquationChoice::Tait => {
                let sixth = libm::expm1(6.0 * libm::log1p(u)) / 6.0;
                c2 / GAMMA * (sixth - u / (1.0 + u))
            }
        }
    }
}

/// ln(1 + u) for |u| far below one, up to u⁵.
#[inline(always)]
fn small_log(u: f64) -> f64 {
    u * (1.0 - u * (0.5 - u * (1.0 / 3.0 - u * (0.25 - 0.2 * u))))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// dp/dy = -ρ g in still water, so c² dρ/ρ = -g dy with c² = dp/dρ.
    #[test]
    fn what_diffusion_leaves_alone_is_still_water() {
        for choice in [StateEquationChoice::Linear, StateEquationChoice::Tait] {
            let state = StateEquation { choice, surface_density: 996.0, sound_speed: 14.0 };
            for density in [990.0, 1003.0, 1020.0] {
                let step = 1e-3;
                let slope = |of: &dyn Fn(f64) -> f64| {
                    (of(density + step) - of(density - step)) / (2.0 * step)
                };
                let told = slope(&|at| state.raised(at));
                let aim = 996.0 / (14.0 * 14.0) / density * slope(&|at| state.pressure(at));
                assert!((told / aim - 1.0).abs() < 1e-6, "{choice:?} at {density}: {told}, {aim}");
            }
        }
    }

    #[test]
    fn density_inverts_pressure_and_energy_integrates_it() {
        for choice in [StateEquationChoice::Linear, StateEquationChoice::Tait] {
            let state = StateEquation { choice, surface_density: 996.0, sound_speed: 14.0 };
            assert_eq!(state.pressure(996.0), 0.0);
            for density in [960.0, 990.0, 1003.0, 1050.0] {
                let back = state.density(state.pressure(density));
                assert!((back - density).abs() < 1e-9, "{choice:?}");
                let step = 1e-3;
                let slope = (state.elastic_energy(density + step)
                    - state.elastic_energy(density - step))
                    / (2.0 * step);
                let expected = state.pressure(density) / (density * density);
                assert!((slope - expected).abs() < 1e-7 * 14.0, "{choice:?} at {density}");
            }
            let (step, at) = (1e-3, 996.0);
            let stiffness = (state.pressure(at + step) - state.pressure(at - step)) / (2.0 * step);
            assert!((stiffness - 14.0 * 14.0).abs() < 1e-3);
        }
    }
}
