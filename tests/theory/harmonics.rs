//! What a train of waves is made of: the harmonics of its surface, and which of the second harmonic travels with
//! the waves (bound) and which by itself (free).

use std::f64::consts::TAU;

use num_complex::Complex64 as Complex;

use seawall::theory::wavemaker::travelling;

/// The surface at one place: its mean, metres, and the amplitudes of e^{-iωt} and e^{-2iωt}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonics {
    /// Metres.
    pub mean: f64,
    /// Complex amplitudes, metres.
    pub first_two: [Complex; 2],
}

impl Harmonics {
    /// Of a surface, metres, at times, seconds, that go over whole periods: by the trapezoidal rule.
    pub fn of(series: &[(f64, f64)], period: f64) -> Harmonics {
        let with = |times: f64| -> Complex {
            let value = |&(time, level): &(f64, f64)| {
                let phase = times * TAU * time / period;
                level * Complex::new(libm::cos(phase), libm::sin(phase))
            };
            let stretch = |pair: &[(f64, f64)]| {
                0.5 * (pair[1].0 - pair[0].0) * (value(&pair[0]) + value(&pair[1]))
            };
            series.windows(2).map(stretch).sum()
        };
        let span = series[series.len() - 1].0 - series[0].0;
        let first_two = [1.0, 2.0].map(|times| 2.0 / span * with(times));
        Harmonics { mean: with(0.0).re / span, first_two }
    }
}

/// The bound and the free part of the second harmonic, metres. They fit best to what is read at several places,
/// metres. The bound wave has the wavenumber 2k. The free one has K, where (2ω)² = g K tanh Kh.
pub fn split(readings: &[(f64, Complex)], [bound, free]: [f64; 2]) -> [f64; 2] {
    let wave = |k: f64, x: f64| Complex::new(libm::cos(k * x), libm::sin(k * x));
    // Normal equations: [n, c; c*, n] [a; b] = [p; q].
    let count = readings.len() as f64;
    let sum = |of: &dyn Fn(f64, Complex) -> Complex| -> Complex {
        readings.iter().map(|&(x, value)| of(x, value)).sum()
    };
    let shared = sum(&|x, _| wave(free - bound, x));
    let [p, q] = [bound, free].map(|k| sum(&|x, value| wave(-k, x) * value));
    let size = count * count - shared.norm_sqr();
    [count * p - shared * q, count * q - shared.conj() * p]
        .map(|part| libm::hypot(part.re, part.im) / size)
}

/// The wavenumber of a free wave of this period, seconds, on a depth, metres, under gravity, m/s²; 1/m.
pub fn free_wavenumber(period: f64, depth: f64, gravity: f64) -> f64 {
    travelling((TAU / period).powi(2) * depth / gravity) / depth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bound_and_free_waves_are_told_apart() {
        let (period, k, own) = (0.8, 4.0, free_wavenumber(0.4, 0.2, 9.81));
        let (rate, own_rate) = (TAU / period, TAU / 0.4);
        assert!((own_rate * own_rate - 9.81 * own * libm::tanh(0.2 * own)).abs() < 1e-9);
        let places = (0..9).map(|n| 1.0 + 0.1 * f64::from(n));
        let readings: Vec<_> = places
            .map(|x| {
                let level = |time: f64| {
                    let phase = k * x - rate * time;
                    -0.3 + 5.0 * libm::cos(phase)
                        + libm::cos(2.0 * phase)
                        + 0.4 * libm::cos(own * x - own_rate * time + 1.1)
                        + 0.2 * libm::cos(3.0 * phase)
                };
                let series: Vec<_> = (0..=480)
                    .map(|n| 0.005 * f64::from(n))
                    .map(|time| (time, level(time)))
                    .collect();
                let found = Harmonics::of(&series, period);
                assert!((found.mean + 0.3).abs() < 1e-9);
                let first = found.first_two[0];
                assert!((libm::hypot(first.re, first.im) - 5.0).abs() < 1e-9);
                (x, found.first_two[1])
            })
            .collect();
        let [bound, free] = split(&readings, [2.0 * k, own]);
        assert!((bound - 1.0).abs() < 1e-9 && (free - 0.4).abs() < 1e-9, "{bound} {free}");
    }
}
