//! The water in reach of each target, with its weights, from one full step to the next.

use std::ops::Range;

use super::sums::Targets;
use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;

/// The particles in reach of targets with their weights.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldWeights {
    /// Room for all of the list; those of a block come first in its part.
    weights: Vec<[f64; LANES]>,
    entries: Vec<u32>,
    /// Where each block's lie.
    ranges: Vec<(u32, u32)>,
}

impl HeldWeights {
    /// Room for all pairs of a list.
    pub fn make_room(&mut self, list: &PairList) {
        self.weights.resize(list.len(), [0.0; LANES]);
        self.entries.resize(list.len(), 0);
        self.ranges.resize(list.clusters(), (0, 0));
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
        let one = L::splat(1.0);
        for block in targets.blocks.clone() {
            let row = block - targets.first;
            let listed = targets.list.group(row, 0);
            let stencil = targets.stencil::<L>(block, listed);
            let start = targets.list.start(row, 0);
            let entries = &mut held.entries[start..start + listed.len()];
            let mut count = 0;
            // Every one is written, and the next one over it if it is too far: no processor can
            // foretell which are.
            for (k, &j) in listed.iter().enumerate() {
                entries[count] = j;
                let (dx, dy) = stencil.apart(k);
                count += usize::from(dx.mul_add(dx, dy * dy).any_less(one));
            }
            held.ranges[row] = (start as u32, (start + count) as u32);
        }
    }
}
