//! Incomplete factors in the form (D + L) D⁻¹ (D + U), where only D is factorised.

use super::Inverse;
use crate::math::sparse::Csr;

/// D-ILU: A ≈ (D + L) D⁻¹ (D + U) with A's own strict triangles L and U. The pivots d_i = a_ii -
/// Σ_{j<i} a_ij a_ji / d_j reproduce the diagonal exactly (Meurant 1999, section 8.2). On a
/// symmetric matrix it is the incomplete Cholesky factorisation without corrections off the
/// diagonal. For the M-matrices of the pressure equation pivots stay positive.
#[derive(Debug, Clone, Default)]
pub struct Incomplete {
    inverse_pivots: Vec<f64>,
    /// Both without their diagonals.
    lower: Csr,
    upper: Csr,
}

impl Inverse for Incomplete {
    /// Finds triangles and pivots.
    fn prepare(&mut self, a: &Csr) {
        let Incomplete { inverse_pivots: inverse, lower, upper } = self;
        lower.clear();
        upper.clear();
        inverse.clear();
        for row in 0..a.len() {
            let (columns, values) = a.row(row);
            for (&c, &v) in columns.iter().zip(values) {
                let side = if (c as usize) < row { &mut *lower } else { &mut *upper };
                side.columns.push(c);
                side.values.push(v);
            }
            lower.end_row();
            upper.end_row();
            // a_ij² in place of a_ij a_ji needs no search. It is exact where A is symmetric, and
            // good enough elsewhere.
            let mut pivot = a.diagonal[row];
            let (columns, values) = lower.row(row);
            for (&c, v) in columns.iter().zip(values) {
                pivot -= v * v * inverse[c as usize];
            }
            // A pivot far below the diagonal would amplify, so it is bounded.
            inverse.push(1.0 / pivot.max(1e-2 * a.diagonal[row]));
        }
    }

    /// `z` = (D + U)⁻¹ D (D + L)⁻¹ `r`.
    fn apply(&mut self, _: &Csr, r: &[f64], z: &mut [f64]) {
        for row in 0..r.len() {
            z[row] = (r[row] - dot(self.lower.row(row), z)) * self.inverse_pivots[row];
        }
        for row in (0..r.len()).rev() {
            z[row] -= dot(self.upper.row(row), z) * self.inverse_pivots[row];
        }
    }
}

/// Product of a row with a vector, in four running sums.
#[inline(always)]
fn dot((columns, values): (&[u32], &[f64]), x: &[f64]) -> f64 {
    let (columns, last_columns) = columns.as_chunks::<4>();
    let (values, last_values) = values.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (c, v) in columns.iter().zip(values) {
        for k in 0..4 {
            sums[k] += v[k] * x[c[k] as usize];
        }
    }
    let mut rest = 0.0;
    for (&c, &v) in last_columns.iter().zip(last_values) {
        rest += v * x[c as usize];
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
