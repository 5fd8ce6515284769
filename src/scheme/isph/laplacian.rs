//! The Laplacian that fits the scheme's own divergence and gradient.

use super::divergence::divergence;
use super::exact::Exact;
use super::gradient::gradient;
use super::images::Point;
use super::operators::Operators;
use crate::math::simd::SimdPath;
use crate::math::sparse::{Csr, Preconditioner, Product};
use crate::pairs::Near;

/// -V D G p + C p + ε A p: minus the divergence of the gradient, both as in `project.rs`. It is
/// never stored: a product is one pass for the gradient and one for the divergence. It is symmetric
/// and has no negative eigenvalue, because V D and G are minus each other's transpose.
///
/// It does not feel pressures that alternate from particle to particle. The compact Laplacian A
/// does, so a share ε of it is added. A, scaled to the same size near the surface, is also the
/// preconditioner.
pub(super) struct ExactLaplacian<'a> {
    pub path: SimdPath,
    /// p L and ∇p are written into its records.
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
        let (points, operators, turned) = (self.points, self.operators, self.turned);
        let Exact { slope, softness, .. } = &mut *self.exact;
        self.near.each_point(|[e, j], at| {
            let ([xx, xy, yy], p) = (turned[e], x[j]);
            at.set_pressure([xx * p, xy * p, yy * p]);
        });
        gradient((self.near, operators), (x, 1.0), slope);
        self.near.each_point(|[e, j], at| {
            at.set_velocity(if e == j { slope[j] } else { points[e].turned(slope[j]) });
        });
        let volume = &self.near.volume;
        divergence((self.near, operators), slope, y, |i, divergence| {
            softness[i] * x[i] - volume[i] * divergence
        });
        if self.compact > 0.0 {
            self.matrix.add_product(self.path, self.compact, x, y);
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
