//! The Laplacian that belongs to the scheme's own divergence and gradient.

use super::super::Isph;
use super::super::images::Points;
use super::super::sums::{Divergence, Gradient, Lists};
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
    /// Number of points.
    pub count: usize,
    pub lists: Lists<'a>,
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
        let points = self.points;
        let Exact { stress, moving, slope, softness, compact, .. } = &mut *self.exact;
        for e in 0..self.count {
            let p = x[points.original[e] as usize];
            for (stress, correction) in stress.iter_mut().zip(self.turned[e]) {
                stress[e] = correction * p;
            }
        }
        let stress = [0, 1, 2].map(|k| &stress[k][..]);
        dispatch(path, Gradient { lists: self.lists, pressure: x, stress, slope });
        for e in 0..self.count {
            let [u, v] = slope[points.original[e] as usize];
            let [a, b, c, d] = points.turn[e];
            moving[0][e] = a * u + b * v;
            moving[1][e] = c * u + d * v;
        }
        let moving = [&moving[0][..], &moving[1][..]];
        dispatch(path, Divergence { lists: self.lists, own: slope, moving, divergence: y });
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
        let operators = &self.operators;
        let mut product = ExactLaplacian {
            points: &self.points,
            count: self.loose.len(),
            lists: Lists {
                starts: &self.list_starts,
                near: &self.near,
                pull: [&self.pull_x, &self.pull_y],
                sway: &operators.sway,
                correction: &operators.correction,
            },
            turned: &self.turned,
            volume: &self.volumes,
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
        let (n, count) = (self.fluid.len(), self.loose.len());
        self.volumes.clear();
        self.volumes.extend(self.fluid.mass[..n].iter().map(|mass| mass / self.options.density));
        let exact = &mut self.exact;
        exact.stress.iter_mut().for_each(|stress| stress.resize(count, 0.0));
        exact.moving.iter_mut().for_each(|moving| moving.resize(count, 0.0));
        exact.slope.resize(n, [0.0; 2]);
        exact.scaled.resize(n, 0.0);
        exact.compact.resize(n, 0.0);
    }
}
