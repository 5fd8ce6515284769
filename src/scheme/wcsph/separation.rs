//! Geometry of pairs, ahead of the sums that need it.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes};
use crate::particles::Record;

use super::held::Slopes;

/// Neighbours that are taken at a time.
pub(super) const CHUNK: usize = 32;

/// Squared distances below this (in support radii) count as this: a particle and itself.
pub(super) const COINCIDENT: f64 = 1e-12;

/// A neighbour as seen from eight particles.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Pair {
    /// Δ = r_i - r_j over R.
    pub dx: [f64; LANES],
    /// Its y.
    pub dy: [f64; LANES],
    /// 1/q².
    pub inverse_s: [f64; LANES],
    /// g, the kernel's slope over q times the neighbour's weight.
    pub slope: [f64; LANES],
}

/// The geometry of a chunk of pairs.
pub(super) struct Geometry([MaybeUninit<Pair>; CHUNK]);

impl Geometry {
    /// Room for a chunk.
    #[inline(always)]
    pub(super) fn new() -> Geometry {
        Geometry([const { MaybeUninit::uninit() }; CHUNK])
    }

    /// The geometry of those of up to [`CHUNK`] neighbours of the points (x, y) that are in reach
    /// of one of them; their numbers and slopes go to `entries` and `slopes`. Ghosts without a
    /// weight do not count.
    #[inline(always)]
    pub(super) fn fill<K: Kernel, L: Lanes, const FLUID: bool>(
        &mut self,
        x: L,
        y: L,
        neighbours: &[u32],
        records: &[Record],
        (entries, slopes): (&mut [u32], &mut [Slopes]),
    ) -> &[Pair] {
        let limit = CHUNK.min(entries.len()).min(slopes.len());
        let mut count = 0;
        for &j in neighbours {
            if count >= limit {
                break; // Never: it tells the compiler where `count` may lie.
            }
            let record = &records[j as usize].0;
            let dx = x - L::splat(record[Record::X]);
            let dy = y - L::splat(record[Record::Y]);
            let s = dx.mul_add(dx, dy.mul_add(dy, L::splat(COINCIDENT)));
            let inverse_q = s.rsqrt();
            let g = K::slope_over_q(s, inverse_q) * L::splat(record[Record::WEIGHT]);
            entries[count] = j;
            g.store_single(&mut slopes[count].0);
            let pair = self.0[count].as_mut_ptr();
            // SAFETY: the pointer is to a whole `Pair`, whose fields are written one by one; any
            // bits are a valid array of numbers.
            unsafe {
                dx.store(&mut (*pair).dx);
                dy.store(&mut (*pair).dy);
                (inverse_q * inverse_q).store(&mut (*pair).inverse_s);
                g.store(&mut (*pair).slope);
            }
            let counts = s.any_less(L::splat(1.0)) & (FLUID || record[Record::WEIGHT] != 0.0);
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
