//! The clusters in parts: pieces of work for the threads.

use std::ops::Range;

use super::fields::Here;
use super::held::HeldPairs;
use super::pair_list::{PairList, PointSet, build_pair_list};
use crate::math::simd::{LANES, Lanes, SimdPath};
use crate::math::team::{self, Team};

/// Consecutive clusters with their neighbours. In lists clusters are counted from the first of the
/// part.
#[derive(Debug, Clone, Default)]
pub(super) struct Part {
    pub(super) clusters: Range<usize>,
    /// Neighbours in reach, or soon in reach.
    pub(super) pairs: PairList,
    /// The pairs in reach, from the last full step.
    pub(super) held: HeldPairs,
    /// Σ g Δ of each cluster with the ghosts of each body that it has in reach, along x and y.
    pub(super) near: Vec<[[f64; LANES]; 2]>,
    /// The part's contributions to sums over all.
    pub tally: Tally,
}

impl Part {
    /// Its particles, padding included.
    pub fn lanes(&self) -> Range<usize> {
        self.clusters.start * LANES..self.clusters.end * LANES
    }

    /// Lists the neighbours of its particles among some sets. `places` are those of all particles.
    pub fn list(&mut self, path: SimdPath, places: [&[f64]; 2], sets: &[PointSet<'_>]) {
        let lanes = self.lanes();
        let [x, y] = places.map(|places| &places[lanes.clone()]);
        build_pair_list(path, x, y, sets, &mut self.pairs);
        self.held.make_room(&self.pairs);
    }

    /// Reserves memory for the results of its clusters, so that steps allocate none. At most one
    /// cluster in four comes near enough to a wall to respond to it.
    fn make_room(&mut self) {
        let Tally { powers, added, responding, .. } = &mut self.tally;
        let clusters = self.clusters.len();
        added.reserve(clusters.saturating_sub(added.len()));
        powers.reserve(clusters.saturating_sub(powers.len()));
        responding.reserve(clusters.div_ceil(4).saturating_sub(responding.len()));
    }
}

impl team::Part for Part {
    fn items(&self) -> Range<usize> {
        self.clusters.clone()
    }
}

/// The contributions of a part's clusters to sums over all. They are added one by one in the order
/// of the clusters, so that the result does not depend on the parts.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    /// W per metre of width.
    pub(super) powers: Vec<f64>,
    /// Contribution of each cluster to the sum of a pass.
    pub(super) added: Vec<[f64; LANES]>,
    /// A body, its force, N/m, the viscous part of that, and its added mass, kg/m.
    pub loads: Vec<(usize, [f64; 3])>,
    /// Clusters whose acceleration responds to the wall's, with the response per lane.
    pub(super) responding: Vec<(u32, [[f64; LANES]; 2])>,
    /// Number of entries, of eight pairs each, in passes for forces and for the flow, since they
    /// were last counted.
    pub(super) force_entries: usize,
    pub(super) flow_entries: usize,
}

impl Tally {
    /// Adds the power of some particles, W per metre of width.
    #[inline(always)]
    pub fn add_power<D: Lanes>(&mut self, power: D) {
        self.powers.push(power.sum());
    }

    /// Records the response of these accelerations to the wall's.
    #[inline(always)]
    pub fn respond<D: Lanes>(&mut self, here: Here, [x, y]: [D; 2]) {
        self.responding.push((here.cluster(), [x.to_array(), y.to_array()]));
    }

    /// Adds to accelerations the effect of an acceleration of the wall, m/s².
    pub fn add_responses(&self, wall: f64, [x, y]: [&mut [f64]; 2]) {
        for (cluster, response) in &self.responding {
            let at = *cluster as usize * LANES;
            for lane in 0..LANES {
                x[at + lane] += wall * response[0][lane];
                y[at + lane] += wall * response[1][lane];
            }
        }
    }

    pub(super) fn clear(&mut self) {
        self.powers.clear();
        self.loads.clear();
    }
}

/// Cuts this many clusters into as many parts as the team wants.
pub(super) fn cut(parts: &mut Vec<Part>, clusters: usize, team: &Team) {
    let count = team.parts();
    parts.resize_with(count, Part::default);
    for (part, range) in parts.iter_mut().zip(team::cut(clusters, count)) {
        part.clusters = range;
        part.make_room();
    }
}
