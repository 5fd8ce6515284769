//! A drop in a central field that oscillates between two ellipses: exact (Monaghan & Rafiee 2013;
//! Colagrossi et al. 2013).

use serde::{Deserialize, Serialize};

/// An ellipse with the semi-axes a along x and b = R²/a along y, in which u = A x, v = -A y.
///
/// With the pressure p/ρ = P (1 - x²/a² - y²/b²) the momentum equations under the acceleration
/// -Ω² r give P = (A² + Ω²)/(1/a² + 1/b²) and
/// ```text
/// dA/dt = (A² + Ω²)(b² - a²)/(b² + a²),  da/dt = A a
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EllipticDrop {
    /// R, metres, of the circle of the same area.
    pub radius: f64,
    /// Ω, 1/s.
    pub field_rate: f64,
    /// A, 1/s.
    pub stretching_rate: f64,
    /// a, metres.
    pub axis: f64,
}

impl EllipticDrop {
    /// A circle, stretching at this rate.
    pub fn circle(radius: f64, field_rate: f64, stretching_rate: f64) -> EllipticDrop {
        EllipticDrop { radius, field_rate, stretching_rate, axis: radius }
    }

    /// a and b, metres.
    pub fn axes(&self) -> [f64; 2] {
        [self.axis, self.radius * self.radius / self.axis]
    }

    /// u = A x, v = -A y, places from the centre.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.stretching_rate * x, -self.stretching_rate * y]
    }

    /// p/ρ, m²/s², places from the centre.
    pub fn pressure_over_density(&self, [x, y]: [f64; 2]) -> f64 {
        let [a2, b2] = self.axes().map(|axis| axis * axis);
        let (stretching, field) = (self.stretching_rate, self.field_rate);
        let peak = (stretching * stretching + field * field) / (1.0 / a2 + 1.0 / b2);
        peak * (1.0 - x * x / a2 - y * y / b2)
    }

    fn rates(&self) -> [f64; 2] {
        let [a2, b2] = self.axes().map(|axis| axis * axis);
        let (stretching, field) = (self.stretching_rate, self.field_rate);
        let swing = (stretching * stretching + field * field) * (b2 - a2) / (b2 + a2);
        [swing, stretching * self.axis]
    }

    /// The drop after `time` seconds (fourth-order Runge-Kutta, steps of at most 0.001/Ω).
    pub fn after(mut self, time: f64) -> EllipticDrop {
        let steps = (time * self.field_rate / 1e-3).ceil().max(1.0);
        let step = time / steps;
        let moved = |from: &EllipticDrop, [swing, growth]: [f64; 2], by: f64| EllipticDrop {
            stretching_rate: from.stretching_rate + by * swing,
            axis: from.axis + by * growth,
            ..*from
        };
        for _ in 0..steps as u64 {
            let first = self.rates();
            let second = moved(&self, first, 0.5 * step).rates();
            let third = moved(&self, second, 0.5 * step).rates();
            let fourth = moved(&self, third, step).rates();
            let mean = [0, 1].map(|part| {
                (first[part] + 2.0 * second[part] + 2.0 * third[part] + fourth[part]) / 6.0
            });
            self = moved(&self, mean, step);
        }
        self
    }

    /// Time from circle to circle and back, with both stretches, seconds. A passes through zero at
    /// the longest ellipse, half-way to the circle that stretches the other way.
    pub fn period(&self) -> f64 {
        let mut start = EllipticDrop::circle(
            self.radius,
            self.field_rate,
            self.stretching_rate.abs().max(f64::MIN_POSITIVE),
        );
        let (mut time, step) = (0.0, 0.01 / self.field_rate);
        loop {
            let next = start.after(step);
            if next.stretching_rate <= 0.0 {
                let share = start.stretching_rate / (start.stretching_rate - next.stretching_rate);
                return 4.0 * (time + share * step);
            }
            (time, start) = (time + step, next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn energy(drop: &EllipticDrop) -> f64 {
        let [a, b] = drop.axes();
        let rates = drop.stretching_rate.powi(2) + drop.field_rate.powi(2);
        rates * (a * a + b * b)
    }

    #[test]
    fn energy_is_kept_and_the_circle_comes_back() {
        let circle = EllipticDrop::circle(0.5, 2.0, 0.8);
        let period = circle.period();
        for share in [0.2, 0.5, 0.77, 1.0] {
            let later = circle.after(share * period);
            assert!((energy(&later) / energy(&circle) - 1.0).abs() < 1e-9);
        }
        let back = circle.after(period);
        assert!((back.axis - 0.5).abs() < 1e-5 && (back.stretching_rate - 0.8).abs() < 1e-4);
        let half = circle.after(0.5 * period);
        assert!((half.stretching_rate + 0.8).abs() < 1e-4);
    }

    /// Small oscillations: da/dt = A a and dA/dt = -2 Ω² (a - R)/R, so ω = √2 Ω.
    #[test]
    fn small_swings_have_the_linear_period() {
        let period = EllipticDrop::circle(1.0, 3.0, 1e-3).period();
        let linear = std::f64::consts::TAU / (2.0_f64.sqrt() * 3.0);
        assert!((period / linear - 1.0).abs() < 1e-5, "{period} {linear}");
    }
}
