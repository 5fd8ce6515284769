//! Small matrices, solved directly.

use crate::math::sparse::Csr;

/// Dense LU factors without row exchanges: the matrix is diagonally dominant.
#[derive(Debug, Clone, Default)]
pub(super) struct Dense {
    factors: Vec<f64>,
    /// 0 if there are no factors, because the matrix is not small.
    pub size: usize,
}

impl Dense {
    /// Finds the factors of a matrix of at most `most` rows.
    pub fn factorise(&mut self, a: &Csr, most: usize) {
        let n = if a.len() <= most { a.len() } else { 0 };
        let dense = &mut self.factors;
        self.size = n;
        dense.clear();
        dense.resize(n * n, 0.0);
        for row in 0..n {
            dense[row * n + row] = a.diagonal[row];
            let (columns, values) = a.row(row);
            for (&c, v) in columns.iter().zip(values) {
                dense[row * n + c as usize] += v;
            }
        }
        for k in 0..n {
            let (done, rest) = dense.split_at_mut((k + 1) * n);
            let top = &done[k * n..];
            for row in rest.chunks_exact_mut(n) {
                let factor = row[k] / top[k];
                if factor != 0.0 {
                    row[k] = factor;
                    for (value, top) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                        *value -= factor * top;
                    }
                }
            }
        }
    }

    /// `z` = A⁻¹ `r`.
    pub fn substitute(&self, r: &[f64], z: &mut [f64]) {
        let n = r.len();
        let known = |row: usize, columns: std::ops::Range<usize>, z: &[f64]| -> f64 {
            columns.map(|c| self.factors[row * n + c] * z[c]).sum()
        };
        for row in 0..n {
            z[row] = r[row] - known(row, 0..row, z);
        }
        for row in (0..n).rev() {
            z[row] = (z[row] - known(row, row + 1..n, z)) / self.factors[row * n + row];
        }
    }
}
