//! The targets in parts, one or more for each thread that works on the case.

use std::ops::Range;

use super::held_weights::HeldWeights;
use crate::math::team::Part;
use crate::neighbours::PairList;

/// Consecutive blocks of eight targets with the water around them: one thread's share of a pass.
/// Lists count blocks from the first.
#[derive(Debug, Clone, Default)]
pub(super) struct Stretch {
    pub blocks: Range<usize>,
    pub list: PairList,
    pub held: HeldWeights,
}

impl Part for Stretch {
    fn items(&self) -> usize {
        self.blocks.len()
    }
}

impl Stretch {
    /// Its blocks that come before one.
    #[inline(always)]
    pub fn until(&self, end: usize) -> Range<usize> {
        self.blocks.start..self.blocks.end.min(end)
    }

    /// Its blocks within a range.
    pub fn within(&self, blocks: &Range<usize>) -> Range<usize> {
        let Range { start, end } = self.blocks;
        start.max(blocks.start)..end.min(blocks.end)
    }
}
