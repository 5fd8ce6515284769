//! The pressure equation as a matrix.

use super::Isph;
use super::lists::{Lists, Numbers, load};
use super::options::Laplacian;
use super::state::Operators;
use super::system::System;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::math::sparse::Csr;

/// Share of the diagonal that is added so that no part of the water is without hold.
const HOLD: f64 = 1e-8;

/// Rows of eight particles under way: common columns, with the eight values of each.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    columns: Vec<u32>,
    values: Vec<[f64; LANES]>,
    /// Where a column stands among them, if it does.
    pub slot: Vec<u32>,
}

impl Rows {
    /// Takes up a column's values, added to those that an image of it has left.
    #[inline(always)]
    fn add<L: Lanes>(&mut self, column: u32, values: L) {
        let at = self.slot[column as usize] as usize;
        if self.columns.get(at) == Some(&column) {
            let sum = L::load(&self.values[at]) + values;
            sum.store(&mut self.values[at]);
            return;
        }
        self.slot[column as usize] = self.columns.len() as u32;
        self.columns.push(column);
        self.values.push(values.to_array());
    }

    /// Moves the rows of the first few of the eight over to the matrix, without what is zero.
    #[inline(always)]
    fn pass_on(&mut self, count: usize, matrix: &mut Csr) {
        let Csr { starts, columns, values, .. } = matrix;
        for lane in 0..count {
            let start = columns.len();
            columns.resize(start + self.columns.len(), 0);
            values.resize(start + self.columns.len(), 0.0);
            let room = (&mut columns[start..], &mut values[start..]);
            let mut found = 0;
            // Every entry is written, and the next one over it if it was zero.
            for (&column, eight) in self.columns.iter().zip(&self.values) {
                (room.0[found], room.1[found]) = (column, eight[lane]);
                found += usize::from(eight[lane] != 0.0);
            }
            columns.truncate(start + found);
            values.truncate(start + found);
            starts.push(columns.len() as u32);
        }
        self.columns.clear();
        self.values.clear();
    }
}

struct Assemble<'a> {
    lists: Lists<'a>,
    numbers: &'a [Numbers],
    operators: &'a Operators,
    /// Least V_i V_j F of a pair that is taken, and what it is scaled by, where not all are.
    narrow: Option<(f64, f64)>,
    /// Whether 2 s·∇p is taken off.
    corrected: bool,
    rows: &'a mut Rows,
    matrix: &'a mut Csr,
}

impl Assemble<'_> {
    /// L s of the eight, where it is taken off.
    #[inline(always)]
    fn tilt<L: Lanes>(&self, cluster: usize, count: usize) -> [L; 2] {
        let (mut tilt_x, mut tilt_y) = ([0.0; LANES], [0.0; LANES]);
        for (lane, (x, y)) in tilt_x.iter_mut().zip(&mut tilt_y).enumerate().take(count) {
            let i = cluster * LANES + lane;
            if self.operators.grip[i] == 0.0 {
                let [sx, sy] = self.operators.sway[i];
                let [cx, cxy, cy] = self.operators.correction[i];
                (*x, *y) = (sx * cx + sy * cxy, sx * cxy + sy * cy);
            }
        }
        [L::load(&tilt_x), L::load(&tilt_y)]
    }
}

impl Task for Assemble<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let n = self.operators.grip.len();
        let zero = L::splat(0.0);
        for cluster in 0..n.div_ceil(LANES) {
            let count = LANES.min(n - cluster * LANES);
            let place = self.lists.place::<L>(cluster);
            let volume = load::<L>(&self.lists.points.volume, cluster);
            let tilt = if self.corrected { self.tilt::<L>(cluster, count) } else { [zero; 2] };
            let mut diagonal = zero;
            let (near, weights) = self.lists.of(cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let mut weight = volume * L::load(weights);
                if let Some((least, scale)) = self.narrow {
                    weight = weight.select_less(L::splat(least), zero, weight * L::splat(scale));
                }
                if self.corrected {
                    let at = &self.numbers[e as usize].place;
                    let (dx, dy) = (L::splat(at[0]) - place[0], L::splat(at[1]) - place[1]);
                    let off = tilt[0].mul_add(dx, tilt[1] * dy);
                    weight = off.negated_mul_add(weight, weight);
                }
                weight += weight;
                if self.narrow.is_some() && !zero.any_less(weight) {
                    continue;
                }
                let j = self.lists.points.original[e as usize];
                if j as usize / LANES == cluster {
                    // With itself or its own image: the same pressure.
                    let mut others = weight.to_array();
                    others[j as usize % LANES] = 0.0;
                    weight = L::load(&others);
                }
                diagonal += weight;
                self.rows.add(j, zero - weight);
            }
            let diagonal = diagonal.to_array();
            for (lane, diagonal) in diagonal[..count].iter().enumerate() {
                let i = cluster * LANES + lane;
                let held = self.lists.points.volume[i] * self.operators.grip[i];
                self.matrix.diagonal.push(diagonal + held);
            }
            self.rows.pass_on(count, self.matrix);
        }
    }
}

impl Isph {
    /// Rows of V_i times 2 Σ F (p_i - p_j) + grip p_i, for the dynamic pressure (Liang et al. 2017,
    /// Eqs. 4 and 11). The surface holds the pressure by its grip.
    ///
    /// A support that is cut off has its normalisation κ_i on the right, so that the matrix stays
    /// symmetric. With [`Laplacian::Schwaiger`] F becomes F (1 - s·L Δ), which takes 2 s·∇p off: zero on
    /// linear fields in any arrangement. For [`Laplacian::Exact`] only near neighbours are taken.
    pub(super) fn assemble(&mut self) {
        let exact = self.options.laplacian == Laplacian::Exact;
        let System { matrix, rows, .. } = &mut self.system;
        let pairs = &self.near.pairs;
        matrix.clear();
        if matrix.columns.capacity() == 0 {
            // Half of all listed pairs are in reach: room for later and longer lists.
            matrix.columns.reserve(LANES * pairs.len());
            matrix.values.reserve(LANES * pairs.len());
        }
        rows.slot.resize(self.fluid.len(), 0);
        let assemble = Assemble {
            lists: self.near.lists(&self.operators),
            numbers: &self.numbers,
            operators: &self.operators,
            narrow: exact.then_some(self.even.narrow),
            corrected: self.options.laplacian == Laplacian::Schwaiger,
            rows,
            matrix,
        };
        dispatch(self.path, assemble);
        if exact {
            // Parts that nothing holds stay solvable.
            self.system.matrix.diagonal.iter_mut().for_each(|diagonal| *diagonal *= 1.0 + HOLD);
        } else {
            self.system.hold_components(&self.operators.grip);
        }
    }
}
