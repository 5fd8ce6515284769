//! The Laplacian that belongs to the scheme's own divergence and gradient.

use super::exact::Exact;
use super::lists::{Lists, Numbers};
use super::sums::{divergence, gradient};
use crate::math::simd::SimdPath;
use crate::math::sparse::{Csr, Preconditioner, Product};

/// -V D G p + C p + ε A p: minus the divergence of the gradient, both as in `project.rs`, never
/// stored: a product is one pass for the gradient and one for the divergence. It is symmetric and has
/// no negative eigenvalue, since V D and G are minus each other's transpose.
///
/// It does not feel pressures that alternate from particle to particle; a share ε of the compact
/// Laplacian A does. A, scaled to the same size near the surface, is the preconditioner.
pub(super) struct ExactLaplacian<'a> {
    pub path: SimdPath,
    pub lists: Lists<'a>,
    /// Of the points: p L and ∇p are put there.
    pub numbers: &'a mut [Numbers],
    /// L of every point, turned as its image is.
    pub turned: &'a [[f64; 3]],
    /// ε.
    pub compact: f64,
    pub exact: &'a mut Exact,
    pub matrix: &'a Csr,
    pub preconditioner: &'a mut Preconditioner,
}

impl Product for ExactLaplacian<'_> {
    fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
        let (path, lists, points) = (self.path, self.lists, self.lists.points);
        let Exact { slope, softness, compact, .. } = &mut *self.exact;
        let n = x.len();
        let (water, images) = self.numbers.split_at_mut(n);
        for ((at, correction), p) in water.iter_mut().zip(self.turned).zip(x) {
            at.tensor = correction.map(|c| c * p);
        }
        let rest = self.turned[n..].iter().zip(&points.original[n..]);
        for (at, (correction, &j)) in images.iter_mut().zip(rest) {
            at.tensor = correction.map(|c| c * x[j as usize]);
        }
        gradient(path, (lists, self.numbers), x, slope);
        let (water, images) = self.numbers.split_at_mut(n);
        for (at, slope) in water.iter_mut().zip(&*slope) {
            at.velocity = *slope;
        }
        let rest = points.turn[n..].iter().zip(&points.original[n..]);
        for (at, ([a, b, c, d], &j)) in images.iter_mut().zip(rest) {
            let [u, v] = slope[j as usize];
            at.velocity = [a * u + b * v, c * u + d * v];
        }
        divergence(path, (lists, self.numbers), slope, y);
        for (i, y) in y.iter_mut().enumerate() {
            *y = softness[i] * x[i] - points.volume[i] * *y;
        }
        if self.compact > 0.0 {
            self.matrix.multiply(path, x, compact);
            for (y, c) in y.iter_mut().zip(&*compact) {
                *y += self.compact * c;
            }
        }
    }

    fn precondition(&mut self, r: &[f64], z: &mut [f64]) {
        let Exact { scale, scaled, .. } = &mut *self.exact;
        for ((scaled, r), s) in scaled.iter_mut().zip(r).zip(&*scale) {
            *scaled = r * s;
        }
        self.preconditioner.apply(self.matrix, scaled, z);
        for (z, s) in z.iter_mut().zip(&*scale) {
            *z *= s;
        }
    }
}
