//! Regular waves of a piston, to second order and at any depth (Schäffer 1996, Second-order
//! wavemaker theory for irregular waves, *Ocean Eng.* 23, 47-88; here with one frequency).
//!
//! The piston moves as ξ = Re(a exp(-iωt)). To first order this gives a progressive wave, and
//! evanescent modes that decay away from the piston. The potential is their sum:
//! ```text
//! φ = Re(Σ c_j f(k_j, z) exp(i k_j x - iωt)),   f(k, z) = cosh k(z + h)/cosh kh,   ω² = g k_j tanh k_j h
//! ```
//! k_0 is real, the others are imaginary. Through the surface, products of two modes drive a bound
//! potential at 2ω. The piston does not fit this potential, nor does its displacement fit the slope
//! of φ. The difference at its face leaves as modes of 2ω = √(g K tanh Kh). One is a free wave,
//! which is slower and spoils the shape of the others. A second stroke at 2ω cancels it.

use std::f64::consts::{FRAC_PI_2, PI};

use num_complex::Complex64 as Complex;

use crate::math::root::bisected;

/// Number of evanescent modes. The error falls as the inverse of this number, so a sum over half of
/// them gives the rest.
const MODES: u32 = 40;

/// Amplitudes at twice the frequency, metres, [of cos 2ωt, of sin 2ωt]. At t = 0 the first stroke,
/// S/2 sin ωt, passes its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondOrder {
    /// The stroke for which there is no free wave.
    pub stroke: [f64; 2],
    /// The surface at the piston's face with that stroke.
    pub surface: [f64; 2],
}

/// A piston in water of a depth, metres, under gravity, m/s².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piston {
    /// Half of the first stroke, metres.
    pub amplitude: f64,
    /// ω, 1/s.
    pub frequency: f64,
    /// h, metres.
    pub depth: f64,
    /// g, m/s².
    pub gravity: f64,
}

impl Piston {
    /// Its second order, with all modes.
    pub fn second_order(&self) -> SecondOrder {
        let [half, whole] = [MODES / 2, MODES].map(|modes| Answer::of(self, modes));
        let rest = |of: fn(&Answer) -> Complex| {
            let sum = 2.0 * of(&whole) - of(&half);
            // a is real for a clock that starts at ωt = π/2, so cos 2ωt and sin 2ωt change their
            // sign.
            [-sum.re, -sum.im]
        };
        SecondOrder { stroke: rest(|answer| answer.stroke), surface: rest(|answer| answer.surface) }
    }
}

/// k h of the progressive wave, ω² h/g = kh tanh kh, by Newton's method.
pub fn travelling(deep: f64) -> f64 {
    let mut kh = deep.max(deep.sqrt());
    for _ in 0..50 {
        let tanh = libm::tanh(kh);
        let step = (kh * tanh - deep) / (tanh + kh * (1.0 - tanh * tanh));
        kh -= step;
        if step.abs() < 1e-15 * kh {
            break;
        }
    }
    kh
}

/// Damping of a piston's motion by the progressive wave: force over speed, over ρ h √(g h), at ω²
/// h/g = `deep`.
///
/// Its power is that of a wave with the amplitude 2a tanh kh/(1 + q). Here a is the piston's
/// amplitude and q = 2kh/sinh 2kh (Biésel 1951; Dean & Dalrymple 1991, Water Wave Mechanics, ch.
/// 6). It is one for slow pistons and falls to zero for fast ones.
pub fn damping(deep: f64) -> f64 {
    let kh = travelling(deep);
    let ratio = libm::tanh(kh) / kh;
    2.0 * ratio * ratio.sqrt() / (1.0 + 2.0 * kh / libm::sinh(2.0 * kh))
}

/// κ h of an evanescent mode, counted from 1: ω² h/g = -κh tan κh.
pub fn fading(deep: f64, number: u32) -> f64 {
    // The root lies between (n - ½)π and nπ, where κ tan κ rises from -∞ to 0.
    let end = f64::from(number) * PI;
    let [low, _] = bisected([end - FRAC_PI_2, end], |kh| kh * libm::tan(kh) >= -deep);
    low
}

/// k of the progressive wave, and i κ of this many evanescent modes, 1/m.
fn modes(frequency: f64, depth: f64, gravity: f64, count: u32) -> Vec<Complex> {
    let deep = frequency * frequency * depth / gravity;
    let wave = Complex::new(travelling(deep) / depth, 0.0);
    let fading = (1..=count).map(|number| Complex::new(0.0, fading(deep, number) / depth));
    std::iter::once(wave).chain(fading).collect()
}

/// s tanh sh, without overflow.
fn steepness(s: Complex, depth: f64) -> Complex {
    let (twice, sign) = (2.0 * s * depth, if s.re < 0.0 { -1.0 } else { 1.0 });
    let small = libm::exp(-(twice.re * sign));
    let (sin, cos) = (libm::sin(twice.im), libm::cos(twice.im));
    // tanh(x + iy) = (sinh 2x + i sin 2y)/(cosh 2x + cos 2y)
    let (sinh, cosh) = (0.5 * sign * (1.0 - small * small), 0.5 * (1.0 + small * small));
    s * Complex::new(sinh, small * sin) / (cosh + small * cos)
}

/// The series up to some mode, for a clock for which a is real.
struct Answer {
    /// The second stroke, metres.
    stroke: Complex,
    /// The surface at the face, metres.
    surface: Complex,
}

