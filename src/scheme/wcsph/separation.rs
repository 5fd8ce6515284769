//! Geometry of pairs, ahead of the sums that need it.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Vector};

use super::precision::Neighbour;

/// Neighbours that are taken at a time: as many as a word has bits.
pub(super) const CHUNK: usize = u64::BITS as usize;

/// Squared distances below this (in support radii) count as this: a particle and itself.
pub(super) const COINCIDENT: f64 = 1e-12;

/// Neighbours as seen from eight particles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<V> {
    /// Δ = r_i - r_j over R.
    pub dx: V,
    /// Its y.
    pub dy: V,
    /// To divide by q²: see [`over`](crate::math::simd::Vector::over).
    pub divisor: V,
    /// g, the kernel's slope over q times the neighbour's weight.
    pub slope: V,
}

/// The geometry of a chunk of pairs.
pub(super) struct Geometry<V>([MaybeUninit<Pair<V>>; CHUNK]);

impl<V: Vector> Geometry<V> {
    /// Room for a chunk.
    #[inline(always)]
    pub(super) fn new() -> Geometry<V> {
        Geometry([const { MaybeUninit::uninit() }; CHUNK])
    }

    /// Finds the geometry of up to [`CHUNK`] neighbours of eight places and tells which are in reach of
    /// one of them. Ghosts without a weight are not.
    ///
    /// All are written, each to its own place: a place that depended on how many before it are in
    /// reach would keep later loads waiting for that.
    #[inline(always)]
    pub(super) fn fill<K: Kernel, N: Neighbour, const FLUID: bool>(
        &mut self,
        places: [[V; 2]; 2],
        neighbours: &[u32],
        records: &[N],
    ) -> InReach<'_, V> {
        let mut mask = 0;
        for (k, (&j, room)) in neighbours.iter().zip(&mut self.0).enumerate() {
            let record = &records[j as usize];
            let [dx, dy] = record.apart(places);
            let s = dx.mul_add(dx, dy.mul_add(dy, V::splat(COINCIDENT)));
            let roots = s.roots();
            let slope = K::slope_over_q(s, roots) * record.weight();
            let divisor = s.divisor(roots);
            room.write(Pair { dx, dy, divisor, slope });
            let counts = s.any_less(V::splat(1.0)) & (FLUID || record.counts());
            mask |= u64::from(counts) << k;
        }
        InReach { pairs: &self.0, mask }
    }
}

/// The pairs in reach among a chunk.
#[derive(Clone, Copy)]
pub(super) struct InReach<'a, V> {
    pairs: &'a [MaybeUninit<Pair<V>>; CHUNK],
    /// Bit k for number k. Only pairs that are written have one.
    mask: u64,
}

impl<'a, V: Vector> InReach<'a, V> {
    /// How many.
    #[inline(always)]
    pub(super) fn len(self) -> usize {
        self.mask.count_ones() as usize
    }

    /// Those to be visited in a turn: of two turns, every other one each.
    #[inline(always)]
    pub(super) fn turn(self, turn: usize) -> Visits<'a, V> {
        let mut mask = self.mask;
        if V::TURNS > 1 {
            // Bit k of the parities tells whether an odd number of bits are set up to it.
            let mut parities = mask;
            for shift in [1, 2, 4, 8, 16, 32] {
                parities ^= parities << shift;
            }
            mask &= if turn == 0 { parities } else { !parities };
        }
        Visits(InReach { mask, ..self })
    }
}

/// Pairs in reach with their numbers in the chunk.
pub(super) struct Visits<'a, V>(InReach<'a, V>);

impl<V: Vector> Iterator for Visits<'_, V> {
    type Item = (usize, Pair<V>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let InReach { pairs, mask } = &mut self.0;
        if *mask == 0 {
            return None;
        }
        let k = mask.trailing_zeros() as usize;
        *mask &= *mask - 1;
        // SAFETY: bits are set by `fill`, for pairs that it has written.
        Some((k, unsafe { pairs.get_unchecked(k).assume_init_read() }))
    }
}

/// Eight values of a field.
#[inline(always)]
pub(super) fn eight(field: &[f64], at: usize) -> &[f64; LANES] {
    field[at..at + LANES].first_chunk().unwrap()
}

/// Eight values of a field in a vector.
#[inline(always)]
pub(super) fn lanes<L: Lanes>(field: &[f64], at: usize) -> L {
    L::load(eight(field, at))
}

/// Eight values of each field. (A map over the array would be a function of its own, compiled
/// without the path's instructions.)
#[inline(always)]
pub(super) fn all_lanes<L: Lanes, const N: usize>(fields: [&[f64]; N], at: usize) -> [L; N] {
    let mut values = [L::splat(0.0); N];
    for n in 0..N {
        values[n] = lanes(fields[n], at);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::WendlandC2;
    use crate::math::simd::{SimdPath, Task, dispatch};
    use crate::particles::{Record, SingleRecord};
    use crate::scheme::wcsph::held::Slopes;

    /// Which of neighbours on a line, one tenth of R apart, are visited, how often, and how far away
    /// along x; in double precision, then in single.
    struct Visited(usize);

    impl Task for Visited {
        type Output = [Vec<(usize, f32)>; 2];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let numbers: Vec<u32> = (0..self.0 as u32).collect();
            let at = |j: &u32| {
                let mut record = Record::default();
                record.0[Record::X] = f64::from(*j) * 0.1 - 1.55;
                record.0[Record::WEIGHT] = 1.0;
                record
            };
            let records: Vec<Record> = numbers.iter().map(at).collect();
            let singles: Vec<SingleRecord> =
                records.iter().map(|r| SingleRecord::new::<L>(r, [0.0; 2], 0.0)).collect();
            [
                visited::<L, L, Record>(&numbers, &records),
                visited::<L, L::Single, SingleRecord>(&numbers, &singles),
            ]
        }
    }

    #[inline(always)]
    fn visited<L: Lanes, V: Vector, N: Neighbour>(numbers: &[u32], all: &[N]) -> Vec<(usize, f32)> {
        let origin = [0.0; LANES];
        let mut geometry = Geometry::<V>::new();
        let places = N::places::<L, V>(&origin, &origin);
        let in_reach = geometry.fill::<WendlandC2, N, true>(places, numbers, all);
        let mut found = Vec::new();
        for turn in 0..V::TURNS {
            for (number, pair) in in_reach.turn(turn) {
                let mut dx = Slopes::default();
                pair.dx.store_single(&mut dx.0);
                found.push((number, dx.0[0]));
            }
        }
        assert_eq!(found.len(), in_reach.len());
        found
    }

    #[test]
    fn each_neighbour_in_reach_is_visited_once() {
        // Of 31 in a row the inner 20 are in reach, of 24 only 19.
        for (count, last) in [(CHUNK, 25), (31, 25), (24, 23), (7, 6)] {
            for path in [SimdPath::Portable, SimdPath::Avx2, SimdPath::Avx512] {
                if !path.is_supported() {
                    continue;
                }
                for mut found in dispatch(path, Visited(count)) {
                    found.sort_by_key(|&(number, _)| number);
                    let expected: Vec<usize> = (6..=last).collect();
                    let numbers: Vec<usize> = found.iter().map(|&(number, _)| number).collect();
                    assert_eq!(numbers, expected, "{path:?} {count}");
                    for (number, dx) in found {
                        assert!((dx - (1.55 - 0.1 * number as f32)).abs() < 1e-6);
                    }
                }
            }
        }
    }
}
