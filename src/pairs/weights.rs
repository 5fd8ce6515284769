//! The water in reach of targets and its weights, from one full step to the next.

use std::ops::Range;

use super::pair_list::PairList;
use super::record::Record;
use crate::math::simd::{LANES, Lanes};

/// The particles in reach of targets with their weights, block after block.
#[derive(Debug, Clone, Default)]
pub struct HeldWeights {
    weights: Vec<[f64; LANES]>,
    entries: Vec<u32>,
    /// Index range of each block.
    ranges: Vec<(u32, u32)>,
}

impl HeldWeights {
    /// Reserves memory for the targets of a list. The first list has room for the weights of later
    /// ones too, because it reaches much farther than the weights.
    pub fn make_room(&mut self, list: &PairList) {
        if self.entries.is_empty() {
            self.entries = vec![0; list.len()];
            self.weights = vec![[0.0; LANES]; list.len()];
        }
        self.ranges.resize(list.clusters(), (0, 0));
    }

    /// Where a block may begin: after the entries of all blocks before it.
    pub fn end_before(&self, block: usize) -> usize {
        self.ranges[..block].iter().map(|&(_, end)| end).max().unwrap_or(0) as usize
    }

    #[inline(always)]
    fn range(&self, block: usize) -> Range<usize> {
        let (start, end) = self.ranges[block];
        start as usize..end as usize
    }

    /// The particles in reach of a block of targets, and memory for their weights.
    #[inline(always)]
    pub fn room(&mut self, block: usize) -> (&[u32], &mut [[f64; LANES]]) {
        let range = self.range(block);
        (&self.entries[range.clone()], &mut self.weights[range])
    }

    /// The particles in reach of a block of targets, and their weights.
    #[inline(always)]
    pub fn of(&self, block: usize) -> (&[u32], &[[f64; LANES]]) {
        let range = self.range(block);
        (&self.entries[range.clone()], &self.weights[range])
    }

    /// Σ w_j f_j over the particles in reach of a block of targets, for fields f of the water.
    #[inline(always)]
    pub fn sums<L: Lanes, const N: usize>(&self, block: usize, fields: [&[f64]; N]) -> [L; N] {
        let (entries, weights) = self.of(block);
        let mut sums = [L::splat(0.0); N];
        for (&j, weight) in entries.iter().zip(weights) {
            let weight = L::load(weight);
            for n in 0..N {
                sums[n] = weight.mul_add(L::splat(fields[n][j as usize]), sums[n]);
            }
        }
        sums
    }

    /// Takes the listed particles that are in reach of a block of targets, whose places are over R.
    /// They are stored after `end` others; returns the new number. Blocks must come in order.
    #[inline(always)]
    pub fn take<L: Lanes>(
        &mut self,
        block: usize,
        listed: &[u32],
        [x, y]: [L; 2],
        records: &[Record],
        end: usize,
    ) -> usize {
        if self.entries.len() < end + listed.len() {
            self.entries.resize(2 * (end + listed.len()), 0);
        }
        let entries = &mut self.entries[end..end + listed.len()];
        let mut count = 0;
        // Every one is written. If it is too far, the next one overwrites it: no processor can
        // predict which are.
        for &j in listed {
            entries[count] = j;
            let record = &records[j as usize].0;
            let (dx, dy) = (L::splat(record[Record::X]) - x, L::splat(record[Record::Y]) - y);
            count += usize::from(dx.mul_add(dx, dy * dy).any_less(L::splat(1.0)));
        }
        self.ranges[block] = (end as u32, (end + count) as u32);
        if self.weights.len() < end + count {
            self.weights.resize(2 * (end + count), [0.0; LANES]);
        }
        end + count
    }
}
