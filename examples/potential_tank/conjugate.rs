//! The harmonic conjugate on the surface: Laplace's equation in a tank with still walls.
//!
//! ζ = cos(π Z), Z = (x - x_p + i y)/L, takes both walls and the bed onto the real axis. The surface
//! and its mirror image become one closed curve, and f = φ + iψ is analytic inside it, with
//! f(ζ̄) = f̄(ζ) because no water passes walls and bed. Cauchy's formula on the curve reads
//! ∮ (f' - f)/(ζ' - ζ) dζ' = 0; its real part is an equation of the second kind for ψ from φ
//! (Dold and Peregrine 1986), and the trapezoidal rule along the node index is accurate.

use std::f64::consts::PI;

use super::gmres::{self, NotConverged};

/// Residual of the equations, in the unit of ψ, over the size of φ.
const TOLERANCE: f64 = 1e-11;
const MOST_DIRECTIONS: usize = 60;

/// The curve and its equations at one instant.
pub struct Conjugate {
    count: usize,
    /// ζ and dζ/dj at the nodes.
    zeta: [Vec<f64>; 2],
    step: [Vec<f64>; 2],
    /// Weights of φ_j - φ_i, row by row.
    of_potential: Vec<f64>,
    /// Weights of ψ_j, row by row, over the diagonal's size.
    of_stream: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Conjugate {
    /// For nodes at Z = X + iY and their derivatives along the index.
    pub fn new(x: &[f64], y: &[f64], x_slope: &[f64], y_slope: &[f64]) -> Conjugate {
        let count = x.len();
        let mut zeta = [vec![0.0; count], vec![0.0; count]];
        let mut step = [vec![0.0; count], vec![0.0; count]];
        for j in 0..count {
            let ((sin, cos), up) = ((PI * x[j]).sin_cos(), (PI * y[j]).exp());
            let (cosh, sinh) = (0.5 * (up + 1.0 / up), 0.5 * (up - 1.0 / up));
            (zeta[0][j], zeta[1][j]) = (cos * cosh, -sin * sinh);
            let (re, im) = (-PI * sin * cosh, -PI * cos * sinh); // dζ/dZ
            step[0][j] = re * x_slope[j] - im * y_slope[j];
            step[1][j] = re * y_slope[j] + im * x_slope[j];
        }
        for j in [0, count - 1] {
            (zeta[1][j], step[0][j]) = (0.0, 0.0);
        }
        let mut of = Conjugate {
            count,
            zeta,
            step,
            of_potential: vec![0.0; count * count],
            of_stream: vec![0.0; count * count],
            diagonal: vec![1.0; count],
        };
        for i in 1..count - 1 {
            of.write_row(i);
        }
        of
    }

    /// Σ_j A (φ_j - φ_i) - B₁ (ψ_j - ψ_i) + B₂ (ψ_j + ψ_i) + dφ/dj = 0, where A + iB₁ stems from the
    /// nodes and A + iB₂ from their mirror images.
    fn write_row(&mut self, i: usize) {
        let ([re, im], [step_re, step_im]) = (&self.zeta, &self.step);
        let (zr, zi) = (re[i], im[i]);
        let row = i * self.count..(i + 1) * self.count;
        let potential = &mut self.of_potential[row.clone()];
        let stream = &mut self.of_stream[row];
        let mut turn = 0.0;
        let nodes = re.iter().zip(im).zip(step_re.iter().zip(step_im));
        for ((potential, stream), ((&re, &im), (&sr, &si))) in
            potential.iter_mut().zip(stream.iter_mut()).zip(nodes)
        {
            let (x, y, below) = (re - zr, im - zi, -im - zi);
            // The least number makes the node's own direct share zero.
            let direct = 1.0 / (x * x + y * y + f64::MIN_POSITIVE);
            let mirror = 1.0 / (x * x + below * below);
            let (a1, b1) = ((sr * x + si * y) * direct, (si * x - sr * y) * direct);
            let (a2, b2) = ((si * below - sr * x) * mirror, (si * x + sr * below) * mirror);
            *potential = a1 + a2;
            *stream = b1 - b2;
            turn += b1 + b2;
        }
        for j in [0, self.count - 1] {
            // A contact point is its own mirror image.
            let x = re[j] - zr;
            potential[j] *= 0.5;
            turn -= step_im[j] * x / (x * x + zi * zi);
        }
        stream.iter_mut().for_each(|weight| *weight /= turn);
        self.diagonal[i] = turn;
    }

    /// ψ from φ and dφ/dj; `stream` holds a guess at first.
    ///
    /// # Errors
    /// Where the iteration fails: the surface has become too sharp for its nodes.
    pub fn solve(
        &self,
        potential: &[f64],
        slope: &[f64],
        stream: &mut [f64],
    ) -> Result<(), NotConverged> {
        let (count, last) = (self.count, self.count - 1);
        let mut right = vec![0.0; count];
        for i in 1..last {
            let row = &self.of_potential[i * count..(i + 1) * count];
            let own = potential[i];
            let pairs = row.iter().zip(potential);
            let sum = pairs.fold([0.0; 2], |sum, (a, p)| [sum[0] + a * (p - own), 0.0])[0];
            right[i] = (sum + slope[i]) / self.diagonal[i];
        }
        (stream[0], stream[last]) = (0.0, 0.0);
        let scale = right.iter().fold(1e-9_f64, |most, r| most.max(r.abs()));
        let apply = |x: &[f64], out: &mut [f64]| {
            out[0] = 0.0;
            out[last] = 0.0;
            for i in 1..last {
                out[i] = product(&self.of_stream[i * count..(i + 1) * count], x) - x[i];
            }
        };
        gmres::solve(apply, &right, stream, TOLERANCE * scale, MOST_DIRECTIONS)
    }

    /// A function analytic in the water, at the point `place` on the real ζ axis, from its values at
    /// the nodes: Cauchy's formula over that for 1, which stays accurate next to the surface.
    pub fn at_axis<const N: usize>(&self, place: f64, values: [(&[f64], &[f64]); N]) -> [f64; N] {
        let mut sums = [0.0; N];
        let mut unity = 0.0;
        for j in 0..self.count {
            let (x, y) = (self.zeta[0][j] - place, self.zeta[1][j]);
            let weight = if j == 0 || j == self.count - 1 { 0.5 } else { 1.0 };
            let over = weight / (x * x + y * y);
            let (sr, si) = (self.step[0][j], self.step[1][j]);
            let (re, im) = ((sr * x + si * y) * over, (si * x - sr * y) * over);
            unity += im;
            for (sum, (real, imaginary)) in sums.iter_mut().zip(values) {
                *sum += im * real[j] + re * imaginary[j];
            }
        }
        sums.map(|sum| sum / unity)
    }

    /// df/dζ at the nodes, from df/dj.
    pub fn rate(&self, potential: &[f64], stream: &[f64]) -> [Vec<f64>; 2] {
        let mut rate = [vec![0.0; self.count], vec![0.0; self.count]];
        for j in 0..self.count {
            let (sr, si) = (self.step[0][j], self.step[1][j]);
            let over = 1.0 / (sr * sr + si * si);
            rate[0][j] = (potential[j] * sr + stream[j] * si) * over;
            rate[1][j] = (stream[j] * sr - potential[j] * si) * over;
        }
        rate
    }
}

/// Σ a b, in eight sums at once.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (mut sums, split) = ([0.0; 8], a.len() / 8 * 8);
    for (a, b) in a.chunks_exact(8).zip(b.chunks_exact(8)) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a[split..].iter().zip(&b[split..]).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::super::grid::{Grading, Parity, slope};
    use super::*;

