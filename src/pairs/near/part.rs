//! The clusters in parts: pieces of work that threads share.

use std::ops::Range;

use crate::math::simd::LANES;
use crate::math::team;
use crate::pairs::pair_list::PairList;
use crate::pairs::term::Eight;

/// Consecutive clusters with their neighbours. In lists clusters are counted from the first of the
/// part.
#[derive(Debug, Clone, Default)]
pub(super) struct Part {
    pub clusters: Range<usize>,
    pub list: PairList,
    /// g of every listed neighbour with the eight; zero out of reach.
    pub slopes: Vec<Eight>,
}

impl team::Part for Part {
    fn items(&self) -> Range<usize> {
        self.clusters.clone()
    }
}

impl Part {
    /// Its particles, padding included.
    pub fn lanes(&self) -> Range<usize> {
        self.clusters.start * LANES..self.clusters.end * LANES
    }

    /// The pairs of a cluster of the part: the whole list, or only the images.
    #[inline(always)]
    pub fn listed(&self, place: usize, images_alone: bool) -> (&[u32], &[Eight]) {
        let mut range = self.list.range(place);
        if images_alone {
            range.start = self.list.start(place, 1);
        }
        (&self.list.entries()[range.clone()], &self.slopes[range])
    }
}
