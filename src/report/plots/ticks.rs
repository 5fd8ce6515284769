//! Round places on an axis.

use crate::report::number::in_powers;

/// The fewest ticks of an axis.
pub const FEWEST: usize = 4;
/// The most numbers on an axis of many decades.
const DECADES: i32 = 6;

/// A place on an axis and what is written there.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Its value.
    pub at: f64,
    /// Its label.
    pub label: String,
}

/// About `wanted` ticks at multiples of 1, 2 or 5 times a power of ten, and never fewer than
/// [`FEWEST`].
pub fn linear(low: f64, high: f64, wanted: f64) -> Vec<Tick> {
    let mut wanted = wanted;
    loop {
        let (step, decimals) = round_step((high - low) / wanted);
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        if last - first + 1 >= FEWEST as i64 || wanted > 50.0 {
            let tick = |index: i64| {
                let at = index as f64 * step;
                Tick { at, label: format!("{at:.decimals$}").replace('-', "\u{2212}") }
            };
            return (first..=last).map(tick).collect();
        }
        wanted *= 1.3;
    }
}

/// The next step of 1, 2 or 5 times a power of ten above `rough`, and the decimals it needs.
fn round_step(rough: f64) -> (f64, usize) {
    let power = libm::log10(rough).floor() as i32;
    let unit = 10_f64.powi(power);
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * unit >= 0.999 * rough);
    let step = factor.unwrap_or(10.0) * unit;
    let power = if factor.unwrap_or(10.0) >= 10.0 { power + 1 } else { power };
    (step, usize::try_from(-power).unwrap_or(0))
}

/// Powers of ten, or their multiples if they are few; with small strokes between them.
pub fn logarithmic(low: f64, high: f64) -> (Vec<Tick>, Vec<f64>) {
    let (first, last) = (libm::log10(low).floor() as i32, libm::log10(high).ceil() as i32);
    let inside = |value: &f64| (low * 0.9999..=high * 1.0001).contains(value);
    let times = |factors: &[i32]| -> Vec<f64> {
        let all = (first..=last)
            .flat_map(|power| factors.iter().map(move |m| exact(*m, power)))
            .filter(inside);
        all.collect()
    };
    let decades = times(&[1]);
    let step = (decades.len() as i32 + DECADES - 1) / DECADES;
    if decades.len() >= FEWEST {
        let even = decades.iter().copied().filter(|at| power(*at) % step == 0);
        let mut labelled: Vec<_> = even.collect();
        if labelled.len() < FEWEST {
            labelled = decades.iter().copied().step_by(step.unsigned_abs() as usize).collect();
        }
        let minor = if step > 1 { decades } else { times(&[2, 3, 4, 5, 6, 7, 8, 9]) };
        return (labelled.into_iter().map(worded).collect(), minor);
    }
    let minor = times(&[2, 3, 4, 5, 6, 7, 8, 9]);
    for factors in [&[1, 3][..], &[1, 2, 5], &[1, 2, 3, 4, 5, 6, 7, 8, 9]] {
        let places = times(factors);
        if places.len() >= FEWEST {
            return (places.into_iter().map(worded).collect(), minor);
        }
    }
    (linear(low, high, 4.0), Vec::new())
}

fn power(value: f64) -> i32 {
    libm::log10(value).round() as i32
}

/// A multiple of a power of ten, read from text, so that it is the nearest number.
fn exact(factor: i32, power: i32) -> f64 {
    format!("{factor}e{power}").parse().unwrap_or(f64::NAN)
}

fn worded(at: f64) -> Tick {
    Tick { at, label: in_powers(at) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(labels(&linear(0.03, 0.97, 5.0)), ["0.2", "0.4", "0.6", "0.8"]);
        assert_eq!(labels(&linear(-4.6, 4.4, 6.0)), ["−4", "−2", "0", "2", "4"]);
        assert_eq!(labels(&linear(0.0, 40.0, 4.0)), ["0", "10", "20", "30", "40"]);
        assert_eq!(labels(&linear(0.0, 0.35, 4.0)), ["0.0", "0.1", "0.2", "0.3"]);
    }

    #[test]
    fn there_are_always_four() {
        for (low, high) in [(0.19, 0.31), (1.0, 1.01), (-3.0, 47.0), (0.0, 1e-4), (280.0, 2100.0)] {
            for wanted in [2.0, 4.0, 6.0] {
                assert!(linear(low, high, wanted).len() >= FEWEST, "{low} {high} {wanted}");
            }
            if low > 0.0 {
                assert!(logarithmic(low, high).0.len() >= FEWEST, "{low} {high}");
            }
        }
    }

    #[test]
    fn decades_are_written_as_a_person_writes_them() {
        let (ticks, minor) = logarithmic(0.006, 1.7e7);
        assert_eq!(labels(&ticks), ["0.01", "1", "100", "10⁴", "10⁶"]);
        assert_eq!(minor.len(), 10);
        assert_eq!(labels(&logarithmic(0.8, 2000.0).0), ["1", "10", "100", "1000"]);
        assert_eq!(labels(&logarithmic(40.0, 600.0).0), ["50", "100", "200", "500"]);
    }
}
