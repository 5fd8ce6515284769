//! Preconditioned Krylov methods: conjugate gradients, and BiCGSTAB where A is not symmetric.

use super::{Csr, Preconditioner};
use crate::math::simd::SimdPath;

/// A square matrix of which only products are known.
pub trait Product {
    /// `y = A x`.
    fn multiply(&mut self, x: &[f64], y: &mut [f64]);
    /// `z` ≈ A⁻¹ `r`.
    fn precondition(&mut self, r: &[f64], z: &mut [f64]);
}

/// A stored matrix with its preconditioner.
#[derive(Debug)]
pub struct Stored<'a> {
    /// For its products.
    pub path: SimdPath,
    /// A.
    pub matrix: &'a Csr,
    /// Prepared for A.
    pub preconditioner: &'a mut Preconditioner,
}

impl Product for Stored<'_> {
    fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
        self.matrix.multiply(self.path, x, y);
    }

    fn precondition(&mut self, r: &[f64], z: &mut [f64]) {
        self.preconditioner.apply(self.matrix, r, z);
    }
}

/// When a solve ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopRule {
    /// Solved when |b - A x| has fallen to this share of the larger of |b| and `floor`.
    pub tolerance: f64,
    /// Replaces |b|, if b has terms that must not count.
    pub size: Option<f64>,
    /// A norm below which a right-hand side counts as zero.
    pub floor: f64,
    /// Fails after this many iterations.
    pub most_iterations: u32,
}

/// The result of a solve.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveReport {
    /// Iterations done.
    pub iterations: u32,
    /// b - A x| relative to the larger of |b| and the floor.
    pub residual: f64,
    /// Whether it fell to the tolerance.
    pub converged: bool,
}

/// A solver with its work space.
#[derive(Debug, Clone, Default)]
pub struct Krylov {
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    ready: Vec<f64>,
    /// Only for BiCGSTAB.
    shadow: Vec<f64>,
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
    /// Resizes the arrays and finds the residual of the guess `x`. Returns the scale of residuals.
    fn start(&mut self, a: &mut impl Product, b: &[f64], x: &[f64], rule: &StopRule) -> f64 {
        let Krylov { residual, direction, image, ready, shadow, other, second } = self;
        for field in [residual, direction, image, ready, shadow, other, second] {
            field.resize(b.len(), 0.0);
        }
        if x.iter().all(|&x| x == 0.0) {
            self.residual.copy_from_slice(b);
            self.image.fill(0.0);
        } else {
            a.multiply(x, &mut self.image);
            for ((r, b), image) in self.residual.iter_mut().zip(b).zip(&self.image) {
                *r = b - image;
            }
        }
        rule.size.unwrap_or_else(|| dot(b, b).sqrt()).max(rule.floor)
    }

    /// The report if the solve has ended.
    fn end(&self, scale: f64, iterations: u32, rule: &StopRule) -> Option<SolveReport> {
        let residual = dot(&self.residual, &self.residual).sqrt() / scale;
        let converged = residual <= rule.tolerance;
        let ends = converged || iterations >= rule.most_iterations || !residual.is_finite();
        ends.then_some(SolveReport { iterations, residual, converged })
    }

    /// Conjugate gradients from the guess `x`, for a symmetric positive definite matrix. The matrix
    /// may be singular if `b` has no part in its null space.
    pub fn conjugate_gradients(
        &mut self,
        a: &mut impl Product,
        (b, x): (&[f64], &mut [f64]),
        rule: &StopRule,
    ) -> SolveReport {
        let scale = self.start(a, b, x, rule);
        let mut iterations = 0;
        let mut product = 0.0;
        loop {
            if let Some(report) = self.end(scale, iterations, rule) {
                return report;
            }
            a.precondition(&self.residual, &mut self.ready);
            let next = dot(&self.residual, &self.ready);
            let kept = if iterations == 0 { 0.0 } else { next / product };
            product = next;
            for (d, z) in self.direction.iter_mut().zip(&self.ready) {
                *d = z + kept * *d;
            }
            a.multiply(&self.direction, &mut self.image);
            let step = product / dot(&self.direction, &self.image);
            add_scaled(x, step, &self.direction);
            add_scaled(&mut self.residual, -step, &self.image);
            iterations += 1;
        }
    }

    /// BiCGSTAB from the guess `x`, for any matrix; an iteration multiplies twice.
    pub fn bicgstab(
        &mut self,
        a: &mut impl Product,
        (b, x): (&[f64], &mut [f64]),
        rule: &StopRule,
    ) -> SolveReport {
        let scale = self.start(a, b, x, rule);
        self.shadow.copy_from_slice(&self.residual);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        let mut iterations = 0;
        loop {
            if let Some(report) = self.end(scale, iterations, rule) {
                return report;
            }
            let next = dot(&self.shadow, &self.residual);
            let beta = if iterations == 0 { 0.0 } else { (next / rho) * (alpha / omega) };
            rho = next;
            for ((d, r), v) in self.direction.iter_mut().zip(&self.residual).zip(&self.image) {
                *d = r + beta * (*d - omega * v);
            }
            a.precondition(&self.direction, &mut self.ready);
            a.multiply(&self.ready, &mut self.image);
            alpha = rho / dot(&self.shadow, &self.image);
            add_scaled(x, alpha, &self.ready);
            add_scaled(&mut self.residual, -alpha, &self.image);
            a.precondition(&self.residual, &mut self.other);
            a.multiply(&self.other, &mut self.second);
            let square = dot(&self.second, &self.second);
            omega = if square > 0.0 { dot(&self.second, &self.residual) / square } else { 0.0 };
            add_scaled(x, omega, &self.other);
            add_scaled(&mut self.residual, -omega, &self.second);
            iterations += 1;
        }
    }
}

#[cfg(test)]
mod tests;
