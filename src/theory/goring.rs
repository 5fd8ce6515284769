//! The piston law that makes a solitary wave (Goring 1978; Liang et al. 2017, model set-up).

/// Motion of a piston at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PistonMotion {
    /// Position relative to the start, metres.
    pub position: f64,
    /// Velocity, m/s.
    pub velocity: f64,
    /// Acceleration, m/s².
    pub acceleration: f64,
}

/// Goring's law for a wave of height H on still water of depth h.
///
/// ξ(t) = S/2 (1 + tanh θ), θ = κ [c (t - T/2) - (ξ - S/2)], with κ = √(3H/4h³), c = √(g(h+H)),
/// S = √(16 H h/3), T = 2 (3.80 + H/h)/(κ c). Positions are relative to ξ(0); the law simply
/// continues past T. Over the first `ramp` seconds the motion is blended in smoothly, so that the
/// water is not kicked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GoringPiston {
    wave_height_ratio: f64,
    wavenumber: f64,
    celerity: f64,
    stroke: f64,
    duration: f64,
    ramp: f64,
}

impl GoringPiston {
    /// A piston for H/h > 0, depth in metres, gravity in m/s²; `ramp_fraction` of T is blended.
    pub fn new(wave_height_ratio: f64, depth: f64, gravity: f64, ramp_fraction: f64) -> Self {
        let height = wave_height_ratio * depth;
        let wavenumber = (0.75 * height / (depth * depth * depth)).sqrt();
        let celerity = (gravity * (depth + height)).sqrt();
        let duration = 2.0 * (3.80 + wave_height_ratio) / (wavenumber * celerity);
        GoringPiston {
            wave_height_ratio,
            wavenumber,
            celerity,
            stroke: (16.0 * height * depth / 3.0).sqrt(),
            duration,
            ramp: ramp_fraction * duration,
        }
    }

    /// T/2: when the piston passes the middle of its stroke, seconds.
    pub fn stroke_centre(&self) -> f64 {
        0.5 * self.duration
    }

    /// T, seconds.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// S, metres.
    pub fn stroke(&self) -> f64 {
        self.stroke
    }

    /// Position, velocity and acceleration at a time since the start, seconds.
    pub fn motion(&self, time: f64) -> PistonMotion {
        let plain = self.unramped(time);
        let start = self.unramped(0.0).position;
        let travel = plain.position - start;
        if time >= self.ramp {
            return PistonMotion { position: travel, ..plain };
        }
        // Quintic blend s(τ) = 6τ⁵ - 15τ⁴ + 10τ³: no jump in position, velocity or acceleration.
        let tau = (time / self.ramp).max(0.0);
        let s = tau * tau * tau * (10.0 + tau * (6.0 * tau - 15.0));
        let s1 = 30.0 * tau * tau * (1.0 - tau) * (1.0 - tau) / self.ramp;
        let s2 = 60.0 * tau * (1.0 - tau) * (1.0 - 2.0 * tau) / (self.ramp * self.ramp);
        PistonMotion {
            position: travel * s,
            velocity: plain.velocity * s + travel * s1,
            acceleration: plain.acceleration * s + 2.0 * plain.velocity * s1 + travel * s2,
        }
    }

    fn unramped(&self, time: f64) -> PistonMotion {
        let advance = self.wavenumber * self.celerity * (time - 0.5 * self.duration);
        let epsilon = self.wave_height_ratio; // κ S/2 = H/h
        let mut theta = advance;
        for _ in 0..50 {
            let tanh = libm::tanh(theta);
            let sech2 = 1.0 - tanh * tanh;
            let step = (theta + epsilon * tanh - advance) / (1.0 + epsilon * sech2);
            theta -= step;
            if step.abs() < 1e-15 * (1.0 + theta.abs()) {
                break;
            }
        }
        let tanh = libm::tanh(theta);
        let sech2 = 1.0 - tanh * tanh;
        let slowing = 1.0 + epsilon * sech2;
        let c = self.celerity;
        PistonMotion {
            position: 0.5 * self.stroke * (1.0 + tanh),
            velocity: c * epsilon * sech2 / slowing,
            acceleration: -2.0 * epsilon * self.wavenumber * c * c * sech2 * tanh
                / (slowing * slowing * slowing),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_satisfies_its_differential_equation() {
        // Goring: dξ/dt = c η/(h + η) at the piston, η = H sech²(κ(c(t-T/2) - (ξ-S/2))).
        for ratio in [0.1, 0.3, 0.6, 0.75] {
            let (depth, gravity) = (0.2, 9.81);
            let piston = GoringPiston::new(ratio, depth, gravity, 0.0);
            let start = piston.unramped(0.0).position;
            for k in 0..=40 {
                let time = piston.duration() * f64::from(k) / 30.0;
                let motion = piston.motion(time);
                let xi = motion.position + start;
                let theta = piston.wavenumber
                    * (piston.celerity * (time - piston.stroke_centre())
                        - (xi - 0.5 * piston.stroke));
                let eta = ratio * depth / libm::cosh(theta).powi(2);
                let rate = piston.celerity * eta / (depth + eta);
                assert!((motion.velocity - rate).abs() < 1e-12, "H/h = {ratio}, t = {time}");
            }
        }
    }

    #[test]
    fn velocity_and_acceleration_are_derivatives() {
        let piston = GoringPiston::new(0.5, 0.2, 9.81, 0.05);
        let step = 1e-5;
        for k in 1..60 {
            let time = 0.0301 * f64::from(k);
            let (before, at, after) =
                (piston.motion(time - step), piston.motion(time), piston.motion(time + step));
            let velocity = (after.position - before.position) / (2.0 * step);
            let acceleration = (after.velocity - before.velocity) / (2.0 * step);
            assert!((velocity - at.velocity).abs() < 1e-6, "t = {time}");
            assert!((acceleration - at.acceleration).abs() < 1e-4, "t = {time}");
        }
    }

    #[test]
    fn the_ramp_starts_at_rest_and_keeps_the_stroke() {
        let piston = GoringPiston::new(0.5, 0.2, 9.81, 0.05);
        let start = piston.motion(0.0);
        assert_eq!((start.position, start.velocity, start.acceleration), (0.0, 0.0, 0.0));
        let end = piston.motion(2.0 * piston.duration()).position;
        let lead = piston.unramped(0.0).position;
        assert!((end + lead - piston.stroke()).abs() < 1e-9);
    }
}
