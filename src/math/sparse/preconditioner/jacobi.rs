//! The diagonal alone.

use super::Inverse;
use crate::math::sparse::Csr;

/// z_i = r_i/a_ii.
#[derive(Debug, Clone, Default)]
pub struct Jacobi;

impl Inverse for Jacobi {
    fn prepare(&mut self, _: &Csr) {}

    fn apply(&mut self, a: &Csr, r: &[f64], z: &mut [f64]) {
        for ((z, r), d) in z.iter_mut().zip(r).zip(&a.diagonal) {
            *z = r / d;
        }
    }
}
