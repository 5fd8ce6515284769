//! Lists of neighbours, one for every cluster of eight points.

use std::ops::Range;

use super::strips::Strips;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};

/// Neighbours of clusters of eight points, in groups: the fluid, then each body's ghosts.
#[derive(Debug, Clone, Default)]
pub struct PairList {
    groups: usize,
    offsets: Vec<u32>,
    /// May be longer than the entries in use.
    entries: Vec<u32>,
}

impl PairList {
    /// Number of clusters.
    pub fn clusters(&self) -> usize {
        self.offsets.len().saturating_sub(1).checked_div(self.groups).unwrap_or(0)
    }

    /// Neighbours of a cluster within a group.
    #[inline(always)]
    pub fn group(&self, cluster: usize, group: usize) -> &[u32] {
        let at = cluster * self.groups + group;
        &self.entries[self.offsets[at] as usize..self.offsets[at + 1] as usize]
    }

    /// Index of the first entry of a cluster's group, also for parallel arrays.
    #[inline(always)]
    pub fn start(&self, cluster: usize, group: usize) -> usize {
        self.offsets[cluster * self.groups + group] as usize
    }

    /// Indices of the entries of all groups of a cluster.
    #[inline(always)]
    pub fn range(&self, cluster: usize) -> Range<usize> {
        let at = cluster * self.groups;
        self.offsets[at] as usize..self.offsets[at + self.groups] as usize
    }

    /// All entries, cluster by cluster.
    #[inline(always)]
    pub fn entries(&self) -> &[u32] {
        &self.entries[..self.len()]
    }

    /// Number of groups of a cluster.
    pub fn groups(&self) -> usize {
        self.groups
    }

    /// All entries.
    pub fn len(&self) -> usize {
        self.offsets.last().map_or(0, |&end| end as usize)
    }

    /// True where nothing has a neighbour.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Points that may be neighbours: the fluid, a body's ghosts, its images.
#[derive(Debug, Clone, Copy)]
pub struct PointSet<'a> {
    /// Where they lie.
    pub strips: &'a Strips,
    /// x in the set's own frame.
    pub x: &'a [f64],
    /// y.
    pub y: &'a [f64],
    /// x of the frame's origin.
    pub offset: f64,
    /// Number of the set's first point among all neighbours.
    pub first: u32,
    /// Points closer than this to any lane are listed; same unit as x.
    pub reach: f64,
    /// The box of the points: x from, x to, y from, y to. Clusters far from it are skipped.
    pub bounds: [f64; 4],
}

impl PointSet<'_> {
    /// Bounds that skip no cluster.
    pub const EVERYWHERE: [f64; 4] =
        [f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
}

/// Lists, for every cluster of eight targets, the points of each set within its reach.
pub fn build_pair_list(
    path: SimdPath,
    target_x: &[f64],
    target_y: &[f64],
    sets: &[PointSet<'_>],
    list: &mut PairList,
) {
    list.groups = sets.len();
    list.offsets.clear();
    list.offsets.push(0);
    dispatch(path, Build { target_x, target_y, sets, list });
}

struct Build<'a> {
    target_x: &'a [f64],
    target_y: &'a [f64],
    sets: &'a [PointSet<'a>],
    list: &'a mut PairList,
}

