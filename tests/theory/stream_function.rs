//! Steady waves of any height by Fourier series (Rienecker & Fenton 1981, A Fourier approximation method
//! for steady water waves, *J. Fluid Mech.* 104, 119-137).
//!
//! The frame moves with the wave. y counts from the bed, x from the crest. Then
//! ```text
//! ψ = -U y + Σ B_j sinh(j k y)/cosh(j k h) cos(j k x),   u = ∂ψ/∂y,   v = -∂ψ/∂x
//! ψ(η) = -Q,   ½ (u² + v²) + g η = R        at the surface
//! ```
//! The equations hold at `TERMS + 1` points from crest to trough. The wave is given by its height and its
//! period. Its current is that of a closed flume: no water is carried along on the whole, so the speed is Q/h.

use std::f64::consts::PI;

/// Terms of the series.
const TERMS: usize = 16;
/// k, U, Q, R; the surface at the points; B.
const UNKNOWNS: usize = 2 * TERMS + 5;
const SURFACE: usize = 4;
const SERIES: usize = SURFACE + TERMS + 1;
/// The height is reached in so many steps: each starts from the last.
const STEPS: usize = 8;
/// Rounds of Newton's method in a step.
const ROUNDS: usize = 30;
/// Residuals below this end it, all lengths over h and speeds over √(gh).
const CLOSE: f64 = 1e-12;

type Unknowns = [f64; UNKNOWNS];

/// A wave in water of depth 1 under gravity 1.
#[derive(Debug, Clone, Copy)]
struct Given {
    height: f64,
    period: f64,
}

/// A steady wave.
#[derive(Debug, Clone, PartialEq)]
pub struct StreamFunctionWave {
    /// h, metres.
    depth: f64,
    /// g, m/s².
    gravity: f64,
    solution: Unknowns,
}

impl StreamFunctionWave {
    /// Of a height and on a depth, metres, with a period, seconds, under gravity, m/s². `None` where Newton's
    /// method finds no such wave: it would break.
    pub fn new(height: f64, depth: f64, period: f64, gravity: f64) -> Option<StreamFunctionWave> {
        let (height, period) = (height / depth, period * (gravity / depth).sqrt());
        let mut solution = linear(height / STEPS as f64, period);
        for step in 1..=STEPS {
            let given = Given { height: height * step as f64 / STEPS as f64, period };
            solution = given.solve(solution)?;
        }
        Some(StreamFunctionWave { depth, gravity, solution })
    }

    /// k, 1/m.
    pub fn wavenumber(&self) -> f64 {
        self.solution[0] / self.depth
    }

    /// The wave's speed in a flume that carries no water along, m/s.
    pub fn speed(&self) -> f64 {
        self.solution[2] * (self.gravity * self.depth).sqrt()
    }

    /// The highest and the lowest surface over still water, metres.
    pub fn crest_and_trough(&self) -> [f64; 2] {
        [SURFACE, SERIES - 1].map(|place| (self.solution[place] - 1.0) * self.depth)
    }

    /// Amplitude of a harmonic of the surface, from 1 on, metres: η = Σ a_n cos(n k x).
    pub fn harmonic(&self, number: usize) -> f64 {
        let term = |m: usize| {
            let share = if m == 0 || m == TERMS { 0.5 } else { 1.0 };
            let phase = number as f64 * PI * m as f64 / TERMS as f64;
            share * (self.solution[SURFACE + m] - 1.0) * libm::cos(phase)
        };
        (0..=TERMS).map(term).sum::<f64>() * 2.0 / TERMS as f64 * self.depth
    }
}

/// Airy's wave of this height and period, as a start.
fn linear(height: f64, period: f64) -> Unknowns {
    let frequency = 2.0 * PI / period;
    let deep = frequency * frequency;
    let mut k = deep.max(frequency);
    for _ in 0..50 {
        let tanh = libm::tanh(k);
        k -= (k * tanh - deep) / (tanh + k * (1.0 - tanh * tanh));
    }
    let speed = frequency / k;
    let mut start = [0.0; UNKNOWNS];
    (start[0], start[1], start[2], start[3]) = (k, speed, speed, 1.0 + 0.5 * speed * speed);
    for m in 0..=TERMS {
        start[SURFACE + m] = 1.0 + 0.5 * height * libm::cos(PI * m as f64 / TERMS as f64);
    }
    start[SERIES] = 0.5 * height * libm::cosh(k) / libm::sinh(k) * speed;
    start
}

impl Given {
    fn solve(self, mut z: Unknowns) -> Option<Unknowns> {
        for _ in 0..ROUNDS {
            let off = self.residuals(&z);
            let most = off.iter().map(|value| value.abs()).fold(0.0, f64::max);
            if most < CLOSE {
                return Some(z);
            }
            if !most.is_finite() {
                return None;
            }
            let step = eliminated(self.slopes(&z), off)?;
            for (value, step) in z.iter_mut().zip(step) {
                *value -= step;
            }
        }
        None
    }

