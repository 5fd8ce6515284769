//! The clusters in parts: pieces of work that follow each other through the passes of a step, or
//! that threads share.

use std::ops::Range;

use super::held::HeldPairs;
use crate::math::simd::LANES;
use crate::math::team::{self, Team};
use crate::neighbours::PairList;

/// Consecutive clusters with their neighbours. Lists count clusters from the first of the part.
#[derive(Debug, Clone, Default)]
pub(super) struct Part {
    pub clusters: Range<usize>,
    /// Neighbours in reach or soon to be.
    pub pairs: PairList,
    /// The pairs in reach, from the last full step.
    pub held: HeldPairs,
    /// Σ g Δ of each cluster with the ghosts of each body that it has in reach, along x and y.
    pub near: Vec<[[f64; LANES]; 2]>,
    /// Clusters whose acceleration responds to the wall's, with the response per lane.
    pub responding: Vec<(u32, [f64; LANES], [f64; LANES])>,
    pub tally: Tally,
}

impl Part {
    /// Its particles, padding included.
    pub fn lanes(&self) -> Range<usize> {
        self.clusters.start * LANES..self.clusters.end * LANES
    }

    /// Room for what its clusters leave, so that steps need none. Of whole water one cluster in four
    /// at the most comes near enough to a wall to respond to it.
    fn make_room(&mut self) {
        let (clusters, powers) = (self.clusters.len(), &mut self.tally.powers);
        powers.reserve(clusters.saturating_sub(powers.len()));
        let some = clusters.div_ceil(4);
        self.responding.reserve(some.saturating_sub(self.responding.len()));
    }
}

impl team::Part for Part {
    fn items(&self) -> Range<usize> {
        self.clusters.clone()
    }
}

/// What a part's clusters add to sums over all of them. One sum after the other is added, in the
/// order of the clusters, so that the whole does not depend on where the parts end.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally {
    /// W per metre of width.
    pub powers: Vec<f64>,
    /// A body, its force, N/m, the viscous part of that, and its added mass, kg/m.
    pub loads: Vec<(usize, [f64; 3])>,
    /// Entries, of eight pairs each, that passes for forces and for the flow have gone through and that
    /// are still to be counted.
    pub force_entries: usize,
    pub flow_entries: usize,
}

impl Tally {
    pub fn clear(&mut self) {
        self.powers.clear();
        self.loads.clear();
    }
}

/// The sum of all powers.
pub(super) fn power(parts: &[Part]) -> f64 {
    parts.iter().flat_map(|part| &part.tally.powers).fold(0.0, |sum, power| sum + power)
}

/// Up to so many particles go through each pass together where nobody shares the work: some 30 MB, for
/// which there is room in the caches of present processors. More water than that goes in parts.
pub const WHOLE_WATER: usize = 32_768;
/// Of more, a part has at most so many: their pairs, 0.8 MB, stay in the cache from one pass to the
/// next, and each field of theirs is still long enough to be read at full speed.
const CLUSTERS: usize = 256;

/// Cuts so many clusters into parts, as many as a team wants.
pub(super) fn cut(parts: &mut Vec<Part>, clusters: usize, team: &Team) {
    let count = match team.is_alone() {
        true if clusters * LANES <= WHOLE_WATER => 1,
        true => clusters.div_ceil(CLUSTERS),
        false => team.parts(),
    };
    parts.resize_with(count, Part::default);
    for (part, range) in parts.iter_mut().zip(team::cut(clusters, count)) {
        part.clusters = range;
        part.make_room();
    }
}
