//! The force of a standing wave on a wall, to second order in its height (Miche 1944; Goda & Kakizaki 1966).
//!
//! With x from the wall, z from still water, T = tanh kh and the surface η₁ = a cos kx cos σt,
//! ```text
//! φ₁ = -(aσ/k) cosh k(z+h)/sinh kh cos kx sin σt,   σ² = g k T
//! φ₂ = A cosh 2k(z+h)/cosh 2kh cos 2kx sin 2σt + B sin 2σt
//! A = -3/16 a²σ (1-T⁴)/T⁴,   B = a²σ (1+3T²)/(16T²)
//! ```
//! and p/ρ = -gz - φ_t - ½|∇φ|² + K, K = a²σ² (1-T²)/(8T²), which keeps the mean level over a wavelength.

use seawall::theory::standing_wave::StandingWave;

/// A standing wave before a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingWaveForce {
    /// a, metres: the height of each of the two waves that it is made of.
    pub amplitude: f64,
    /// h, metres.
    pub depth: f64,
    /// k, 1/m.
    pub wavenumber: f64,
    /// g, m/s².
    pub gravity: f64,
}

/// How finely a period is searched for its extremes.
const PHASES: u32 = 3600;

impl StandingWaveForce {
    /// F* = F/(½ρgh²) at a phase σt, the push of still water included.
    pub fn at(&self, phase: f64) -> f64 {
        let Self { amplitude: a, depth: h, wavenumber: k, gravity: g } = *self;
        let (tanh, frequency) = (libm::tanh(k * h), self.frequency());
        let (cos, sin, cos2) = (libm::cos(phase), libm::sin(phase), libm::cos(2.0 * phase));
        let first = g * a * tanh / k * cos;
        let [big_a, big_b] = self.second();
        let pushed =
            -2.0 * frequency * cos2 * (big_a * libm::tanh(2.0 * k * h) / (2.0 * k) + big_b * h);
        let sinh = libm::sinh(k * h);
        let squared = (libm::sinh(2.0 * k * h) / (4.0 * k) - 0.5 * h) / (sinh * sinh);
        let fast = -0.5 * (a * frequency * sin).powi(2) * squared;
        let above = 0.5 * g * (a * cos).powi(2);
        let force = first + pushed + fast + above + self.constant() * h;
        1.0 + force / (0.5 * g * h * h)
    }

    /// The largest and the smallest F* of a period.
    pub fn extremes(&self) -> [f64; 2] {
        let all =
            (0..PHASES).map(|n| self.at(std::f64::consts::TAU * f64::from(n) / f64::from(PHASES)));
        all.fold([f64::NEG_INFINITY, f64::INFINITY], |[high, low], force| {
            [high.max(force), low.min(force)]
        })
    }

    /// σ, 1/s.
    fn frequency(&self) -> f64 {
        let Self { depth, wavenumber, gravity, .. } = *self;
        StandingWave { depth, wavenumber, gravity }.frequency()
    }

    /// A and B, m²/s.
    fn second(&self) -> [f64; 2] {
        let tanh = libm::tanh(self.wavenumber * self.depth);
        let unit = self.amplitude * self.amplitude * self.frequency();
        let square = tanh * tanh;
        [
            -3.0 / 16.0 * unit * (1.0 - square * square) / (square * square),
            unit * (1.0 + 3.0 * square) / (16.0 * square),
        ]
    }

