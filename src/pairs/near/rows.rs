//! The matrix of the pairs' couplings.

use std::ops::Range;

use super::Near;
use super::part::Part;
use crate::math::simd::{LANES, Lanes, Task, Vector, dispatch};
use crate::math::sparse::Csr;
use crate::math::team;
use crate::pairs::fields::Here;
use crate::pairs::geometry::Pair;
use crate::pairs::term::Eight;

/// The coupling of a pair: w_ij of rows Σ_j w_ij (p_i - p_j).
pub trait Coupling: Copy {
    /// Its data of the particle itself.
    type Own<R: Vector>: Copy;
    /// Reads the particle itself.
    fn own<R: Vector>(&self, here: Here) -> Self::Own<R>;
    /// The coupling; none if none of the pairs gets an entry.
    fn of<R: Vector>(&self, own: &Self::Own<R>, pair: &Pair<R>) -> Option<R>;
}

/// Memory for a matrix that is assembled part by part.
#[derive(Debug, Clone, Default)]
pub struct Blocks(Vec<Block>);

/// The rows of a part.
#[derive(Debug, Clone, Default)]
struct Block {
    /// Which part.
    number: usize,
    rows: Rows,
    matrix: Csr,
}

impl team::Part for Block {
    fn items(&self) -> Range<usize> {
        self.number..self.number + 1
    }
}

/// Rows of eight particles during assembly: common columns, with eight values each.
#[derive(Debug, Clone, Default)]
struct Rows {
    columns: Vec<u32>,
    values: Vec<Eight>,
    /// The place of a column among them, if it has one.
    slot: Vec<u32>,
}

impl Rows {
    /// Adds a column's values to those of an image of it.
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

    /// Moves the rows of the first `count` particles to the matrix, without zeros.
    #[inline(always)]
    fn pass_on(&mut self, count: usize, matrix: &mut Csr) {
        let Csr { starts, columns, values, .. } = matrix;
        for lane in 0..count {
            let start = columns.len();
            columns.resize(start + self.columns.len(), 0);
            values.resize(start + self.columns.len(), 0.0);
            let room = (&mut columns[start..], &mut values[start..]);
            let mut found = 0;
            // Every entry is written. If it is zero, the next one overwrites it.
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

struct Assemble<'a, C> {
    near: &'a Near,
    coupling: C,
    part: &'a Part,
    block: &'a mut Block,
}

impl<C: Coupling> Task for Assemble<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Assemble { near, coupling, part, block } = self;
        let Block { rows, matrix, .. } = block;
        let zero = L::splat(0.0);
        for (place, cluster) in part.clusters.clone().enumerate() {
            let here = Here::new(cluster, place);
            let (places, own) = (near.eight::<L>(here), coupling.own::<L>(here));
            let mut diagonal = zero;
            let (entries, slopes) = part.listed(place, false);
            for (&e, slope) in entries.iter().zip(slopes) {
                let Some(mut weight) =
                    coupling.of(&own, &Near::pair(places, &near.records[e as usize], slope))
                else {
                    continue;
                };
                let j = near.original[e as usize];
                if j as usize / LANES == cluster {
                    // With itself or its own image: the same pressure.
                    let mut others = weight.to_array();
                    others[j as usize % LANES] = 0.0;
                    weight = L::load(&others);
                }
                diagonal += weight;
                rows.add(j, zero - weight);
            }
            let count = LANES.min(near.water - cluster * LANES);
            matrix.diagonal.extend_from_slice(&diagonal.to_array()[..count]);
            rows.pass_on(count, matrix);
        }
    }
}

impl Near {
    /// Makes a matrix of the rows Σ_j w_ij (p_i - p_j). The value at an image is that of its
    /// original.
    pub fn couple(&self, coupling: impl Coupling + Sync, blocks: &mut Blocks, matrix: &mut Csr) {
        let Blocks(blocks) = blocks;
        blocks.resize_with(self.parts.len(), Block::default);
        for (number, block) in blocks.iter_mut().enumerate() {
            block.number = number;
        }
        // The first rows are assembled in their final place.
        std::mem::swap(&mut blocks[0].matrix, matrix);
        self.team.share(blocks, (), &|block, ()| {
            let (part, matrix) = (&self.parts[block.number], &mut block.matrix);
            matrix.clear();
            if matrix.columns.capacity() == 0 {
                // Half of all listed pairs are in reach, so this leaves room for later and longer
                // lists.
                matrix.columns.reserve(LANES * part.list.len());
                matrix.values.reserve(LANES * part.list.len());
            }
            block.rows.slot.resize(self.water, 0);
            dispatch(self.path, Assemble { near: self, coupling, part, block });
        });
        std::mem::swap(&mut blocks[0].matrix, matrix);
        blocks[1..].iter().for_each(|block| matrix.append(&block.matrix));
        matrix.share_among(&self.team);
    }
}
