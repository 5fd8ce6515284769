//! The targets in parts, one or more for each thread that works on the case.

use std::ops::Range;

use crate::math::team::Part;
use crate::pairs::{HeldWeights, PairList};

/// Consecutive blocks of eight targets with the water around them: one thread's share of a pass.
/// Lists count blocks from the first.
#[derive(Debug, Clone, Default)]
pub(super) struct GhostPart {
    pub blocks: Range<usize>,
    pub list: PairList,
    pub held: HeldWeights,
    /// How many of its ghosts hold what a simpler method gave.
    pub fallbacks: u64,
}

impl Part for GhostPart {
    fn items(&self) -> Range<usize> {
        self.blocks.clone()
    }
}

impl GhostPart {
    /// Its own of some blocks. These are in order, unless it is the only part.
    #[inline(always)]
    pub fn among<'a>(&self, blocks: &'a [u32]) -> &'a [u32] {
        let before = |end: usize| blocks.partition_point(|&block| (block as usize) < end);
        &blocks[before(self.blocks.start)..before(self.blocks.end)]
    }
}
