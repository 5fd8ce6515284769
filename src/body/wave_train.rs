//! A piston that makes a train of regular waves, to second order (Madsen 1971).

use super::{BodyMotion, PaddleLaw};
use crate::keys::section;

section! {
    /// The keys of a train of waves.
    pub struct WaveTrainKeys in "scene" {
        /// Period of regular waves; H L²/h³ stays below 8π²/3.
        wave_period_s: f64, unit("s").above_zero().only("paddle", &["wave-train"]);
    }
}

/// Modes of the water near the paddle that are summed: they fall off with their square.
const MODES: u32 = 20;

/// Periods after which a level that has sunk or risen counts as that of still water.
const FORGETS: f64 = 8.0;

/// ξ(t) = S/2 sin ωt + S₂ sin 2ωt: Biésel's stroke S = H/m, m = 2 (cosh 2kh - 1)/(sinh 2kh + 2kh),
/// and S₂ = H²/(32 h) (3 cosh kh/sinh³ kh - 2/m), which keeps the free second harmonic away.
///
/// ω² = g k tanh kh. The motion is blended in over the first period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveTrain {
    frequency: f64,
    wavenumber: f64,
    /// Of the first and the second harmonic, metres.
    amplitudes: [f64; 2],
    /// Of the surface at the paddle: of the wave that leaves, its second harmonic, and of what stays near the
    /// paddle, metres.
    surface: [f64; 3],
}

impl WaveTrain {
    /// Waves of H/h on water of a depth, metres, under gravity, m/s², with a period, seconds.
    pub fn new(wave_height_ratio: f64, depth: f64, gravity: f64, period: f64) -> WaveTrain {
        let height = wave_height_ratio * depth;
        let frequency = std::f64::consts::TAU / period;
        let wavenumber = wavenumber(frequency, depth, gravity);
        let kh = wavenumber * depth;
        let (sinh, cosh) = (libm::sinh(kh), libm::cosh(kh));
        let ratio = 2.0 * (libm::cosh(2.0 * kh) - 1.0) / (libm::sinh(2.0 * kh) + 2.0 * kh);
        let second =
            height * height / (32.0 * depth) * (3.0 * cosh / (sinh * sinh * sinh) - 2.0 / ratio);
        let stroke = 0.5 * height / ratio;
        let coth = cosh / sinh;
        let bound = wavenumber * height * height / 16.0 * (3.0 * coth * coth * coth - coth);
        let near = stroke * near_field(frequency * frequency * depth / gravity);
        let surface = [0.5 * height, bound, near];
        WaveTrain { frequency, wavenumber, amplitudes: [stroke, second], surface }
    }

    /// Whether second order is enough: H L²/h³ < 8π²/3. Longer waves have a second crest in their
    /// trough that the sea has not.
    pub fn is_fit(&self, wave_height_ratio: f64, depth: f64) -> bool {
        1.5 * wave_height_ratio < (self.wavenumber * depth).powi(2)
    }
}

/// What a piston raises at its face and that does not travel, over its amplitude: Σ 4 sin² κ/(sin 2κ + 2κ) over
/// the roots of ω² h/g = -κ tan κ (Dean & Dalrymple 1991, chapter 6).
fn near_field(deep: f64) -> f64 {
    let mode = |number: u32| {
        // The root lies between (n - ½)π and nπ, where κ tan κ rises from -∞ to 0.
        let end = f64::from(number) * std::f64::consts::PI;
        let (mut low, mut high) = (end - 0.5 * std::f64::consts::PI, end);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if middle * libm::tan(middle) < -deep { low = middle } else { high = middle }
        }
        let sin = libm::sin(low);
        4.0 * sin * sin / (libm::sin(2.0 * low) + 2.0 * low)
    };
    (1..=MODES).map(mode).sum()
}

/// k of ω² = g k tanh kh, 1/m, by Newton's method.
fn wavenumber(frequency: f64, depth: f64, gravity: f64) -> f64 {
    let deep = frequency * frequency * depth / gravity;
    let mut kh = deep.max(deep.sqrt());
    for _ in 0..50 {
        let tanh = libm::tanh(kh);
        let step = (kh * tanh - deep) / (tanh + kh * (1.0 - tanh * tanh));
        kh -= step;
        if step.abs() < 1e-15 * kh {
            break;
        }
    }
    kh / depth
}

