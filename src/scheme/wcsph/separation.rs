//! Geometry of pairs, ahead of the sums that need it.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes};

use super::held::{AHEAD, Slopes};
use super::precision::Neighbour;

/// Neighbours that are taken at a time.
pub(super) const CHUNK: usize = 32;

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

    /// The geometry of those of up to [`CHUNK`] neighbours of eight places that are in reach of one
    /// of them; their numbers and slopes go to `entries` and `slopes`. Ghosts without a weight do
    /// not count.
    #[inline(always)]
    pub(super) fn fill<K: Kernel, N: Neighbour, const FLUID: bool>(
        &mut self,
        places: [[V; 2]; 2],
        neighbours: &[u32],
        records: &[N],
        (entries, slopes): (&mut [u32], &mut [Slopes]),
    ) -> &[Pair<V>] {
        let limit = CHUNK.min(entries.len()).min(slopes.len());
        let mut count = 0;
        for &j in neighbours {
            if count >= limit {
                break; // Never: it tells the compiler where `count` may lie.
            }
            let record = &records[j as usize];
            let [dx, dy] = record.apart(places);
            let s = dx.mul_add(dx, dy.mul_add(dy, V::splat(COINCIDENT)));
            let inverse_q = s.rsqrt();
            let slope = K::slope_over_q(s, inverse_q) * record.weight();
            entries[count] = j;
            V::prefetch(&slopes[count], AHEAD);
            slope.store_single(&mut slopes[count].0);
            let inverse_s = inverse_q * inverse_q;
            self.0[count].write(Pair { dx, dy, inverse_s, slope });
            let counts = s.any_less(V::splat(1.0)) & (FLUID || record.counts());
            count += usize::from(counts);
        }
        // SAFETY: the loop above has written the first `count` entries.
        unsafe { std::slice::from_raw_parts(self.0.as_ptr().cast(), count) }
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
