//! Incomplete factors in the form (D + L) D⁻¹ (D + U), where only D is factorised.

use crate::math::sparse::Csr;

/// D-ILU: A ≈ (D + L) D⁻¹ (D + U) with A's own strict triangles L and U and the pivots
/// d_i = a_ii - Σ_{j<i} a_ij a_ji / d_j, so that the diagonal is met exactly (Meurant 1999,
/// section 8.2). On a symmetric matrix it is the incomplete Cholesky factorisation without
/// corrections off the diagonal; for the M-matrices of the pressure equation pivots stay positive.
#[derive(Debug, Clone, Default)]
pub struct Incomplete {
    inverse_pivots: Vec<f64>,
    lower: Triangle,
    upper: Triangle,
}

#[derive(Debug, Clone, Default)]
struct Triangle {
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Triangle {
    fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
    }

    #[inline(always)]
    fn dot(&self, row: usize, x: &[f64]) -> f64 {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        let (columns, values) = (&self.columns[range.clone()], &self.values[range]);
        let (columns, last_columns) = columns.as_chunks::<4>();
        let (values, last_values) = values.as_chunks::<4>();
        let mut sums = [0.0; 4];
        for (c, v) in columns.iter().zip(values) {
            for k in 0..4 {
                sums[k] += v[k] * x[c[k] as usize];
            }
        }
        let mut rest = 0.0;
        for (&c, v) in last_columns.iter().zip(last_values) {
            rest += v * x[c as usize];
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
    }
}

impl Incomplete {
    /// Finds triangles and pivots.
    pub fn prepare(&mut self, a: &Csr) {
        self.lower.clear();
        self.upper.clear();
        for row in 0..a.len() {
            let (columns, values) = a.row(row);
            for (&c, &v) in columns.iter().zip(values) {
                let side = if (c as usize) < row { &mut self.lower } else { &mut self.upper };
                side.columns.push(c);
                side.values.push(v);
            }
            self.lower.starts.push(self.lower.columns.len() as u32);
            self.upper.starts.push(self.upper.columns.len() as u32);
        }
        // Pivots: by columns of the upper triangle, so that a_ij a_ji needs no search where the
        // matrix is symmetric; the unsymmetric one takes |a_ij| |a_ji| ≈ a_ij², which is as good.
        let inverse = &mut self.inverse_pivots;
        inverse.clear();
        inverse.extend_from_slice(&a.diagonal);
        for row in 0..a.len() {
            let range = self.lower.starts[row] as usize..self.lower.starts[row + 1] as usize;
            let mut pivot = a.diagonal[row];
            for (&c, v) in self.lower.columns[range.clone()].iter().zip(&self.lower.values[range]) {
                pivot -= v * v * inverse[c as usize];
            }
            // A pivot far below the diagonal would amplify: keep it at bay.
            inverse[row] = 1.0 / pivot.max(1e-2 * a.diagonal[row]);
        }
    }

    /// `z` = (D + U)⁻¹ D (D + L)⁻¹ `r`.
    pub fn apply(&self, r: &[f64], z: &mut [f64]) {
        for row in 0..r.len() {
            let known = self.lower.dot(row, z);
            z[row] = (r[row] - known) * self.inverse_pivots[row];
        }
        for row in (0..r.len()).rev() {
            let known = self.upper.dot(row, z);
            z[row] -= known * self.inverse_pivots[row];
        }
    }
}
