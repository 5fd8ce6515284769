//! Preconditioned Krylov methods: conjugate gradients, and BiCGSTAB where A is not symmetric.

use super::{Csr, Preconditioner};
use crate::math::simd::SimdPath;

/// A square matrix that is known by its products alone.
pub trait Product {
    /// `y = A x`.
    fn multiply(&mut self, path: SimdPath, x: &[f64], y: &mut [f64]);
    /// `z` ≈ A⁻¹ `r`.
    fn precondition(&mut self, path: SimdPath, r: &[f64], z: &mut [f64]);
}

/// A stored matrix with its preconditioner.
struct Stored<'a> {
    matrix: &'a Csr,
    preconditioner: &'a mut Preconditioner,
}

impl Product for Stored<'_> {
    fn multiply(&mut self, path: SimdPath, x: &[f64], y: &mut [f64]) {
        self.matrix.multiply(path, x, y);
    }

    fn precondition(&mut self, path: SimdPath, r: &[f64], z: &mut [f64]) {
        self.preconditioner.apply(path, self.matrix, r, z);
    }
}

/// When a solve ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopRule {
    /// Solved when |b - A x| has come down to this share of the larger of |b| and `floor`.
    pub tolerance: f64,
    /// |b|, where b holds terms that are not to count.
    pub size: Option<f64>,
    /// A norm below which a right-hand side counts as zero.
    pub floor: f64,
    /// Given up after this many iterations.
    pub most_iterations: u32,
}

/// How a solve went.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveReport {
    /// Iterations done.
    pub iterations: u32,
    /// |b - A x| over the larger of |b| and the floor.
    pub residual: f64,
    /// Whether it came down to the tolerance.
    pub converged: bool,
}

/// A solver with its work space.
#[derive(Debug, Clone, Default)]
pub struct Krylov {
    residual: Vec<f64>,
    shadow: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    ready: Vec<f64>,
    other: Vec<f64>,
    second: Vec<f64>,
}

/// Sum of products in eight running sums, always in the same order.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_chunks, a_rest) = a.as_chunks::<8>();
    let (b_chunks, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7])) + rest
}

fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

impl Krylov {
    fn start(
        &mut self,
        path: SimdPath,
        a: &mut impl Product,
        b: &[f64],
        x: &[f64],
        rule: &StopRule,
    ) -> f64 {
        for field in [
            &mut self.residual,
            &mut self.shadow,
            &mut self.direction,
            &mut self.image,
            &mut self.ready,
            &mut self.other,
        ] {
            field.resize(b.len(), 0.0);
        }
        if x.iter().all(|&x| x == 0.0) {
            self.residual.copy_from_slice(b);
            self.image.fill(0.0);
        } else {
            a.multiply(path, x, &mut self.image);
            for ((r, b), image) in self.residual.iter_mut().zip(b).zip(&self.image) {
                *r = b - image;
            }
        }
        rule.size.unwrap_or_else(|| dot(b, b).sqrt()).max(rule.floor)
    }

    /// What the last solve left of the right-hand side.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Conjugate gradients from the guess `x`, for a symmetric positive definite matrix.
    pub fn conjugate_gradients(
        &mut self,
        path: SimdPath,
        a: &Csr,
        m: &mut Preconditioner,
        (b, x): (&[f64], &mut [f64]),
        rule: &StopRule,
    ) -> SolveReport {
        self.conjugate(path, &mut Stored { matrix: a, preconditioner: m }, (b, x), rule)
    }

    /// The same for a matrix that is known by its products alone; it may be singular where `b` has
    /// no part in its null space.
    pub fn conjugate(
        &mut self,
        path: SimdPath,
        a: &mut impl Product,
        (b, x): (&[f64], &mut [f64]),
        rule: &StopRule,
    ) -> SolveReport {
        let scale = self.start(path, a, b, x, rule);
        let mut iterations = 0;
        let mut product = 0.0;
        loop {
            let residual = dot(&self.residual, &self.residual).sqrt() / scale;
            let converged = residual <= rule.tolerance;
            if converged || iterations >= rule.most_iterations || !residual.is_finite() {
                return SolveReport { iterations, residual, converged };
            }
            a.precondition(path, &self.residual, &mut self.ready);
            let next = dot(&self.residual, &self.ready);
            let kept = if iterations == 0 { 0.0 } else { next / product };
            product = next;
            for (d, z) in self.direction.iter_mut().zip(&self.ready) {
                *d = z + kept * *d;
            }
            a.multiply(path, &self.direction, &mut self.image);
            let step = product / dot(&self.direction, &self.image);
            add_scaled(x, step, &self.direction);
            add_scaled(&mut self.residual, -step, &self.image);
            iterations += 1;
        }
    }

