//! The Laplacian that belongs to the scheme's own divergence and gradient.

use super::divergence::divergence;
use super::exact::Exact;
use super::gradient::gradient;
use super::images::Point;
use super::operators::Operators;
use crate::math::simd::SimdPath;
use crate::math::sparse::{Csr, Preconditioner, Product};
use crate::pairs::Near;

/// -V D G p + C p + ε A p: minus the divergence of the gradient, both as in `project.rs`, never
/// stored: a product is one pass for the gradient and one for the divergence. It is symmetric and has
/// no negative eigenvalue, since V D and G are minus each other's transpose.
///
/// It does not feel pressures that alternate from particle to particle; a share ε of the compact
/// Laplacian A does. A, scaled to the same size near the surface, is the preconditioner.
pub(super) struct ExactLaplacian<'a> {
    pub path: SimdPath,
    /// p L and ∇p are put into the records.
    pub near: &'a mut Near,
    pub points: &'a [Point],
    pub operators: &'a Operators,
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
        let (path, points, operators) = (self.path, self.points, self.operators);
        let Exact { slope, softness, compact, .. } = &mut *self.exact;
        let n = x.len();
        let (water, images) = self.near.records.split_at_mut(n);
        for ((at, correction), p) in water.iter_mut().zip(self.turned).zip(x) {
            at.set_pressure(correction.map(|c| c * p));
        }
        for ((at, correction), point) in images.iter_mut().zip(&self.turned[n..]).zip(&points[n..])
        {
            at.set_pressure(correction.map(|c| c * x[point.original as usize]));
        }
        gradient((self.near, operators), x, slope);
        let (water, images) = self.near.records.split_at_mut(n);
        for (at, slope) in water.iter_mut().zip(&*slope) {
            at.set_velocity(*slope);
        }
        for (at, point) in images.iter_mut().zip(&points[n..]) {
            at.set_velocity(point.turned(slope[point.original as usize]));
        }
        divergence((self.near, operators), slope, y);
        for (i, y) in y.iter_mut().enumerate() {
            *y = softness[i] * x[i] - self.near.volume[i] * *y;
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
