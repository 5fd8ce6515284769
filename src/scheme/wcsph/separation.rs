//! Geometry of pairs, ahead of the sums that need it.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes};

use super::precision::Neighbour;

/// Neighbours that are taken at a time: as many as a word has bits.
pub(super) const CHUNK: usize = u64::BITS as usize;

/// Squared distances below this (in support radii) count as this: a particle and itself.
pub(super) const COINCIDENT: f64 = 1e-12;

/// A neighbour as seen from eight particles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<V> {
    /// Δ = r_i - r_j over R.
    pub dx: V,
    /// Its y.
    pub dy: V,
    /// 1/q².
    pub inverse_s: V,
    /// g, the kernel's slope over q times the neighbour's weight.
    pub slope: V,
}

/// The geometry of a chunk of pairs.
pub(super) struct Geometry<V>([MaybeUninit<Pair<V>>; CHUNK]);

impl<V: Lanes> Geometry<V> {
    /// Room for a chunk.
    #[inline(always)]
    pub(super) fn new() -> Geometry<V> {
        Geometry([const { MaybeUninit::uninit() }; CHUNK])
    }

    /// The geometry of up to [`CHUNK`] neighbours of eight places; those in reach of one of them are
    /// to be visited. Ghosts without a weight are not.
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
        for (k, (&j, pair)) in neighbours.iter().zip(&mut self.0).enumerate() {
            let record = &records[j as usize];
            let [dx, dy] = record.apart(places);
            let s = dx.mul_add(dx, dy.mul_add(dy, V::splat(COINCIDENT)));
            let inverse_q = s.rsqrt();
            let slope = K::slope_over_q(s, inverse_q) * record.weight();
            let inverse_s = inverse_q * inverse_q;
            pair.write(Pair { dx, dy, inverse_s, slope });
            let counts = s.any_less(V::splat(1.0)) & (FLUID || record.counts());
            mask |= u64::from(counts) << k;
        }
        InReach { pairs: &self.0, mask }
    }
}

/// The pairs in reach among a chunk, with their numbers in it.
pub(super) struct InReach<'a, V> {
    pairs: &'a [MaybeUninit<Pair<V>>; CHUNK],
    /// Bit k for number k. Only pairs that are written have one.
    mask: u64,
}

impl<'a, V> Iterator for InReach<'a, V> {
    type Item = (usize, &'a Pair<V>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.mask == 0 {
            return None;
        }
        let k = self.mask.trailing_zeros() as usize;
        self.mask &= self.mask - 1;
        // SAFETY: bits are set by `fill` for pairs that it has written.
        Some((k, unsafe { self.pairs[k % CHUNK].assume_init_ref() }))
    }
}

/// Eight values of a field.
#[inline(always)]
pub(super) fn lanes<L: Lanes>(field: &[f64], at: usize) -> L {
    L::load(field[at..at + LANES].first_chunk().unwrap())
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
