//! The pairs in reach from the last full step, and sums over them.
//!
//! A pass over held pairs needs Σ_j g_ij f_j alone. Here f is one of a few numbers of the neighbour.
//! A sum over differences is two such sums:
//!
//! ```text
//! Σ g u_j (r_i - r_j) = r_i Σ g u_j - Σ g u_j r_j
//! ```
//!
//! So a pair costs one product per number, and no place is read again. Places are in support radii
//! from the scene's origin. So the difference loses two or three of sixteen digits.

use super::factors::Factors;
use super::pair_list::PairList;
use crate::math::simd::{LANES, Lanes, Task};

/// The geometry of a pair for later passes: g, the kernel's slope over q times the neighbour's
/// weight, a value per lane. Single precision halves the memory traffic. Its rounding, 6e-8 of each
/// term, is far below the accuracy of the sums.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub(super) struct Slopes(pub [f32; LANES]);

/// Neighbours in reach of a cluster. They are fewer than in its list, which has a margin and ghosts
/// without a weight.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldPairs {
    groups: usize,
    /// Ends of the groups of all clusters, after a zero.
    ends: Vec<u32>,
    entries: Vec<u32>,
    slopes: Vec<Slopes>,
}

impl HeldPairs {
    /// Reserves memory for all pairs of a list. If there was too little, it reserves a quarter
    /// more, for water that spreads a little.
    pub fn make_room(&mut self, pairs: &PairList) {
        if self.entries.len() < pairs.len() {
            let room = pairs.len() + pairs.len() / 4;
            self.entries.resize(room, 0);
            self.slopes.resize(room, Slopes::default());
        }
        let ends = pairs.clusters() * pairs.groups() + 1;
        self.ends.reserve(ends.saturating_sub(self.ends.len()));
    }

    /// Forgets all pairs, for clusters with this many groups.
    pub fn restart(&mut self, groups: usize) {
        self.groups = groups;
        self.ends.clear();
        self.ends.push(0);
    }

    /// Number of pairs, eight lanes each.
    pub fn len(&self) -> usize {
        self.ends.last().map_or(0, |&end| end as usize)
    }

    /// Memory for the next group's pairs, at most `count` of them.
    #[inline(always)]
    pub fn room(&mut self, count: usize) -> (&mut [u32], &mut [Slopes]) {
        let range = self.len()..self.len() + count;
        (&mut self.entries[range.clone()], &mut self.slopes[range])
    }

    /// Ends a group for which this many pairs were written.
    #[inline(always)]
    pub fn close(&mut self, count: usize) {
        self.ends.push((self.len() + count) as u32);
    }

    /// The pairs of a cluster within a group.
    #[inline(always)]
    pub fn group(&self, cluster: usize, group: usize) -> (&[u32], &[Slopes]) {
        let at = cluster * self.groups + group;
        let range = self.ends[at] as usize..self.ends[at + 1] as usize;
        (&self.entries[range.clone()], &self.slopes[range])
    }
}

/// Slopes are prefetched this many entries ahead. All of them together do not fit into a core's own
/// caches, and they are read in order.
pub(super) const AHEAD: usize = 64;

/// Prefetches the numbers of neighbours that the fourth cluster from here is the first to reach.
/// Neighbours are numbered strip by strip and listed in order. So the last of a list lies in the
/// farthest strip, the only one of which nothing has been read yet.
#[inline(always)]
pub(super) fn prefetch_first_reached<L: Lanes, T>(all: &[T], entries: &[u32]) {
    if let Some(&last) = entries.last() {
        for next in 4 * LANES..5 * LANES {
            L::prefetch(&all[last as usize], next);
        }
    }
}

/// Σ_j g_ij f_jn over a cluster's pairs in one group, for the first `N` factors.
pub(super) struct Product<'a, const N: usize> {
    pub pairs: &'a HeldPairs,
    pub factors: &'a [Factors],
    pub cluster: usize,
    pub group: usize,
}

