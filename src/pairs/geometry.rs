//! The geometry of pairs, found before the sums that need it.
//!
//! 1/q takes a long chain of dependent products. A loop that only finds 1/q for many neighbours
//! overlaps more of these chains than a loop that also forms the sums.

use std::marker::PhantomData;
use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{Lanes, Task, Vector};

use super::precision::Neighbour;
use super::record::Record;

/// Number of neighbours taken at a time: the bits of a word.
pub(super) const CHUNK: usize = u64::BITS as usize;

/// Smaller squared distances (in support radii) are replaced by this: a particle and itself.
pub(super) const COINCIDENT: f64 = 1e-12;

/// Pairs of eight particles with one neighbour.
#[derive(Debug, Clone, Copy)]
pub struct Pair<R> {
    /// x of Δ = (r_i - r_j)/R; of [`Near`](super::Near) Δ is in metres.
    pub dx: R,
    /// Its y.
    pub dy: R,
    /// For divisions by q² = |Δ|²: see [`Pair::over_square`].
    pub(super) divisor: R,
    /// g, the kernel's slope over q times the neighbour's weight.
    pub(super) slope: R,
}

impl<R: Vector> Pair<R> {
    /// Pairs whose slope is known.
    #[inline(always)]
    pub(super) fn weighed(dx: R, dy: R, slope: R) -> Pair<R> {
        let square = dx.mul_add(dx, dy.mul_add(dy, R::splat(COINCIDENT)));
        Pair { dx, dy, divisor: square.divisor(square.roots()), slope }
    }

    /// V_j ∇_iW_ij = g Δ.
    #[inline(always)]
    pub fn gradient(&self) -> [R; 2] {
        [self.slope * self.dx, self.slope * self.dy]
    }

    /// g: the gradient over Δ.
    #[inline(always)]
    pub fn slope(&self) -> R {
        self.slope
    }

    /// Δ|², and slightly more, so that it is not zero for a particle and itself.
    #[inline(always)]
    pub fn square(&self) -> R {
        let Pair { dx, dy, .. } = *self;
        dx.mul_add(dx, dy.mul_add(dy, R::splat(COINCIDENT)))
    }

    /// The value over |Δ|², to a few units in the last place.
    #[inline(always)]
    pub fn over_square(&self, value: R) -> R {
        value.over(self.divisor)
    }
}

/// The geometry of a chunk of pairs.
pub(super) struct Geometry<R>([MaybeUninit<Pair<R>>; CHUNK]);

impl<R: Vector> Geometry<R> {
    #[inline(always)]
    pub(super) fn new() -> Geometry<R> {
        Geometry([const { MaybeUninit::uninit() }; CHUNK])
    }

    /// The pairs in reach for one turn. With two turns each gets every other pair.
    #[inline(always)]
    pub(super) fn visit(&self, in_reach: InReach, turn: usize) -> Visits<'_, R> {
        let mut mask = in_reach.0;
        if R::TURNS > 1 {
            // Bit k of the parities tells whether an odd number of bits up to it are set.
            let mut parities = mask;
            for shift in [1, 2, 4, 8, 16, 32] {
                parities ^= parities << shift;
            }
            mask &= if turn == 0 { parities } else { !parities };
        }
        Visits { pairs: &self.0, mask }
    }
}

/// Which pairs of a chunk are in reach: bit k for number k. Only [`Fill`] makes it, for pairs that
/// it has written.
#[derive(Clone, Copy)]
pub(super) struct InReach(u64);

impl InReach {
    /// How many.
    #[inline(always)]
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }
}

/// Finds the geometry of up to [`CHUNK`] neighbours of eight places, and which of them are in reach
/// of at least one place. Ghosts without a weight are not.
///
/// All are written, each to its own place. If a place depended on how many earlier ones are in
/// reach, later loads would have to wait for that.
pub(super) struct Fill<'a, K, R, N> {
    geometry: &'a mut Geometry<R>,
    places: [[R; 2]; 2],
    neighbours: &'a [u32],
    records: &'a [N],
    kernel: PhantomData<K>,
}

impl<'a, K, R, N> Fill<'a, K, R, N> {
    #[inline(always)]
    pub fn new(
        geometry: &'a mut Geometry<R>,
        places: [[R; 2]; 2],
        neighbours: &'a [u32],
        records: &'a [N],
    ) -> Self {
        Fill { geometry, places, neighbours, records, kernel: PhantomData }
    }
}

impl<K: Kernel, R: Vector, N: Neighbour> Task for Fill<'_, K, R, N> {
    type Output = InReach;

    #[inline(always)]
    fn run<L: Lanes>(self) -> InReach {
        let Fill { geometry, places, neighbours, records, .. } = self;
        let mut mask = 0;
        for (k, (&j, room)) in neighbours.iter().zip(&mut geometry.0).enumerate() {
            let record = &records[j as usize];
            let [dx, dy] = record.apart(places);
            let s = dx.mul_add(dx, dy.mul_add(dy, R::splat(COINCIDENT)));
            let roots = s.roots();
            let slope = K::slope_over_q(s, roots) * R::splat(record.slot(Record::WEIGHT));
            let divisor = s.divisor(roots);
            room.write(Pair { dx, dy, divisor, slope });
            let counts = s.any_less(R::splat(1.0)) & record.counts();
            mask |= u64::from(counts) << k;
        }
        InReach(mask)
    }
}

/// Pairs in reach with their numbers in the chunk.
pub(super) struct Visits<'a, R> {
    pairs: &'a [MaybeUninit<Pair<R>>; CHUNK],
    mask: u64,
}

impl<R: Vector> Iterator for Visits<'_, R> {
    type Item = (usize, Pair<R>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.mask == 0 {
            return None;
        }
        let k = self.mask.trailing_zeros() as usize;
        self.mask &= self.mask - 1;
        // SAFETY: the mask has the bits of pairs that `Fill` has written.
        Some((k, unsafe { self.pairs.get_unchecked(k).assume_init_read() }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::WendlandC2;
    use crate::math::simd::{LANES, SimdPath, dispatch};
    use crate::pairs::SingleRecord;

    /// Neighbours on a line, one tenth of R apart: which are visited, how often, and how far away
    /// along x, in double precision, then in single.
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
        let in_reach = L::call(Fill::<WendlandC2, V, N>::new(&mut geometry, places, numbers, all));
        let mut found = Vec::new();
        for turn in 0..V::TURNS {
            for (number, pair) in geometry.visit(in_reach, turn) {
                let mut dx = [0.0; LANES];
                pair.dx.store_single(&mut dx);
                found.push((number, dx[0]));
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
