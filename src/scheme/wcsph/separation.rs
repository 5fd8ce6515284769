//! Geometry of pairs, ahead of the sums that need it.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes};
use crate::particles::Record;

/// Neighbours that are taken at a time.
pub(super) const CHUNK: usize = 32;

/// Squared distances below this (in support radii) count as this: a particle and itself.
pub(super) const COINCIDENT: f64 = 1e-12;

/// What the passes after the first read of a pair's geometry: g, the kernel's slope over q times
/// the neighbour's weight, a value per lane. Single precision halves the traffic; its rounding,
/// 6e-8 of each term, is far below what the sums are accurate to.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub(super) struct Slopes(pub [f32; LANES]);

/// A neighbour as seen from eight particles.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Pair {
    /// 1/q².
    pub inverse_s: [f64; LANES],
    /// g, as in [`Slopes`].
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

    /// The geometry of up to [`CHUNK`] neighbours of the points (x, y).
    #[inline(always)]
    pub(super) fn fill<K: Kernel, L: Lanes>(
        &mut self,
        x: L,
        y: L,
        neighbours: &[u32],
        records: &[Record],
        slopes: &mut [Slopes],
    ) -> &[Pair] {
        let count = neighbours.len().min(CHUNK).min(slopes.len());
        for ((&j, pair), slope) in neighbours.iter().zip(&mut self.0).zip(slopes) {
            let record = &records[j as usize].0;
            let dx = x - L::splat(record[Record::X]);
            let dy = y - L::splat(record[Record::Y]);
            let s = dx.mul_add(dx, dy.mul_add(dy, L::splat(COINCIDENT)));
            let inverse_q = s.rsqrt();
            let g = K::slope_over_q(s, inverse_q) * L::splat(record[Record::WEIGHT]);
            g.store_single(&mut slope.0);
            let pair = pair.as_mut_ptr();
            // SAFETY: the pointer is to a whole `Pair`, whose fields are written one by one; any
            // bits are a valid array of numbers.
            unsafe {
                (inverse_q * inverse_q).store(&mut (*pair).inverse_s);
                g.store(&mut (*pair).slope);
            }
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