impl<const N: usize> Product<'_, N> {
    #[inline(always)]
    fn sums<L: Lanes>(self) -> [L; N] {
        let (entries, slopes) = self.pairs.group(self.cluster, self.group);
        prefetch_first_reached::<L, _>(self.factors, entries);
        // Two sums each, in turns: a single one would wait for its own additions.
        let mut even = [L::splat(0.0); N];
        let mut odd = [L::splat(0.0); N];
        let (entries, last) = entries.as_chunks::<2>();
        let (slopes, last_slope) = slopes.as_chunks::<2>();
        for (&[a, b], [slope_a, slope_b]) in entries.iter().zip(slopes) {
            L::prefetch(slope_a, AHEAD);
            let (factors_a, factors_b) = (&self.factors[a as usize].0, &self.factors[b as usize].0);
            let (g_a, g_b) = (L::load_single(&slope_a.0), L::load_single(&slope_b.0));
            for n in 0..N {
                even[n] = g_a.mul_add(L::splat(factors_a[n]), even[n]);
                odd[n] = g_b.mul_add(L::splat(factors_b[n]), odd[n]);
            }
        }
        for (&j, slope) in last.iter().zip(last_slope) {
            let factors = &self.factors[j as usize].0;
            let g = L::load_single(&slope.0);
            for n in 0..N {
                even[n] = g.mul_add(L::splat(factors[n]), even[n]);
            }
        }
        for n in 0..N {
            even[n] += odd[n];
        }
        even
    }
}

impl<const N: usize> Task for Product<'_, N> {
    type Output = [[f64; LANES]; N];

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let found = self.sums::<L>();
        let mut sums = [[0.0; LANES]; N];
        for n in 0..N {
            found[n].store(&mut sums[n]);
        }
        sums
    }
}

/// A product whose sums are added to others.
pub(super) struct Added<'a, 'b, const N: usize> {
    pub product: Product<'a, N>,
    pub sums: &'b mut [[f64; LANES]; 8],
}

impl<const N: usize> Task for Added<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let found = self.product.sums::<L>();
        for (sum, found) in self.sums.iter_mut().zip(found) {
            (L::load(sum) + found).store(sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::{SimdPath, dispatch};

    #[test]
    fn products_are_the_sums_that_they_stand_for() {
        let mut pairs = HeldPairs {
            entries: vec![0; 8],
            slopes: vec![Slopes::default(); 8],
            ..Default::default()
        };
        pairs.restart(2);
        let value = |k: usize| (k as f64 * 0.618_034).fract() - 0.4;
        for count in [2, 0, 5, 1] {
            let (entries, slopes) = pairs.room(count);
            for (k, (entry, slope)) in entries.iter_mut().zip(slopes).take(count).enumerate() {
                *entry = (count + k) as u32 % 4;
                slope.0 = std::array::from_fn(|lane| value(lane + 8 * k + count) as f32);
            }
            pairs.close(count);
        }
        assert_eq!(pairs.len(), 8);
        let factors: Vec<Factors> =
            (0..4).map(|j| Factors(std::array::from_fn(|n| value(3 * j + n)))).collect();
        for (cluster, group) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (entries, slopes) = pairs.group(cluster, group);
            for path in [SimdPath::Portable, SimdPath::widest()] {
                let task = Product::<8> { pairs: &pairs, factors: &factors, cluster, group };
                let sums = dispatch(path, task);
                for (n, sums) in sums.iter().enumerate() {
                    for (lane, sum) in sums.iter().enumerate() {
                        let terms = entries
                            .iter()
                            .zip(slopes)
                            .map(|(&j, slope)| f64::from(slope.0[lane]) * factors[j as usize].0[n]);
                        assert!((terms.sum::<f64>() - sum).abs() < 1e-15);
                    }
                }
            }
        }
    }
}