    /// How far off the equations are.
    fn residuals(&self, z: &Unknowns) -> Unknowns {
        let (k, flow, head) = (z[0], z[2], z[3]);
        let mut off = [0.0; UNKNOWNS];
        for m in 0..=TERMS {
            let y = z[SURFACE + m];
            let [stream, along, up] = field(z, PI * m as f64 / TERMS as f64, y);
            off[2 * m] = stream + flow;
            off[2 * m + 1] = 0.5 * (along * along + up * up) + y - head;
        }
        let inner: f64 = z[SURFACE + 1..SERIES - 1].iter().sum();
        let ends = 0.5 * (z[SURFACE] + z[SERIES - 1]);
        let last = 2 * TERMS + 2;
        off[last] = (inner + ends) / TERMS as f64 - 1.0;
        off[last + 1] = z[SURFACE] - z[SERIES - 1] - self.height;
        off[last + 2] = k * flow * self.period - 2.0 * PI;
        off
    }

    /// Their derivatives, row by row, by central differences.
    fn slopes(&self, z: &Unknowns) -> Vec<Unknowns> {
        let mut rows = vec![[0.0; UNKNOWNS]; UNKNOWNS];
        for column in 0..UNKNOWNS {
            let change = 1e-6 * z[column].abs().max(1e-3);
            let [low, high] = [-change, change].map(|change| {
                let mut beside = *z;
                beside[column] += change;
                self.residuals(&beside)
            });
            for (row, (low, high)) in rows.iter_mut().zip(low.iter().zip(high)) {
                row[column] = (high - low) / (2.0 * change);
            }
        }
        rows
    }
}

/// ψ, u and v at a phase k x and a height.
fn field(z: &Unknowns, phase: f64, y: f64) -> [f64; 3] {
    let (k, mut sums) = (z[0], [-z[1] * y, -z[1], 0.0]);
    for j in 1..=TERMS {
        let (jk, b) = (j as f64 * k, z[SERIES + j - 1]);
        // sinh and cosh of j k y over cosh j k h, h = 1, without their overflow.
        let (rise, fall) = (libm::exp(jk * (y - 1.0)), libm::exp(-jk * (y + 1.0)));
        let under = 1.0 + libm::exp(-2.0 * jk);
        let (sinh, cosh) = ((rise - fall) / under, (rise + fall) / under);
        let (sin, cos) = (libm::sin(j as f64 * phase), libm::cos(j as f64 * phase));
        sums[0] += b * sinh * cos;
        sums[1] += b * jk * cosh * cos;
        sums[2] += b * jk * sinh * sin;
    }
    sums
}

