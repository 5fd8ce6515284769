//! The targets in parts, one or more for each thread of the case.

use std::ops::Range;

use crate::math::team::Part;
use crate::pairs::{HeldWeights, PairList};

/// Consecutive blocks of eight targets with the water around them: one thread's share of a pass. In
/// lists blocks are counted from the first.
#[derive(Debug, Clone, Default)]
pub(super) struct GhostPart {
    pub blocks: Range<usize>,
    pub list: PairList,
    pub held: HeldWeights,
    /// Number of its ghosts with values of a simpler method.
    pub fallbacks: u64,
}

impl Part for GhostPart {
    fn items(&self) -> Range<usize> {
        self.blocks.clone()
    }
}

impl GhostPart {
    /// Those of some blocks that are its own. The blocks are in order, unless it is the only part.
    #[inline(always)]
    pub fn among<'a>(&self, blocks: &'a [u32]) -> &'a [u32] {
        let before = |end: usize| blocks.partition_point(|&block| (block as usize) < end);
        &blocks[before(self.blocks.start)..before(self.blocks.end)]
    }
}
