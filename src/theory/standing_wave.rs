//! Linear standing gravity waves between vertical walls, with the damping of small viscosity.

/// A standing wave on water of even depth between walls half a wavelength, or a multiple, apart.
///
/// The potential flow is u = Û cos(ωt) sin(kx) cosh(ky)/sinh(kh) and
/// v = -Û cos(ωt) cos(kx) sinh(ky)/sinh(kh), y from the bed: the surface starts flat and its
/// vertical speed has the amplitude Û.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingWave {
    /// h, metres.
    pub depth: f64,
    /// k, 1/m.
    pub wavenumber: f64,
    /// g, m/s².
    pub gravity: f64,
}

impl StandingWave {
    /// ω = √(g k tanh(kh)), 1/s: Lamb, Hydrodynamics, § 228.
    pub fn frequency(&self) -> f64 {
        let (k, h) = (self.wavenumber, self.depth);
        (self.gravity * k * libm::tanh(k * h)).sqrt()
    }

    /// The amplitude falls as exp(-2νk²t), 1/s: what irrotational motion dissipates between walls
    /// that let the water slip, at any depth (Lamb, § 348).
    pub fn damping(&self, kinematic_viscosity: f64) -> f64 {
        2.0 * kinematic_viscosity * self.wavenumber * self.wavenumber
    }

    /// The flow at t = 0 for Û = 1.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (k, h) = (self.wavenumber, self.depth);
        let scale = 1.0 / libm::sinh(k * h);
        [
            libm::sin(k * x) * libm::cosh(k * y) * scale,
            -libm::cos(k * x) * libm::sinh(k * y) * scale,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAVE: StandingWave = StandingWave { depth: 0.3, wavenumber: 5.0, gravity: 9.81 };

    #[test]
    fn the_flow_has_neither_sources_nor_swirl_and_keeps_to_bed_and_walls() {
        let step = 1e-5;
        for [x, y] in [[0.1, 0.05], [0.4, 0.2], [0.05, 0.29]] {
            let along = |axis: usize, part: usize| {
                let (mut low, mut high) = ([x, y], [x, y]);
                low[axis] -= step;
                high[axis] += step;
                (WAVE.velocity(high)[part] - WAVE.velocity(low)[part]) / (2.0 * step)
            };
            assert!((along(0, 0) + along(1, 1)).abs() < 1e-8);
            assert!((along(1, 0) - along(0, 1)).abs() < 1e-8);
        }
        assert_eq!(WAVE.velocity([0.2, 0.0])[1], 0.0);
        assert!(WAVE.velocity([std::f64::consts::PI / 5.0, 0.1])[0].abs() < 1e-12);
        assert!((WAVE.velocity([0.0, 0.3])[1] + 1.0).abs() < 1e-12);
    }

    #[test]
    fn long_waves_are_those_of_shallow_water() {
        let long = StandingWave { wavenumber: 1e-3, ..WAVE };
        let celerity = long.frequency() / long.wavenumber;
        assert!((celerity - (9.81_f64 * 0.3).sqrt()).abs() < 1e-6);
    }
}
