//! The piston law that makes a solitary wave (Goring 1978; Liang et al. 2017, model set-up).

use std::cell::Cell;

use super::{BodyMotion, PaddleLaw};

/// Goring's law for a wave of height H on still water of depth h.
///
/// ξ(t) = S/2 (1 + tanh θ), θ = κ [c (t - T/2) - (ξ - S/2)], with κ = √(3H/4h³), c = √(g(h+H)), S =
/// √(16 H h/3), T = 2 (3.80 + H/h)/(κ c). Positions are relative to ξ(0). The law simply continues
/// after T. The motion is blended in over the first `ramp` seconds, so that the water gets no
/// sudden push.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GoringPaddle {
    wave_height_ratio: f64,
    wavenumber: f64,
    celerity: f64,
    stroke: f64,
    duration: f64,
    ramp: f64,
}

thread_local! {
    /// The last paddle on this thread for which the reach was found, and the result.
    static LAST: Cell<Option<(GoringPaddle, f64)>> = const { Cell::new(None) };
}

impl GoringPaddle {
    /// A piston for H/h > 0, depth in metres, gravity in m/s². The motion is blended in over
    /// `ramp_fraction` of T.
    pub fn new(wave_height_ratio: f64, depth: f64, gravity: f64, ramp_fraction: f64) -> Self {
        let height = wave_height_ratio * depth;
        let wavenumber = (0.75 * height / (depth * depth * depth)).sqrt();
        let celerity = (gravity * (depth + height)).sqrt();
        let duration = 2.0 * (3.80 + wave_height_ratio) / (wavenumber * celerity);
        GoringPaddle {
            wave_height_ratio,
            wavenumber,
            celerity,
            stroke: (16.0 * height * depth / 3.0).sqrt(),
            duration,
            ramp: ramp_fraction * duration,
        }
    }

    fn unramped(&self, time: f64) -> BodyMotion {
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
        BodyMotion {
            offset: 0.5 * self.stroke * (1.0 + tanh),
            velocity: c * epsilon * sech2 / slowing,
            acceleration: -2.0 * epsilon * self.wavenumber * c * c * sech2 * tanh
                / (slowing * slowing * slowing),
        }
    }
}

impl PaddleLaw for GoringPaddle {
    fn motion(&self, time: f64) -> BodyMotion {
        let plain = self.unramped(time);
        let start = self.unramped(0.0).offset;
        BodyMotion { offset: plain.offset - start, ..plain }.eased_in(time, self.ramp)
    }

    /// T/2.
    fn stroke_centre(&self) -> Option<f64> {
        Some(0.5 * self.duration)
    }

    /// T.
    fn still_from(&self) -> f64 {
        self.duration
    }

    fn goes_back(&self) -> f64 {
        0.0
    }

    /// Cached: a study asks each case for this several times, and most cases have the same wave.
    fn goes_forth(&self) -> f64 {
        LAST.with(|last| match last.get() {
            Some((paddle, forth)) if paddle == *self => forth,
            _ => {
                let forth = self.motion(self.duration).offset;
                last.set(Some((*self, forth)));
                forth
            }
        })
    }

    /// Goring's u = c η/(h + η).
    fn raises(&self, time: f64, depth: f64, _gravity: f64) -> f64 {
        let speed = self.motion(time).velocity;
        depth * speed / (self.celerity - speed)
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
            let paddle = GoringPaddle::new(ratio, depth, gravity, 0.0);
            let start = paddle.unramped(0.0).offset;
            for k in 0..=40 {
                let time = paddle.duration * f64::from(k) / 30.0;
                let motion = paddle.motion(time);
                let xi = motion.offset + start;
                let theta = paddle.wavenumber
                    * (paddle.celerity * (time - 0.5 * paddle.duration)
                        - (xi - 0.5 * paddle.stroke));
                let eta = ratio * depth / libm::cosh(theta).powi(2);
                assert!((paddle.raises(time, depth, gravity) - eta).abs() < 1e-12);
                let rate = paddle.celerity * eta / (depth + eta);
                assert!((motion.velocity - rate).abs() < 1e-12, "H/h = {ratio}, t = {time}");
            }
        }
    }

    #[test]
    fn velocity_and_acceleration_are_derivatives() {
        let paddle = GoringPaddle::new(0.5, 0.2, 9.81, 0.05);
        let step = 1e-5;
        for k in 1..60 {
            let time = 0.0301 * f64::from(k);
            let (before, at, after) =
                (paddle.motion(time - step), paddle.motion(time), paddle.motion(time + step));
            let velocity = (after.offset - before.offset) / (2.0 * step);
            let acceleration = (after.velocity - before.velocity) / (2.0 * step);
            assert!((velocity - at.velocity).abs() < 1e-6, "t = {time}");
            assert!((acceleration - at.acceleration).abs() < 1e-4, "t = {time}");
        }
    }

    #[test]
    fn the_ramp_starts_at_rest_and_keeps_the_stroke() {
        let paddle = GoringPaddle::new(0.5, 0.2, 9.81, 0.05);
        let start = paddle.motion(0.0);
        assert_eq!((start.offset, start.velocity, start.acceleration), (0.0, 0.0, 0.0));
        let end = paddle.motion(2.0 * paddle.duration).offset;
        let lead = paddle.unramped(0.0).offset;
        assert!((end + lead - paddle.stroke).abs() < 1e-9);
    }
}