impl PaddleLaw for WaveTrain {
    fn motion(&self, time: f64) -> BodyMotion {
        let mut motion = BodyMotion::default();
        for (amplitude, times) in self.amplitudes.into_iter().zip([1.0, 2.0]) {
            let rate = times * self.frequency;
            let (sin, cos) = (libm::sin(rate * time), libm::cos(rate * time));
            motion.offset += amplitude * sin;
            motion.velocity += amplitude * rate * cos;
            motion.acceleration -= amplitude * rate * rate * sin;
        }
        motion.eased_in(time, std::f64::consts::TAU / self.frequency)
    }

    fn stroke_centre(&self) -> Option<f64> {
        None
    }

    fn period(&self) -> Option<f64> {
        Some(std::f64::consts::TAU / self.frequency)
    }

    fn still_from(&self) -> f64 {
        f64::INFINITY
    }

    /// A Stokes wave of second order and what stays near the paddle, eased in with the motion.
    fn raises(&self, time: f64, _depth: f64, _gravity: f64) -> f64 {
        let phase = self.frequency * time;
        let [wave, bound, near] = self.surface;
        let surface =
            wave * libm::cos(phase) + bound * libm::cos(2.0 * phase) + near * libm::sin(phase);
        let level = BodyMotion { offset: surface, ..BodyMotion::default() };
        level.eased_in(time, std::f64::consts::TAU / self.frequency).offset
    }

    fn forgets_after(&self) -> Option<f64> {
        Some(FORGETS * std::f64::consts::TAU / self.frequency)
    }

    /// As a piston that makes a wave of this height and period: ω S/H.
    fn gives_way(&self, excess: f64, _depth: f64, _gravity: f64) -> f64 {
        excess * self.frequency * self.amplitudes[0] / self.surface[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stroke_is_madsens() {
        // T = 1.5 s, H = 0.04 m, h = 0.4 m: L = 2.6113 m by the tables of linear theory.
        let wave = WaveTrain::new(0.1, 0.4, 9.81, 1.5);
        let k = wave.wavenumber;
        let omega = std::f64::consts::TAU / 1.5;
        assert!((omega * omega - 9.81 * k * libm::tanh(0.4 * k)).abs() < 1e-12);
        let kh = 0.4 * k;
        // Biésel's ratio in its other form, 2 sinh² kh/(sinh kh cosh kh + kh).
        let (sinh, cosh) = (libm::sinh(kh), libm::cosh(kh));
        let stroke = 0.04 * (sinh * cosh + kh) / (2.0 * sinh * sinh);
        let second = 0.04 * 0.04 / (32.0 * 0.4) * (3.0 * cosh / sinh.powi(3) - 2.0 * stroke / 0.04);
        for step in 0..50 {
            let time = 1.5 + 0.07 * f64::from(step);
            let exact =
                0.5 * stroke * libm::sin(omega * time) + second * libm::sin(2.0 * omega * time);
            assert!((wave.motion(time).offset - exact).abs() < 1e-15);
        }
        // Long waves: a piston of stroke H/(kh).
        let long = WaveTrain::new(0.01, 0.4, 9.81, 30.0);
        let stroke = 0.01 * 0.4 / (0.4 * long.wavenumber);
        assert!((2.0 * long.amplitudes[0] / stroke - 1.0).abs() < 1e-2);
    }

    #[test]
    fn it_starts_at_rest_and_its_rates_are_derivatives() {
        let (wave, step) = (WaveTrain::new(0.1, 0.4, 9.81, 1.5), 1e-5);
        assert_eq!(wave.motion(0.0), BodyMotion::default());
        for k in 1..80 {
            let time = 0.0301 * f64::from(k);
            let [before, at, after] = [-step, 0.0, step].map(|off| wave.motion(time + off));
            let velocity = (after.offset - before.offset) / (2.0 * step);
            let acceleration = (after.velocity - before.velocity) / (2.0 * step);
            assert!((velocity - at.velocity).abs() < 1e-7, "t = {time}");
            assert!((acceleration - at.acceleration).abs() < 1e-6, "t = {time}");
        }
    }
}