    /// BiCGSTAB from the guess `x`, for any matrix; an iteration multiplies twice.
    pub fn bicgstab(
        &mut self,
        path: SimdPath,
        a: &Csr,
        m: &mut Preconditioner,
        (b, x): (&[f64], &mut [f64]),
        rule: &StopRule,
    ) -> SolveReport {
        let mut stored = Stored { matrix: a, preconditioner: &mut *m };
        let scale = self.start(path, &mut stored, b, x, rule);
        self.shadow.copy_from_slice(&self.residual);
        let mut second = std::mem::take(&mut self.second);
        second.resize(a.len(), 0.0);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        let mut iterations = 0;
        loop {
            let residual = dot(&self.residual, &self.residual).sqrt() / scale;
            let converged = residual <= rule.tolerance;
            if converged || iterations >= rule.most_iterations || !residual.is_finite() {
                self.second = second;
                return SolveReport { iterations, residual, converged };
            }
            let next = dot(&self.shadow, &self.residual);
            let beta = if iterations == 0 { 0.0 } else { (next / rho) * (alpha / omega) };
            rho = next;
            for ((d, r), v) in self.direction.iter_mut().zip(&self.residual).zip(&self.image) {
                *d = r + beta * (*d - omega * v);
            }
            m.apply(path, a, &self.direction, &mut self.ready);
            a.multiply(path, &self.ready, &mut self.image);
            alpha = rho / dot(&self.shadow, &self.image);
            add_scaled(x, alpha, &self.ready);
            add_scaled(&mut self.residual, -alpha, &self.image);
            m.apply(path, a, &self.residual, &mut self.other);
            a.multiply(path, &self.other, &mut second);
            let square = dot(&second, &second);
            omega = if square > 0.0 { dot(&second, &self.residual) / square } else { 0.0 };
            add_scaled(x, omega, &self.other);
            add_scaled(&mut self.residual, -omega, &second);
            iterations += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sparse::PreconditionerChoice;

    /// The five-point Laplacian on a square of `side` x `side` points, Dirichlet all around;
    /// `skew` makes it unsymmetric.
    fn lattice(side: usize, skew: f64) -> Csr {
        let mut a = Csr::default();
        a.clear();
        for row in 0..side * side {
            let (i, j) = (row % side, row / side);
            let mut push = |column: usize, value: f64| {
                a.columns.push(column as u32);
                a.values.push(value);
            };
            if i > 0 {
                push(row - 1, -1.0 - skew);
            }
            if i + 1 < side {
                push(row + 1, -1.0 + skew);
            }
            if j > 0 {
                push(row - side, -1.0);
            }
            if j + 1 < side {
                push(row + side, -1.0);
            }
            a.starts.push(a.columns.len() as u32);
            a.diagonal.push(4.0);
        }
        a
    }

    /// Gaussian elimination with row exchanges.
    fn dense_solve(a: &Csr, b: &[f64]) -> Vec<f64> {
        let n = a.len();
        let mut rows: Vec<Vec<f64>> = (0..n)
            .map(|row| {
                let mut dense = vec![0.0; n + 1];
                dense[row] = a.diagonal[row];
                let (columns, values) = a.row(row);
                for (&c, &v) in columns.iter().zip(values) {
                    dense[c as usize] += v;
                }
                dense[n] = b[row];
                dense
            })
            .collect();
        for k in 0..n {
            let pivot = (k..n).max_by(|&p, &q| rows[p][k].abs().total_cmp(&rows[q][k].abs()));
            rows.swap(k, pivot.unwrap());
            let top = rows[k].clone();
            for row in &mut rows[k + 1..] {
                let factor = row[k] / top[k];
                for (value, top) in row[k..].iter_mut().zip(&top[k..]) {
                    *value -= factor * top;
                }
            }
        }
        let mut x = vec![0.0; n];
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|c| rows[k][c] * x[c]).sum();
            x[k] = (rows[k][n] - known) / rows[k][k];
        }
        x
    }

    const RULE: StopRule =
        StopRule { size: None, tolerance: 1e-12, floor: 0.0, most_iterations: 500 };

    #[test]
    fn every_preconditioner_leads_to_the_dense_solution() {
        let b: Vec<f64> = (0..144).map(|k| (f64::from(k) * 0.7).sin()).collect();
        for (skew, symmetric) in [(0.0, true), (0.3, false)] {
            let a = lattice(12, skew);
            let exact = dense_solve(&a, &b);
            for choice in PreconditionerChoice::ALL {
                let mut m = Preconditioner::new(choice);
                m.prepare(&a);
                let mut x = vec![0.0; b.len()];
                let path = SimdPath::widest();
                let mut solver = Krylov::default();
                let report = if symmetric {
                    solver.conjugate_gradients(path, &a, &mut m, (&b, &mut x), &RULE)
                } else {
                    solver.bicgstab(path, &a, &mut m, (&b, &mut x), &RULE)
                };
                assert!(report.converged, "{choice:?}: {report:?}");
                let worst = x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                assert!(worst < 1e-9, "{choice:?}: {worst}");
            }
        }
    }

    #[test]
    fn better_preconditioners_take_fewer_iterations() {
        let a = lattice(60, 0.0);
        let b: Vec<f64> = (0..a.len()).map(|k| (k as f64 * 0.7).sin()).collect();
        let iterations = |choice| {
            let mut m = Preconditioner::new(choice);
            m.prepare(&a);
            let mut x = vec![0.0; b.len()];
            let rule = StopRule { tolerance: 1e-8, ..RULE };
            let path = SimdPath::widest();
            Krylov::default().conjugate_gradients(path, &a, &mut m, (&b, &mut x), &rule).iterations
        };
        let counts = PreconditionerChoice::ALL.map(iterations);
        assert!(counts[1] < counts[0] / 2 && counts[2] < counts[1], "{counts:?}");
    }

    #[test]
    fn a_solve_that_runs_out_of_iterations_says_so() {
        let a = lattice(30, 0.0);
        let b = vec![1.0; a.len()];
        let mut m = Preconditioner::new(PreconditionerChoice::Jacobi);
        m.prepare(&a);
        let mut x = vec![0.0; b.len()];
        let rule = StopRule { most_iterations: 3, ..RULE };
        let path = SimdPath::widest();
        let report = Krylov::default().conjugate_gradients(path, &a, &mut m, (&b, &mut x), &rule);
        assert!(!report.converged && report.iterations == 3 && report.residual > 1e-6);
    }
}
