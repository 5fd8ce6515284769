//! The water in reach of each target, with its weights, from one full step to the next.

use std::ops::Range;

use super::sums::Targets;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::PairList;

/// The particles in reach of targets with their weights, block after block.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldWeights {
    weights: Vec<[f64; LANES]>,
    entries: Vec<u32>,
    /// Where each block's lie.
    ranges: Vec<(u32, u32)>,
}

impl HeldWeights {
    /// Room for the targets of a list. The first list is room for the weights of later ones, too: it
    /// reaches much farther than the weights do.
    pub fn make_room(&mut self, list: &PairList) {
        if self.entries.is_empty() {
            self.entries = vec![0; list.len()];
            self.weights = vec![[0.0; LANES]; list.len()];
        }
        self.ranges.resize(list.clusters(), (0, 0));
    }

    /// Where the first block of some may begin: behind all that is held of those before it.
    fn end_before(&self, block: usize) -> usize {
        self.ranges[..block].iter().map(|&(_, end)| end).max().unwrap_or(0) as usize
    }

    #[inline(always)]
    fn range(&self, block: usize) -> Range<usize> {
        let (start, end) = self.ranges[block];
        start as usize..end as usize
    }

    /// The particles in reach of a block of targets, and room for their weights.
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
}

/// Finds the listed particles that are in reach of targets: the only ones that are weighed.
pub(super) struct Near<'a> {
    pub targets: Targets<'a>,
    pub held: &'a mut HeldWeights,
}

impl Task for Near<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Near { targets, held } = self;
        if targets.blocks.is_empty() {
            return;
        }
        let one = L::splat(1.0);
        let mut end = held.end_before(targets.blocks.start - targets.first);
        for block in targets.blocks.clone() {
            let row = block - targets.first;
            let listed = targets.list.group(row, 0);
            let stencil = targets.stencil::<L>(block, listed);
            if held.entries.len() < end + listed.len() {
                held.entries.resize(2 * (end + listed.len()), 0);
            }
            let entries = &mut held.entries[end..end + listed.len()];
            let mut count = 0;
            // Every one is written, and the next one over it if it is too far: no processor can
            // foretell which are.
            for (k, &j) in listed.iter().enumerate() {
                entries[count] = j;
                let (dx, dy) = stencil.apart(k);
                count += usize::from(dx.mul_add(dx, dy * dy).any_less(one));
            }
            held.ranges[row] = (end as u32, (end + count) as u32);
            end += count;
        }
        if held.weights.len() < end {
            held.weights.resize(2 * end, [0.0; LANES]);
        }
    }
}
