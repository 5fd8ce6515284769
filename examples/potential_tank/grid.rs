//! Differences along the surface's node index, and the nodes' grading.

/// Coefficients of the central first difference of tenth order.
const FIRST: [f64; 5] = [5.0 / 6.0, -5.0 / 21.0, 5.0 / 84.0, -5.0 / 504.0, 1.0 / 1260.0];
/// Binomial coefficients of the tenth difference, from its middle.
const TENTH: [f64; 6] = [252.0, -210.0, 120.0, -45.0, 10.0, -1.0];

/// How a quantity continues beyond a wall: as its mirror image, or as minus that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Parity {
    Even,
    /// Odd about its value at the wall.
    Odd,
}

/// The quantity's value at index `at`, which may lie beyond either end.
fn extended(values: &[f64], parity: Parity, at: isize) -> f64 {
    let last = values.len() as isize - 1;
    let (mirror, wall) = if at < 0 {
        (-at, 0)
    } else if at > last {
        (2 * last - at, last)
    } else {
        return values[at as usize];
    };
    match parity {
        Parity::Even => values[mirror as usize],
        Parity::Odd => 2.0 * values[wall as usize] - values[mirror as usize],
    }
}

/// Applies `inner` where the stencil of `reach` fits, and `extended` values elsewhere.
fn stencil(
    values: &[f64],
    parity: Parity,
    reach: usize,
    out: &mut [f64],
    sum: impl Fn(&dyn Fn(isize) -> f64) -> f64,
    inner: impl Fn(&[f64]) -> f64,
) {
    let count = values.len();
    for (j, out) in out.iter_mut().enumerate() {
        *out = if j >= reach && j + reach < count {
            inner(&values[j - reach..=j + reach])
        } else {
            sum(&|k| extended(values, parity, j as isize + k))
        };
    }
}

/// Derivative along the node index, of tenth order.
pub fn slope(values: &[f64], parity: Parity) -> Vec<f64> {
    let mut out = vec![0.0; values.len()];
    let sum = |at: &dyn Fn(isize) -> f64| -> f64 {
        FIRST.iter().zip(1..).map(|(c, k)| c * (at(k) - at(-k))).sum()
    };
    let inner = |w: &[f64]| -> f64 {
        FIRST.iter().enumerate().map(|(k, c)| c * (w[6 + k] - w[4 - k])).sum()
    };
    stencil(values, parity, 5, &mut out, sum, inner);
    out
}

/// Takes `strength` of what a tenth difference sees out of a quantity: a sawtooth loses that share,
/// a wave of twenty nodes 1e-8 of it.
pub fn smooth(values: &mut [f64], parity: Parity, strength: f64) {
    let mut change = vec![0.0; values.len()];
    let sum = |at: &dyn Fn(isize) -> f64| -> f64 {
        let pairs = TENTH[1..].iter().zip(1..).map(|(c, k)| c * (at(k) + at(-k)));
        TENTH[0] * at(0) + pairs.sum::<f64>()
    };
    let inner = |w: &[f64]| -> f64 {
        let pairs = TENTH[1..].iter().enumerate().map(|(k, c)| c * (w[6 + k] + w[4 - k]));
        TENTH[0] * w[5] + pairs.sum::<f64>()
    };
    stencil(values, parity, 5, &mut change, sum, inner);
    for (value, change) in values.iter_mut().zip(change) {
        *value -= strength * change / 1024.0;
    }
}

/// Relative spacing of the nodes: even across both walls, finer towards them, because the surface
/// meets an accelerating wall at a slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grading {
    /// Share of the nodes that the refinement at the paddle takes.
    pub paddle: f64,
    /// The same at the wall.
    pub wall: f64,
    /// Spacing at the contact points, as a length like the two above.
    pub floor: f64,
}

impl Grading {
    /// Spacing at `share` of the way along the nodes, 0 to 1, up to a factor.
    fn spacing(&self, share: f64) -> f64 {
        let (sin, cos) = (0.5 * std::f64::consts::PI * share).sin_cos();
        let rise = |s: f64, width: f64| {
            let (s, floor) = (2.0 / std::f64::consts::PI * s, self.floor);
            (s * s + floor * floor) / (s * s + width * width)
        };
        rise(sin, self.paddle) * rise(cos, self.wall)
    }

    /// Spacings at `count` nodes.
    pub fn spacings(&self, count: usize) -> Vec<f64> {
        (0..count).map(|j| self.spacing(j as f64 / (count - 1) as f64)).collect()
    }

    /// `count` places from 0 to `length`.
    pub fn places(&self, count: usize, length: f64) -> Vec<f64> {
        const PIECES: usize = 16;
        let step = 1.0 / ((count - 1) * PIECES) as f64;
        let mut places = vec![0.0];
        let mut sum = 0.0;
        for j in 0..(count - 1) {
            for piece in 0..PIECES {
                // Two-point Gauss quadrature.
                let middle = ((j * PIECES + piece) as f64 + 0.5) * step;
                let aside = 0.5 * step / 3.0_f64.sqrt();
                sum += 0.5 * step * (self.spacing(middle - aside) + self.spacing(middle + aside));
            }
            places.push(sum);
        }
        places.iter().map(|place| place / sum * length).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cosines_and_sines_are_differentiated() {
        let angle = |j: usize| 3.0 * PI * j as f64 / 60.0;
        let even: Vec<f64> = (0..=60).map(|j| angle(j).cos()).collect();
        let odd: Vec<f64> = (0..=60).map(|j| angle(j).sin()).collect();
        let (of_even, of_odd) = (slope(&even, Parity::Even), slope(&odd, Parity::Odd));
        for j in 0..=60 {
            assert!((of_even[j] + 3.0 * PI / 60.0 * odd[j]).abs() < 1e-9);
            assert!((of_odd[j] - 3.0 * PI / 60.0 * even[j]).abs() < 1e-9);
        }
    }

    #[test]
    fn a_line_is_odd_about_its_ends() {
        let line: Vec<f64> = (0..=20).map(|j| 3.0 + 0.5 * j as f64).collect();
        assert!(slope(&line, Parity::Odd).iter().all(|d| (d - 0.5).abs() < 1e-13));
    }

    #[test]
    fn smoothing_takes_a_sawtooth_and_leaves_a_wave() {
        let mut saw: Vec<f64> = (0..=30).map(|j| if j % 2 == 0 { 1.0 } else { -1.0 }).collect();
        smooth(&mut saw, Parity::Even, 1.0);
        assert!(saw.iter().all(|value| value.abs() < 1e-12));
        let wave: Vec<f64> = (0..=60).map(|j| (3.0 * PI * j as f64 / 60.0).cos()).collect();
        let mut smoothed = wave.clone();
        smooth(&mut smoothed, Parity::Even, 1.0);
        assert!(wave.iter().zip(&smoothed).all(|(a, b)| (a - b).abs() < 1e-10));
    }

    #[test]
    fn places_follow_the_spacings() {
        let grading = Grading { paddle: 0.1, wall: 0.2, floor: 0.03 };
        let places = grading.places(101, 2.5);
        let (slopes, spacings) = (slope(&places, Parity::Odd), grading.spacings(101));
        let ratio = slopes[50] / spacings[50];
        assert!((places[100] - 2.5).abs() < 1e-14);
        for (slope, spacing) in slopes.iter().zip(spacings) {
            assert!((slope - ratio * spacing).abs() < 1e-5 * ratio);
        }
    }
}
