//! The Laplacian that belongs to the scheme's own divergence and gradient.

use super::super::Isph;
use super::super::images::Points;
use super::super::lists::{Lists, Numbers};
use super::super::sums::{Divergence, Gradient};
use super::Exact;
use crate::math::simd::{SimdPath, dispatch};
use crate::math::sparse::{Csr, Preconditioner, Product};

/// -V D G p + C p + ε A p: minus the divergence of the gradient, both as in `project.rs`, never
/// stored: a product is one pass for the gradient and one for the divergence. It is symmetric and has
/// no negative eigenvalue, since V D and G are minus each other's transpose.
///
/// It does not feel pressures that alternate from particle to particle; a share ε of the compact
/// Laplacian A does. A, scaled to the same size near the surface, is the preconditioner.
pub(in super::super) struct ExactLaplacian<'a> {
    pub points: &'a Points,
    pub lists: Lists<'a>,
    /// Of the points: p L and ∇p are put there.
    pub numbers: &'a mut [Numbers],
    /// L of every point, turned as its image is.
    pub turned: &'a [[f64; 3]],
    pub volume: &'a [f64],
    /// ε.
    pub compact: f64,
    pub exact: &'a mut Exact,
    pub matrix: &'a Csr,
    pub preconditioner: &'a mut Preconditioner,
}

impl Product for ExactLaplacian<'_> {
    fn multiply(&mut self, path: SimdPath, x: &[f64], y: &mut [f64]) {
        let (points, lists) = (self.points, self.lists);
        let Exact { slope, softness, compact, .. } = &mut *self.exact;
        let (water, images) = self.numbers.split_at_mut(x.len());
        for ((at, correction), p) in water.iter_mut().zip(self.turned).zip(x) {
            at.tensor = correction.map(|c| c * p);
        }
        let rest = self.turned[x.len()..].iter().zip(&points.original[x.len()..]);
        for (at, (correction, &j)) in images.iter_mut().zip(rest) {
            at.tensor = correction.map(|c| c * x[j as usize]);
        }
        dispatch(path, Gradient { lists, pressure: x, numbers: self.numbers, slope });
        let (water, images) = self.numbers.split_at_mut(x.len());
        for (at, slope) in water.iter_mut().zip(&*slope) {
            at.velocity = *slope;
        }
        let rest = points.turn[x.len()..].iter().zip(&points.original[x.len()..]);
        for (at, ([a, b, c, d], &j)) in images.iter_mut().zip(rest) {
            let [u, v] = slope[j as usize];
            at.velocity = [a * u + b * v, c * u + d * v];
        }
        dispatch(path, Divergence { lists, own: slope, numbers: self.numbers, divergence: y });
        for (i, y) in y.iter_mut().enumerate() {
            *y = softness[i] * x[i] - self.volume[i] * *y;
        }
        if self.compact > 0.0 {
            self.matrix.multiply(path, x, compact);
            for (y, c) in y.iter_mut().zip(&*compact) {
                *y += self.compact * c;
            }
        }
    }

    fn precondition(&mut self, path: SimdPath, r: &[f64], z: &mut [f64]) {
        let Exact { scale, scaled, .. } = &mut *self.exact;
        for ((scaled, r), s) in scaled.iter_mut().zip(r).zip(&*scale) {
            *scaled = r * s;
        }
        self.preconditioner.apply(path, self.matrix, scaled, z);
        for (z, s) in z.iter_mut().zip(&*scale) {
            *z *= s;
        }
    }
}

#[cfg(test)]
impl Isph {
    /// The product with a pressure.
    pub(in super::super) fn exact_product(&mut self, x: &[f64]) -> Vec<f64> {
        let mut product = ExactLaplacian {
            points: &self.points,
            lists: Lists::new(&self.pairs, &self.weights, &self.points, &self.operators),
            numbers: &mut self.numbers,
            turned: &self.turned,
            volume: &self.points.volume,
            compact: self.options.compact_share,
            exact: &mut self.exact,
            matrix: &self.matrix,
            preconditioner: &mut self.preconditioner,
        };
        let mut y = vec![0.0; x.len()];
        product.multiply(self.path, x, &mut y);
        y
    }
}

impl Isph {
    /// What the products need besides the lists.
    pub(in super::super) fn prepare_exact(&mut self) {
        let n = self.fluid.len();
        let exact = &mut self.exact;
        exact.slope.resize(n, [0.0; 2]);
        exact.scaled.resize(n, 0.0);
        exact.compact.resize(n, 0.0);
    }
}