    /// K, m²/s².
    fn constant(&self) -> f64 {
        let square = libm::tanh(self.wavenumber * self.depth).powi(2);
        let frequency_2 = self.gravity * self.wavenumber * square.sqrt();
        self.amplitude * self.amplitude * frequency_2 * (1.0 - square) / (8.0 * square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl StandingWaveForce {
        /// φ at a place and a phase.
        fn potential(&self, [x, z]: [f64; 2], phase: f64) -> f64 {
            let Self { amplitude: a, depth: h, wavenumber: k, .. } = *self;
            let frequency = self.frequency();
            let [big_a, big_b] = self.second();
            let double = 2.0 * k * (z + h);
            -a * frequency / k * libm::cosh(k * (z + h)) / libm::sinh(k * h)
                * libm::cos(k * x)
                * libm::sin(phase)
                + (big_a * libm::cosh(double) / libm::cosh(2.0 * k * h) * libm::cos(2.0 * k * x)
                    + big_b)
                    * libm::sin(2.0 * phase)
        }

        /// ∂φ/∂x, ∂φ/∂z and ∂φ/∂t.
        fn slopes(&self, [x, z]: [f64; 2], phase: f64) -> [f64; 3] {
            let e = 1e-5;
            let frequency = self.frequency();
            let difference = |high: f64, low: f64| (high - low) / (2.0 * e);
            [
                difference(self.potential([x + e, z], phase), self.potential([x - e, z], phase)),
                difference(self.potential([x, z + e], phase), self.potential([x, z - e], phase)),
                frequency
                    * difference(
                        self.potential([x, z], phase + e),
                        self.potential([x, z], phase - e),
                    ),
            ]
        }

        fn pressure(&self, place: [f64; 2], phase: f64) -> f64 {
            let [u, w, rate] = self.slopes(place, phase);
            -self.gravity * place[1] - rate - 0.5 * (u * u + w * w) + self.constant()
        }

        /// Where the pressure is that of the air, metres over still water.
        fn surface(&self, x: f64, phase: f64) -> f64 {
            let mut z = 0.0;
            for _ in 0..40 {
                z += self.pressure([x, z], phase) / self.gravity;
            }
            z
        }
    }

    fn wave(amplitude: f64) -> StandingWaveForce {
        StandingWaveForce { amplitude, depth: 0.3, wavenumber: 4.0, gravity: 9.81 }
    }

    /// Water at the surface stays there, but for what is of third order.
    #[test]
    fn the_surface_moves_with_the_water_to_second_order() {
        let frequency = (9.81 * 4.0 * libm::tanh(1.2_f64)).sqrt();
        let worst = [0.01, 0.005].map(|amplitude| {
            let (wave, e) = (wave(amplitude), 1e-4);
            let mut worst = 0.0_f64;
            for [x, phase] in [[0.0, 0.3], [0.1, 1.0], [0.25, 2.2], [0.4, 4.0], [0.7, 5.5]] {
                let z = wave.surface(x, phase);
                let [u, w, _] = wave.slopes([x, z], phase);
                let rise = (wave.surface(x, phase + e) - wave.surface(x, phase - e)) / (2.0 * e);
                let slope = (wave.surface(x + e, phase) - wave.surface(x - e, phase)) / (2.0 * e);
                worst = worst.max((frequency * rise + u * slope - w).abs());
            }
            worst
        });
        println!("{worst:?}");
        assert!(worst[1] < 0.16 * worst[0], "an eighth: {worst:?}");
    }

    /// The pressure over the wall, added up, is the force to second order.
    #[test]
    fn the_force_is_the_pressure_on_the_wall() {
        for phase in [0.0, 0.7, 1.6, 3.1, 4.0] {
            let off = [0.01, 0.005].map(|amplitude| {
                let wave = wave(amplitude);
                let (top, cells) = (wave.surface(0.0, phase), 400);
                let step = (top + wave.depth) / f64::from(cells);
                let middle = |n: i32| [0.0, (f64::from(n) + 0.5) * step - wave.depth];
                let force: f64 = (0..cells).map(|n| wave.pressure(middle(n), phase) * step).sum();
                wave.at(phase) - force / (0.5 * wave.gravity * wave.depth * wave.depth)
            });
            assert!(off[1].abs() < 0.2 * off[0].abs() + 2e-6, "{phase}: {off:?}");
        }
        let [high, low] = wave(0.02).extremes();
        assert!(high > 1.0 && low < 1.0 && high + low > 2.0, "{high} {low}");
    }
}
