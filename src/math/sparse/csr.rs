//! Compressed rows, the diagonal apart.

use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};

/// A square matrix by rows: the diagonal in an array of its own, the rest compressed.
#[derive(Debug, Clone, Default)]
pub struct Csr {
    /// Where each row starts among the entries, and where the last one ends.
    pub starts: Vec<u32>,
    /// Column of each entry off the diagonal.
    pub columns: Vec<u32>,
    /// Its value.
    pub values: Vec<f64>,
    /// The diagonal.
    pub diagonal: Vec<f64>,
}

impl Csr {
    /// Empties the matrix, ready for rows.
    pub fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
        self.diagonal.clear();
    }

    /// Ends a row whose entries off the diagonal have been put in.
    pub fn end_row(&mut self) {
        self.starts.push(self.columns.len() as u32);
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// True where there are none.
    pub fn is_empty(&self) -> bool {
        self.diagonal.is_empty()
    }

    /// Entries of a row off the diagonal: columns and values.
    #[inline(always)]
    pub fn row(&self, row: usize) -> (&[u32], &[f64]) {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        (&self.columns[range.clone()], &self.values[range])
    }

    /// `y = A x`.
    pub fn multiply(&self, path: SimdPath, x: &[f64], y: &mut [f64]) {
        dispatch(path, Multiply { matrix: self, x, y });
    }
}

struct Multiply<'a> {
    matrix: &'a Csr,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl Task for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Multiply { matrix, x, y } = self;
        for (row, y) in y.iter_mut().enumerate() {
            let (columns, values) = matrix.row(row);
            let (columns, last_columns) = columns.as_chunks::<LANES>();
            let (values, last_values) = values.as_chunks::<LANES>();
            let mut sum = L::splat(0.0);
            for (c, v) in columns.iter().zip(values) {
                sum = L::load(v).mul_add(L::gather(x, c), sum);
            }
            let mut rest = matrix.diagonal[row] * x[row];
            for (&c, &v) in last_columns.iter().zip(last_values) {
                rest += v * x[c as usize];
            }
            *y = sum.sum() + rest;
        }
    }
}
