//! Compressed rows, with the diagonal stored separately.

use std::ops::Range;

use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::math::team::{Team, cut};

/// A square matrix by rows: the diagonal in an array of its own, the rest compressed.
#[derive(Debug, Clone, Default)]
pub struct Csr {
    /// The start of each row among the entries, and the end of the last one.
    pub starts: Vec<u32>,
    /// Column of each entry off the diagonal.
    pub columns: Vec<u32>,
    /// Its value.
    pub values: Vec<f64>,
    /// The diagonal.
    pub diagonal: Vec<f64>,
    team: Team,
    /// The rows in parts; none if the work is not shared.
    parts: Vec<Range<usize>>,
}

impl Csr {
    /// Empties the matrix, ready for rows.
    pub fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.columns.clear();
        self.values.clear();
        self.diagonal.clear();
        self.parts.clear();
    }

    /// Appends the rows of another matrix, whose columns are those of this one.
    pub fn append(&mut self, more: &Csr) {
        let before = self.columns.len() as u32;
        self.starts.extend(more.starts[1..].iter().map(|start| before + start));
        self.columns.extend_from_slice(&more.columns);
        self.values.extend_from_slice(&more.values);
        self.diagonal.extend_from_slice(&more.diagonal);
    }

    /// Shares the products with the present rows among a team.
    pub fn share_among(&mut self, team: &Team) {
        self.parts.clear();
        if team.parts() > 1 {
            self.parts.extend(cut(self.len(), team.parts()));
        }
        self.team = team.clone();
    }

    /// The team that shares the work on the matrix.
    pub fn team(&self) -> &Team {
        &self.team
    }

    /// Finds a value for every row, given its number.
    pub fn each_row<T: Send>(&self, values: &mut [T], find: impl Fn(usize) -> T + Sync) {
        self.share(values, |rows, values| {
            for (row, value) in rows.zip(values) {
                *value = find(row);
            }
        });
    }

    /// Does the work on consecutive rows and their values, part by part.
    fn share<T: Send>(&self, values: &mut [T], work: impl Fn(Range<usize>, &mut [T]) + Sync) {
        let all = 0..self.len();
        let parts = if self.parts.is_empty() { std::slice::from_ref(&all) } else { &self.parts };
        self.team.read(parts, values, &|rows, values| work(rows.clone(), values));
    }

    /// Writes a function of `y` and `A x`, row by row.
    fn products(
        &self,
        path: SimdPath,
        x: &[f64],
        y: &mut [f64],
        close: impl Fn(f64, f64) -> f64 + Sync,
    ) {
        self.share(y, |rows, y| {
            dispatch(path, Multiply { matrix: self, rows, x, y, close: &close });
        });
    }

    /// Ends a row whose off-diagonal entries have been added.
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
        self.products(path, x, y, |_, product| product);
    }

    /// `y += factor A x`.
    pub fn add_product(&self, path: SimdPath, factor: f64, x: &[f64], y: &mut [f64]) {
        self.products(path, x, y, |y, product| y + factor * product);
    }
}

struct Multiply<'a, F> {
    matrix: &'a Csr,
    rows: Range<usize>,
    x: &'a [f64],
    y: &'a mut [f64],
    close: &'a F,
}

impl<F: Fn(f64, f64) -> f64> Task for Multiply<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Multiply { matrix, rows, x, y, close } = self;
        for (row, y) in rows.zip(y) {
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
            *y = close(*y, sum.sum() + rest);
        }
    }
}
