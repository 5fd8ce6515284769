//! A piston that makes a train of regular waves, to second order (Schäffer 1996; Madsen 1971).

use serde::{Deserialize, Serialize};

use super::{BodyMotion, PaddleLaw};
use crate::keys::section;
use crate::theory::wavemaker::{Piston, fading, travelling};

/// How the second stroke of a train's paddle is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SecondStroke {
    /// With all modes of the water near the paddle (Schäffer 1996).
    Schaffer,
    /// As in long waves, without these modes (Madsen 1971).
    Madsen,
}

section! {
    /// The keys of a train of waves.
    pub struct WaveTrainKeys in "scene" {
        /// Period of regular waves; H L²/h³ stays below 8π²/3.
        wave_period_s: f64, unit("s").above_zero().only("paddle", &["wave-train"]);
        /// Whose theory gives the paddle's stroke at twice the frequency, which keeps a free second harmonic away:
        /// Schäffer's at any depth, Madsen's in long waves.
        second_stroke: SecondStroke = SecondStroke::Schaffer,
            plain().only("paddle", &["wave-train"]);
    }
}

/// Number of evanescent modes near the paddle that are summed: they decrease with the square of
/// their number.
const MODES: u32 = 20;

/// Periods after which a level that has fallen or risen counts as that of still water.
const FORGETS: f64 = 8.0;

/// ξ(t) = S/2 sin ωt + S₂ sin 2ωt + C₂ cos 2ωt. Biésel's stroke is S = H/m, m = 2 (cosh 2kh - 1)/(sinh 2kh + 2kh).
///
/// The other terms suppress the free second harmonic: those of [`Piston`], or Madsen's S₂ = H²/(32
/// h) (3 cosh kh/sinh³ kh - 2/m), C₂ = 0. ω² = g k tanh kh. The motion is blended in over the first
/// period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveTrain {
    frequency: f64,
    wavenumber: f64,
    /// Half the first stroke, S₂ and C₂, metres.
    stroke: [f64; 3],
    /// Amplitudes of the surface at the paddle, metres: of the wave that leaves, of cos 2ωt, of the
    /// evanescent modes, of sin 2ωt.
    surface: [f64; 4],
}

impl WaveTrain {
    /// Waves of H/h on water of a depth, metres, under gravity, m/s², with a period, seconds.
    pub fn new(
        wave_height_ratio: f64,
        (depth, gravity): (f64, f64),
        (period, second): (f64, SecondStroke),
    ) -> WaveTrain {
        let height = wave_height_ratio * depth;
        let frequency = std::f64::consts::TAU / period;
        let deep = frequency * frequency * depth / gravity;
        let wavenumber = travelling(deep) / depth;
        let kh = wavenumber * depth;
        let (sinh, cosh) = (libm::sinh(kh), libm::cosh(kh));
        let ratio = 2.0 * (libm::cosh(2.0 * kh) - 1.0) / (libm::sinh(2.0 * kh) + 2.0 * kh);
        let amplitude = 0.5 * height / ratio;
        let near = amplitude * near_field(deep);
        let ([even, odd], [bound, askew]) = match second {
            SecondStroke::Schaffer => {
                let piston = Piston { amplitude, frequency, depth, gravity }.second_order();
                (piston.stroke, piston.surface)
            }
            SecondStroke::Madsen => {
                let coth = cosh / sinh;
                let long = height * height / (32.0 * depth)
                    * (3.0 * cosh / (sinh * sinh * sinh) - 2.0 / ratio);
                let bound = wavenumber * height * height / 16.0 * (3.0 * coth * coth * coth - coth);
                ([0.0, long], [bound, 0.0])
            }
        };
        let surface = [0.5 * height, bound, near, askew];
        WaveTrain { frequency, wavenumber, stroke: [amplitude, odd, even], surface }
    }

    /// From crest to crest, metres.
    pub fn length(&self) -> f64 {
        std::f64::consts::TAU / self.wavenumber
    }

    /// Speed of their energy on water of this depth, metres: ω/k (1 + 2kh/sinh 2kh)/2, m/s.
    pub fn group_velocity(&self, depth: f64) -> f64 {
        let twice = 2.0 * self.wavenumber * depth;
        0.5 * self.frequency / self.wavenumber * (1.0 + twice / libm::sinh(twice))
    }

