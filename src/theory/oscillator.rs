//! The undamped spring-mass system under a constant force, exactly.

use crate::math::root::bisected;

/// Position and velocity of a mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OscillatorState {
    /// Displacement of the spring, metres.
    pub position: f64,
    /// Velocity, m/s.
    pub velocity: f64,
}

/// m x'' = F - k x with constant F, for mass m > 0 and stiffness k ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// m, kg per metre of width.
    pub mass: f64,
    /// k, N/m per metre of width.
    pub stiffness: f64,
    /// F, N per metre of width.
    pub force: f64,
}

impl Oscillator {
    /// The state after `time` seconds.
    pub fn advance(&self, from: OscillatorState, time: f64) -> OscillatorState {
        let omega2 = self.stiffness / self.mass;
        let phase = omega2.sqrt() * time;
        let acceleration = (self.force - self.stiffness * from.position) / self.mass;
        // sin φ/φ and (1 - cos φ)/φ², which stay exact for a soft spring and without a spring.
        let (sinc, versine) = if phase < 1e-4 {
            let p2 = phase * phase;
            (1.0 - p2 / 6.0, 0.5 - p2 / 24.0)
        } else {
            let half = libm::sin(0.5 * phase) / (0.5 * phase);
            (libm::sin(phase) / phase, 0.5 * half * half)
        };
        OscillatorState {
            position: from.position
                + from.velocity * time * sinc
                + acceleration * time * time * versine,
            velocity: from.velocity * libm::cos(phase) + acceleration * time * sinc,
        }
    }

    /// The first instant within (0, `within`] at which a mass is below the position 0. `place`
    /// gives its position. It starts at 0 or above, and oscillates no faster than this oscillator.
    pub fn first_return(&self, place: impl Fn(f64) -> f64, within: f64) -> Option<f64> {
        let below = |t: f64| place(t) < 0.0;
        let omega = (self.stiffness / self.mass).sqrt();
        // Sample at an eighth of a period or finer, then bisect the first sign change.
        let pieces = (within * omega * 8.0 / std::f64::consts::TAU).ceil().clamp(4.0, 4096.0);
        let mut start = 0.0;
        for k in 1..=pieces as usize {
            let end = within * k as f64 / pieces;
            if below(end) {
                let [_, first] = bisected([start, end], below);
                return Some(first);
            }
            start = end;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_satisfies_the_equation_for_stiff_soft_and_no_springs() {
        for (mass, stiffness) in [(50.0, 1e9), (250.0, 500.0), (1.0, 1e-12), (3.0, 0.0)] {
            let system = Oscillator { mass, stiffness, force: 70.0 };
            let from = OscillatorState { position: 0.01, velocity: -0.2 };
            let period = if stiffness > 1.0 { (mass / stiffness).sqrt() } else { 1.0 };
            for k in 0..20 {
                let (t, step) = (period * f64::from(k) * 0.37, period * 1e-4);
                let [a, b, c] = [t - step, t, t + step].map(|time| system.advance(from, time));
                let acceleration = (c.velocity - a.velocity) / (2.0 * step);
                let expected = (system.force - stiffness * b.position) / mass;
                let scale = 70.0 / mass + 0.2 / period + stiffness * 0.01 / mass;
                assert!((acceleration - expected).abs() < 1e-6 * scale, "m {mass} k {stiffness}");
                let velocity = (c.position - a.position) / (2.0 * step);
                assert!((velocity - b.velocity).abs() < 1e-6 * scale * period);
            }
        }
    }

    #[test]
    fn the_return_to_the_stop_is_found() {
        let system = Oscillator { mass: 2.0, stiffness: 8.0, force: 0.0 };
        let from = OscillatorState { position: 0.3, velocity: 0.0 };
        let of = |system: Oscillator, from: OscillatorState, within: f64| {
            system.first_return(|time| system.advance(from, time).position, within)
        };
        let back = of(system, from, 1.0).unwrap();
        assert!((back - std::f64::consts::FRAC_PI_4).abs() < 1e-12); // ω = 2: a quarter period
        assert_eq!(of(system, from, 0.7), None);
        let pushed = Oscillator { force: 10.0, ..system };
        assert_eq!(of(pushed, OscillatorState { position: 0.0, velocity: 0.0 }, 9.0), None);
    }
}