impl Task for Build<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (xs, _) = self.target_x.as_chunks::<LANES>();
        let (ys, _) = self.target_y.as_chunks::<LANES>();
        let PairList { entries, offsets, .. } = self.list;
        let mut count = 0;
        for (lane_x, lane_y) in xs.iter().zip(ys) {
            let [left, right] = extent(lane_x);
            let [bottom, top] = extent(lane_y);
            for set in self.sets {
                let (x, y) = (L::load(lane_x) - L::splat(set.offset), L::load(lane_y));
                let x_box = [left - set.offset - set.reach, right - set.offset + set.reach];
                let y_box = [bottom - set.reach, top + set.reach];
                let [x_from, x_to, y_from, y_to] = set.bounds;
                let near = x_box[1] >= x_from
                    && x_box[0] <= x_to
                    && y_box[1] >= y_from
                    && y_box[0] <= y_to;
                if near {
                    let reach = L::splat(set.reach * set.reach);
                    set.strips.visit_box(x_box, y_box, |range| {
                        if entries.len() < count + range.len() {
                            entries.resize(2 * (count + range.len()), 0);
                        }
                        let room = &mut entries[count..count + range.len()];
                        let places = set.x[range.clone()].iter().zip(&set.y[range.clone()]);
                        let mut found = 0;
                        // Every candidate is written. If it is too far, the next one overwrites it.
                        // Half of them are too far, and no processor can predict which.
                        for (k, (&point_x, &point_y)) in range.zip(places) {
                            room[found] = set.first + k as u32;
                            let (dx, dy) = (x - L::splat(point_x), y - L::splat(point_y));
                            found += usize::from(dx.mul_add(dx, dy * dy).any_less(reach));
                        }
                        count += found;
                    });
                }
                offsets.push(count as u32);
            }
        }
    }
}

#[inline(always)]
fn extent(values: &[f64; LANES]) -> [f64; 2] {
    values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| [low.min(v), high.max(v)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scatter(count: u32, seed: f64) -> (Vec<f64>, Vec<f64>) {
        (0..count)
            .map(|k| f64::from(k) + seed)
            .map(|k| ((k * 0.618_033_988).fract() * 2.0, (k * 0.754_877_666).fract()))
            .unzip()
    }

    /// Sorted copies of the points with their strips.
    fn sorted(x: &[f64], y: &[f64]) -> (Strips, Vec<f64>, Vec<f64>) {
        let ties: Vec<u32> = (0..x.len() as u32).collect();
        let (strips, order) = Strips::sort(x, y, &ties, 0.1);
        let pick = |field: &[f64]| order.iter().map(|&k| field[k as usize]).collect::<Vec<_>>();
        let (x, y) = (pick(x), pick(y));
        (strips, x, y)
    }

    #[test]
    fn lists_hold_what_brute_force_finds_on_every_path() {
        let (fx, fy) = scatter(400, 0.0);
        let (fluid, fx, fy) = sorted(&fx, &fy);
        let (gx, gy) = scatter(150, 0.37);
        let (ghosts, gx, gy) = sorted(&gx, &gy);
        let bounds = PointSet::EVERYWHERE;
        let (x, y) = (&fx[..], &fy[..]);
        let water = PointSet { strips: &fluid, x, y, offset: 0.0, first: 0, reach: 0.2, bounds };
        let (strips, x, y) = (&ghosts, &gx[..], &gy[..]);
        let sets = [water, PointSet { strips, x, y, offset: 0.5, first: 400, reach: 0.3, bounds }];
        for path in [SimdPath::Portable, SimdPath::Avx2, SimdPath::Avx512] {
            if !path.is_supported() {
                continue;
            }
            let mut list = PairList::default();
            build_pair_list(path, &fx, &fy, &sets, &mut list);
            assert_eq!(list.clusters(), 50);
            for cluster in 0..list.clusters() {
                let lanes = cluster * LANES..(cluster + 1) * LANES;
                for (group, set) in sets.iter().enumerate() {
                    let expected: Vec<u32> = (0..set.x.len())
                        .filter(|&k| {
                            lanes.clone().any(|i| {
                                let dx = fx[i] - set.x[k] - set.offset;
                                let dy = fy[i] - set.y[k];
                                dx * dx + dy * dy < set.reach * set.reach
                            })
                        })
                        .map(|k| set.first + k as u32)
                        .collect();
                    let mut found = list.group(cluster, group).to_vec();
                    found.sort_unstable();
                    assert_eq!(found, expected, "{path:?} cluster {cluster} group {group}");
                }
            }
        }
    }
}