/// The solution of a full linear system, by elimination with row pivots; `None` where it is singular.
fn eliminated(mut rows: Vec<Unknowns>, mut right: Unknowns) -> Option<Unknowns> {
    for column in 0..UNKNOWNS {
        let size = |row: usize| rows[row][column].abs();
        let pivot = (column..UNKNOWNS).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        if size(pivot) < 1e-14 {
            return None;
        }
        rows.swap(column, pivot);
        right.swap(column, pivot);
        let upper = rows[column];
        for row in column + 1..UNKNOWNS {
            let factor = rows[row][column] / upper[column];
            for (value, above) in rows[row][column..].iter_mut().zip(&upper[column..]) {
                *value -= factor * above;
            }
            right[row] -= factor * right[column];
        }
    }
    for row in (0..UNKNOWNS).rev() {
        let known: f64 = (row + 1..UNKNOWNS).map(|place| rows[row][place] * right[place]).sum();
        right[row] = (right[row] - known) / rows[row][row];
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// H, h, m, and T, s: from deep to shallow water, from low to steep.
    const WAVES: [[f64; 3]; 5] =
        [[0.02, 0.4, 1.5], [0.08, 0.4, 1.5], [0.05, 0.4, 0.8], [0.06, 0.2, 1.2], [0.03, 0.2, 2.0]];

    /// Between the points, too, no water goes through the surface, and its pressure is the air's.
    #[test]
    fn its_own_equations_hold_between_its_points() {
        for [height, depth, period] in WAVES {
            let wave = StreamFunctionWave::new(height, depth, period, 9.81).unwrap();
            let z = &wave.solution;
            for step in 0..40 {
                let phase = PI * (f64::from(step) + 0.5) / 40.0;
                let series = (1..TERMS).map(|n| wave.harmonic(n) * libm::cos(n as f64 * phase));
                let last = 0.5 * wave.harmonic(TERMS) * libm::cos(TERMS as f64 * phase);
                let y = 1.0 + (series.sum::<f64>() + last) / depth;
                let [stream, u, v] = field(z, phase, y);
                assert!((stream + z[2]).abs() < 1e-6, "{height} {stream} {}", z[2]);
                assert!((0.5 * (u * u + v * v) + y - z[3]).abs() < 1e-5, "{height}");
            }
            let [crest, trough] = wave.crest_and_trough();
            assert!((crest - trough - height).abs() < 1e-12);
            assert!((wave.wavenumber() * wave.speed() * period - 2.0 * PI).abs() < 1e-9);
            assert!(crest > -trough);
        }
    }

    /// Fenton 1985, A fifth-order Stokes theory for steady waves, *J. Waterway, Port, Coastal, Ocean Eng.* 111,
    /// 216-234: the surface to second order in closed form, and its error falls with the third power.
    #[test]
    fn low_waves_are_those_of_stokes() {
        let (depth, period): (f64, f64) = (0.4, 1.2);
        let errors = [0.01, 0.005].map(|height: f64| {
            let wave = StreamFunctionWave::new(height, depth, period, 9.81).unwrap();
            let k = wave.wavenumber();
            let coth = 1.0 / libm::tanh(k * depth);
            let second = k * height * height / 16.0 * (3.0 * coth.powi(3) - coth);
            assert!((wave.harmonic(1) - 0.5 * height).abs() < 0.01 * height);
            (wave.harmonic(2) / second - 1.0).abs()
        });
        assert!(errors[0] < 0.02 && errors[1] < 0.3 * errors[0], "{errors:?}");
    }

    #[test]
    fn the_surface_is_that_of_the_fifth_order_of_stokes() {
        let (height, depth, period) = (0.06, 0.4, 1.2);
        let wave = StreamFunctionWave::new(height, depth, period, 9.81).unwrap();
        let k = wave.wavenumber();
        // Fenton's coefficients in S = 1/cosh 2kh; ε = kH/2.
        let (s, e) = (1.0 / libm::cosh(2.0 * k * depth), 0.5 * k * height);
        let coth = 1.0 / libm::tanh(k * depth);
        let b22 = coth * (1.0 + 2.0 * s) / (2.0 * (1.0 - s));
        let b31 =
            -3.0 * (1.0 + 3.0 * s + 3.0 * s * s + 2.0 * s.powi(3)) / (8.0 * (1.0 - s).powi(3));
        let b42 = coth
            * (6.0 - 26.0 * s - 182.0 * s * s - 204.0 * s.powi(3) - 25.0 * s.powi(4)
                + 26.0 * s.powi(5))
            / (6.0 * (3.0 + 2.0 * s) * (1.0 - s).powi(4));
        let b44 = coth
            * (24.0
                + 92.0 * s
                + 122.0 * s * s
                + 66.0 * s.powi(3)
                + 67.0 * s.powi(4)
                + 34.0 * s.powi(5))
            / (24.0 * (3.0 + 2.0 * s) * (1.0 - s).powi(4));
        let b53 = 9.0
            * (132.0 + 17.0 * s
                - 2216.0 * s * s
                - 5897.0 * s.powi(3)
                - 6292.0 * s.powi(4)
                - 2687.0 * s.powi(5)
                + 194.0 * s.powi(6)
                + 467.0 * s.powi(7)
                + 82.0 * s.powi(8))
            / (128.0 * (3.0 + 2.0 * s) * (4.0 + s) * (1.0 - s).powi(6));
        let b55 = 5.0
            * (300.0
                + 1579.0 * s
                + 3176.0 * s * s
                + 2949.0 * s.powi(3)
                + 1188.0 * s.powi(4)
                + 675.0 * s.powi(5)
                + 1326.0 * s.powi(6)
                + 827.0 * s.powi(7)
                + 130.0 * s.powi(8))
            / (384.0 * (3.0 + 2.0 * s) * (4.0 + s) * (1.0 - s).powi(6));
        let amplitudes = [
            e + e.powi(3) * b31 - e.powi(5) * (b53 + b55),
            e * e * b22 + e.powi(4) * b42,
            -e.powi(3) * b31 + e.powi(5) * b53,
            e.powi(4) * b44,
            e.powi(5) * b55,
        ];
        for (n, stokes) in amplitudes.into_iter().enumerate() {
            let off = wave.harmonic(n + 1) - stokes / k;
            println!("harmonic {}: {} m, {} m", n + 1, wave.harmonic(n + 1), stokes / k);
            assert!(off.abs() < 2e-3 * height, "harmonic {}: off by {off} m", n + 1);
        }
        let crest: f64 = amplitudes.iter().sum::<f64>() / k;
        assert!((wave.crest_and_trough()[0] / crest - 1.0).abs() < 2e-3);
    }

    #[test]
    fn no_wave_is_higher_than_the_highest() {
        assert!(StreamFunctionWave::new(0.38, 0.4, 1.2, 9.81).is_none());
    }
}