    /// f = cosh-like standing modes: φ + iψ = cos(nπ Z), analytic, with still walls and bed.
    #[test]
    fn the_conjugate_of_a_mode_is_found_under_a_wavy_surface() {
        let grading = Grading { paddle: 0.1, wall: 0.15, floor: 0.05 };
        let x = grading.places(129, 1.0);
        let y: Vec<f64> = x.iter().map(|x| 0.08 + 0.03 * (3.0 * PI * x).cos()).collect();
        let (x_slope, y_slope) = (slope(&x, Parity::Odd), slope(&y, Parity::Even));
        let conjugate = Conjugate::new(&x, &y, &x_slope, &y_slope);
        let mode = |x: f64, y: f64| {
            let n = 4.0 * PI;
            ((n * x).cos() * (n * y).cosh(), -(n * x).sin() * (n * y).sinh())
        };
        let exact: Vec<(f64, f64)> = x.iter().zip(&y).map(|(&x, &y)| mode(x, y)).collect();
        let potential: Vec<f64> = exact.iter().map(|f| f.0).collect();
        let mut stream = vec![0.0; x.len()];
        let along = slope(&potential, Parity::Even);
        conjugate.solve(&potential, &along, &mut stream).unwrap();
        for (j, (found, exact)) in stream.iter().zip(&exact).enumerate() {
            assert!((found - exact.1).abs() < 1e-7, "node {j}: {found} {}", exact.1);
        }
        for y in [0.0, 0.03, 0.05, 0.109] {
            let place = (PI * y).cosh();
            let [at] = conjugate.at_axis(place, [(&potential, &stream)]);
            assert!((at - mode(0.0, y).0).abs() < 1e-7, "height {y}: {at}");
        }
    }
}