impl Answer {
    fn of(piston: &Piston, count: u32) -> Answer {
        let Piston { amplitude: a, frequency: w, depth: h, gravity: g } = *piston;
        let (i, deep) = (Complex::i(), w * w / g);
        let first = modes(w, h, g, count);
        let own = modes(2.0 * w, h, g, count);
        // ∂φ/∂x = dξ/dt at the face.
        let amplitude = |&k: &Complex| -w * a * mean(k, h) / (k * square(k, h));
        let c: Vec<Complex> = first.iter().map(amplitude).collect();
        // The difference at the face for each mode of 2ω: -ξ ∂²φ/∂x², less the slope of the bound
        // potential.
        let mut lacks = vec![Complex::ZERO; own.len()];
        let mut bound = Complex::ZERO;
        for (&k, &c_k) in first.iter().zip(&c) {
            for (lack, &own) in lacks.iter_mut().zip(&own) {
                *lack += 0.5 * a * c_k * k * k * (deep - 4.0 * deep) / (k * k - own * own);
            }
            for (&l, &c_l) in first.iter().zip(&c) {
                let s = k + l;
                let driven =
                    i * w * c_k * c_l * (1.5 * deep * deep - k * l - 0.25 * (k * k + l * l)) / g;
                bound += driven / (steepness(s, h) - 4.0 * deep);
                for (lack, &own) in lacks.iter_mut().zip(&own) {
                    *lack -= i * s * driven / (s * s - own * own);
                }
            }
        }
        let stroke = lacks[0] / (2.0 * i * w * mean(own[0], h));
        let left = lacks.iter().zip(&own).map(|(lack, &own)| {
            (lack - 2.0 * i * w * stroke * mean(own, h)) / (i * own * square(own, h))
        });
        let potential = bound + left.sum::<Complex>();
        let near: Complex = c.iter().sum();
        let squares = 0.75 * deep * (a * a - deep / g * near * near);
        Answer { stroke, surface: 2.0 * i * w / g * potential + squares }
    }
}

/// ∫ f(k, z) dz over the depth.
fn mean(k: Complex, depth: f64) -> Complex {
    steepness(k, depth) / (k * k)
}

/// ∫ f(k, z)² dz over the depth.
fn square(k: Complex, depth: f64) -> Complex {
    let tanh = steepness(k, depth) / k;
    0.5 * (depth * (1.0 - tanh * tanh) + tanh / k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn piston(height: f64, depth: f64, period: f64) -> (Piston, f64) {
        let (frequency, gravity) = (TAU / period, 9.81);
        let k = modes(frequency, depth, gravity, 0)[0].re;
        let (sinh, cosh) = (libm::sinh(k * depth), libm::cosh(k * depth));
        let amplitude = 0.25 * height * (sinh * cosh + k * depth) / (sinh * sinh);
        (Piston { amplitude, frequency, depth, gravity }, k)
    }

    /// Madsen 1971, On the generation of long waves, *J. Geophys. Res.* 76: H²/(32 h) (3 cosh kh/sinh³ kh - 2/m).
    #[test]
    fn long_waves_need_the_stroke_of_madsen() {
        let ratio = |period: f64| {
            let (height, depth) = (0.004, 0.2);
            let (piston, k) = piston(height, depth, period);
            let (sinh, cosh) = (libm::sinh(k * depth), libm::cosh(k * depth));
            let madsen = height * height / (32.0 * depth)
                * (3.0 * cosh / (sinh * sinh * sinh) - 4.0 * piston.amplitude / height);
            let [even, odd] = piston.second_order().stroke;
            assert!(even.abs() < 0.2 * odd);
            println!("kh = {}: {odd} m, Madsen {madsen} m", k * depth);
            odd / madsen
        };
        let [short, long, longer] = [1.0, 2.5, 5.0].map(ratio);
        assert!((long - 1.0).abs() < 0.02 && (longer - 1.0).abs() < 0.003);
        assert!(short > 4.0, "at kh = 1 Madsen's second stroke is far too small: {short}");
    }

    /// The power is that of the wave: ½ b (a ω)² = ½ ρ g A² c_g with the first mode's A. In deep
    /// water the damping is 2 (g/ω²h)^1.5.
    #[test]
    fn damping_is_the_power_of_the_wave() {
        assert!((damping(1e-6) - 1.0).abs() < 1e-6);
        for deep in [100.0, 1e6] {
            assert!((damping(deep) * deep.powf(1.5) / 2.0 - 1.0).abs() < 1e-12, "{deep}");
        }
        for (depth, period) in [(0.2, 0.3), (0.2, 0.8), (1.0, 3.0)] {
            let (Piston { frequency: w, gravity: g, .. }, k) = piston(1.0, depth, period);
            let first = Complex::new(k, 0.0);
            let surface = (w / g * w * mean(first, depth) / (k * square(first, depth))).re;
            let kh = k * depth;
            let group = 0.5 * w / k * (1.0 + 2.0 * kh / libm::sinh(2.0 * kh));
            let power = g * group * (surface / w).powi(2) / (depth * (g * depth).sqrt());
            let told = damping(w * w * depth / g);
            assert!((told / power - 1.0).abs() < 1e-12, "{told} {power}");
        }
    }

    /// Both series are extrapolated to their end by the difference from half of their modes.
    #[test]
    fn more_modes_change_nothing() {
        let (piston, _) = piston(0.03, 0.2, 1.0);
        let [rough, fine] = [20, 40].map(|modes| Answer::of(&piston, modes));
        let finer = Answer::of(&piston, 120);
        for of in [|answer: &Answer| answer.stroke, |answer: &Answer| answer.surface] {
            let told = 2.0 * of(&fine) - of(&rough);
            println!("{} {} {}: {told}", of(&rough), of(&fine), of(&finer));
            assert!((told - of(&finer)).l1_norm() < 0.01 * of(&finer).l1_norm());
        }
    }
}