    /// Height over length of waves of H/h on water of this depth, metres, and the value at which
    /// they break: 0.142 tanh kh (Miche 1944).
    pub fn steepness(&self, wave_height_ratio: f64, depth: f64) -> [f64; 2] {
        [wave_height_ratio * depth / self.length(), 0.142 * libm::tanh(self.wavenumber * depth)]
    }

    /// Whether second order is enough: H L²/h³ < 8π²/3. Longer waves would have a second crest in
    /// their trough, which real ones do not have.
    pub fn is_fit(&self, wave_height_ratio: f64, depth: f64) -> bool {
        1.5 * wave_height_ratio < (self.wavenumber * depth).powi(2)
    }
}

/// The evanescent surface at a piston's face, over the piston's amplitude: Σ 4 sin² κ/(sin 2κ + 2κ)
/// over the roots of ω² h/g = -κ tan κ (Dean & Dalrymple 1991, chapter 6).
fn near_field(deep: f64) -> f64 {
    let mode = |number: u32| {
        let root = fading(deep, number);
        let sin = libm::sin(root);
        4.0 * sin * sin / (libm::sin(2.0 * root) + 2.0 * root)
    };
    (1..=MODES).map(mode).sum()
}

impl PaddleLaw for WaveTrain {
    fn motion(&self, time: f64) -> BodyMotion {
        let mut motion = BodyMotion::default();
        let [first, odd, even] = self.stroke;
        for (amplitude, times) in [first, odd].into_iter().zip([1.0, 2.0]) {
            let rate = times * self.frequency;
            let (sin, cos) = (libm::sin(rate * time), libm::cos(rate * time));
            motion.offset += amplitude * sin;
            motion.velocity += amplitude * rate * cos;
            motion.acceleration -= amplitude * rate * rate * sin;
        }
        let rate = 2.0 * self.frequency;
        let (sin, cos) = (libm::sin(rate * time), libm::cos(rate * time));
        motion.offset += even * cos;
        motion.velocity -= even * rate * sin;
        motion.acceleration -= even * rate * rate * cos;
        motion.eased_in(time, std::f64::consts::TAU / self.frequency)
    }

    fn stroke_centre(&self) -> Option<f64> {
        None
    }

    fn period(&self) -> Option<f64> {
        Some(std::f64::consts::TAU / self.frequency)
    }

    fn goes_back(&self) -> f64 {
        self.stroke.iter().map(|part| part.abs()).sum()
    }

    /// As far as back.
    fn goes_forth(&self) -> f64 {
        self.goes_back()
    }

    fn still_from(&self) -> f64 {
        f64::INFINITY
    }

    /// The first two orders of the surface, blended in with the motion.
    fn raises(&self, time: f64, _depth: f64, _gravity: f64) -> f64 {
        let phase = self.frequency * time;
        let [wave, bound, near, askew] = self.surface;
        let surface =
            wave * libm::cos(phase) + bound * libm::cos(2.0 * phase) + near * libm::sin(phase);
        let surface = surface + askew * libm::sin(2.0 * phase);
        let level = BodyMotion { offset: surface, ..BodyMotion::default() };
        level.eased_in(time, std::f64::consts::TAU / self.frequency).offset
    }

    fn forgets_after(&self) -> Option<f64> {
        Some(FORGETS * std::f64::consts::TAU / self.frequency)
    }

    /// ω S/H: as a piston that makes a wave of this height and period.
    fn gives_way(&self, excess: f64, _depth: f64, _gravity: f64) -> f64 {
        excess * self.frequency * self.stroke[0] / self.surface[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn train(period: f64, second: SecondStroke) -> WaveTrain {
        WaveTrain::new(0.1, (0.4, 9.81), (period, second))
    }

    #[test]
    fn the_stroke_is_madsens() {
        // T = 1.5 s, H = 0.04 m, h = 0.4 m: L = 2.6113 m by the tables of linear theory.
        let wave = train(1.5, SecondStroke::Madsen);
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
        let long = WaveTrain::new(0.01, (0.4, 9.81), (30.0, SecondStroke::Madsen));
        let stroke = 0.01 * 0.4 / (0.4 * long.wavenumber);
        assert!((2.0 * long.stroke[0] / stroke - 1.0).abs() < 1e-2);
    }

    #[test]
    fn it_starts_at_rest_and_its_rates_are_derivatives() {
        let (wave, step) = (train(1.5, SecondStroke::Schaffer), 1e-5);
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
