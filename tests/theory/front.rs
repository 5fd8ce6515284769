//! How a train begins, by linear theory: no wave of it is as high as the others while the front passes, and
//! the front spreads. So its first harmonic, read a fixed time after the group, changes on the way by itself.

use std::f64::consts::TAU;

use num_complex::Complex64 as Complex;
use seawall::theory::wavemaker::travelling;

/// After so many periods everything is taken to begin anew; the paddle stands from [`WORKS`] on.
const PERIODS: usize = 512;
const WORKS: usize = 400;
/// Samples of the paddle in a period.
const SAMPLES: usize = 32;
/// Waves of more than so many times the train's frequency are left out.
const HIGHEST: usize = 3;

/// A train of waves on its way into still water, from a paddle that moves to and fro and is eased in over the
/// first period. Heights are over the paddle's travel to one side.
pub struct Front {
    period: f64,
    /// Angular frequency, 1/s, wavenumber, 1/m, and complex amplitude of each part.
    parts: Vec<(f64, f64, Complex)>,
}

impl Front {
    /// Of this period, seconds, on a depth, metres, under gravity, m/s².
    pub fn new(period: f64, depth: f64, gravity: f64) -> Front {
        let times = (0..WORKS * SAMPLES).map(|sample| sample as f64 / SAMPLES as f64);
        let stroke: Vec<_> = times
            .map(|time| {
                let tau = time.min(1.0);
                (time, tau.powi(3) * (10.0 + tau * (6.0 * tau - 15.0)) * libm::sin(TAU * time))
            })
            .collect();
        let part = |number: usize| {
            let cycles = number as f64 / PERIODS as f64;
            let spectrum: Complex =
                stroke.iter().map(|&(time, offset)| offset * turned(TAU * cycles * time)).sum();
            let frequency = TAU * cycles / period;
            let kh = travelling(frequency * frequency * depth / gravity);
            // Height over travel of a piston: Dean & Dalrymple 1991, Eq. 6.25.
            let height = 2.0 * (libm::cosh(2.0 * kh) - 1.0) / (libm::sinh(2.0 * kh) + 2.0 * kh);
            let share = 2.0 * height / (PERIODS * SAMPLES) as f64;
            (frequency, kh / depth, spectrum * share)
        };
        Front { period, parts: (1..HIGHEST * PERIODS).map(part).collect() }
    }

    /// The size of the first harmonic at a place, metres, over so many whole periods from a time on, seconds.
    pub fn first_harmonic(&self, place: f64, from: f64, periods: u32) -> f64 {
        let (own, span) = (TAU / self.period, f64::from(periods) * self.period);
        // The mean of e^{iωt} over the span.
        let mean = |frequency: f64| {
            let half = 0.5 * frequency * span;
            let size = if half == 0.0 { 1.0 } else { libm::sin(half) / half };
            size * turned(frequency * from + half)
        };
        let sum: Complex = self
            .parts
            .iter()
            .map(|&(frequency, wavenumber, amplitude)| {
                let there = amplitude * turned(wavenumber * place);
                there * mean(own - frequency) + there.conj() * mean(own + frequency)
            })
            .sum();
        libm::hypot(sum.re, sum.im)
    }
}

fn turned(phase: f64) -> Complex {
    Complex::new(libm::cos(phase), libm::sin(phase))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long after the front the train is that of Biésel's theory, and the phase at the paddle does not matter.
    #[test]
    fn behind_the_front_the_train_is_even() {
        let front = Front::new(1.0, 0.2, 9.81);
        let kh: f64 = travelling(TAU * TAU * 0.2 / 9.81);
        let height = 2.0 * (libm::cosh(2.0 * kh) - 1.0) / (libm::sinh(2.0 * kh) + 2.0 * kh);
        for (place, from) in [(1.0, 60.0), (5.0, 80.0), (20.0, 150.0)] {
            let found = front.first_harmonic(place, from, 6);
            assert!((found / height - 1.0).abs() < 1e-3, "{found} for {height} at {place} m");
        }
        // Nothing is there before the fastest wave.
        assert!(front.first_harmonic(30.0, 1.0, 6) < 1e-3 * height);
        // Close behind the front it is not even.
        let near = front.first_harmonic(12.0, 12.0 / 0.93 - 3.0, 6) / height;
        assert!((near - 1.0).abs() > 0.05, "{near}");
    }
}
