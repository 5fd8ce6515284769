//! A range of rows of a coarse matrix, assembled by one member of a team.

use std::ops::Range;

use super::NONE;
use crate::math::sparse::Csr;
use crate::math::team::Part;

/// Consecutive rows of a coarse matrix during assembly.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    pub rows: Range<usize>,
    pub matrix: Csr,
    /// The place of a column among the entries, if it has one.
    slot: Vec<u32>,
}

impl Part for Block {
    fn items(&self) -> Range<usize> {
        self.rows.clone()
    }
}

impl Block {
    /// Sums the entries between aggregates. There are `count` aggregates with these members.
    pub fn gather<'m>(
        &mut self,
        fine: &Csr,
        aggregate: &[u32],
        (count, members): (usize, impl Fn(usize) -> &'m [u32]),
    ) {
        let Block { rows, matrix: coarse, slot } = self;
        coarse.clear();
        slot.clear();
        slot.resize(count, NONE);
        for own in rows.clone() {
            let start = coarse.columns.len();
            let mut diagonal = 0.0;
            for &row in members(own) {
                diagonal += fine.diagonal[row as usize];
                let (columns, values) = fine.row(row as usize);
                for (&c, &v) in columns.iter().zip(values) {
                    let to = aggregate[c as usize] as usize;
                    let at = slot[to] as usize;
                    if to == own {
                        diagonal += v;
                    } else if slot[to] != NONE && at >= start {
                        coarse.values[at] += v;
                    } else {
                        slot[to] = coarse.columns.len() as u32;
                        coarse.columns.push(to as u32);
                        coarse.values.push(v);
                    }
                }
            }
            coarse.end_row();
            coarse.diagonal.push(diagonal);
        }
    }
}
