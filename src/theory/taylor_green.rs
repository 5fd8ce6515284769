//! Taylor-Green vortices in a box: an exact solution of the Navier-Stokes equations.

/// Counter-rotating vortices in cells of π/k each way. The usual flow is periodic. Free-slip walls
/// on cell boundaries do not change it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorGreen {
    /// k, 1/m.
    pub wavenumber: f64,
    /// U, the largest speed at the start, m/s.
    pub speed: f64,
}

impl TaylorGreen {
    /// u = U sin(kx) cos(ky), v = -U cos(kx) sin(ky), at the start.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (kx, ky) = (self.wavenumber * x, self.wavenumber * y);
        [self.speed * libm::sin(kx) * libm::cos(ky), -self.speed * libm::cos(kx) * libm::sin(ky)]
    }

    /// p/ρ = U²/4 (cos 2kx + cos 2ky) at the start, m²/s², up to a constant.
    pub fn pressure_over_density(&self, [x, y]: [f64; 2]) -> f64 {
        let twice = 2.0 * self.wavenumber;
        0.25 * self.speed * self.speed * (libm::cos(twice * x) + libm::cos(twice * y))
    }

    /// Decay rate: velocities fall as exp(-2νk²t), 1/s (Taylor & Green 1937).
    pub fn damping(&self, kinematic_viscosity: f64) -> f64 {
        2.0 * kinematic_viscosity * self.wavenumber * self.wavenumber
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (u·∇)u = -∇p/ρ: only viscosity slows the flow.
    #[test]
    fn pressure_balances_the_inertia() {
        let flow = TaylorGreen { wavenumber: 6.0, speed: 1.3 };
        let step = 1e-5;
        for place in [[0.1, 0.2], [0.33, 0.07], [0.5, 0.45]] {
            let slope = |read: &dyn Fn([f64; 2]) -> f64, axis: usize| {
                let (mut low, mut high) = (place, place);
                low[axis] -= step;
                high[axis] += step;
                (read(high) - read(low)) / (2.0 * step)
            };
            let [u, v] = flow.velocity(place);
            for part in 0..2 {
                let of = |p: [f64; 2]| flow.velocity(p)[part];
                let inertia = u * slope(&of, 0) + v * slope(&of, 1);
                let push = slope(&|p| flow.pressure_over_density(p), part);
                assert!((inertia + push).abs() < 1e-7, "{inertia} {push}");
            }
        }
    }
}
