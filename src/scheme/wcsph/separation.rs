//! Inverse distances, ahead of the sums that need them.
//!
//! 1/q takes a long chain of dependent products: a loop that finds it for many neighbours first
//! keeps more of them under way at once than one that goes on to the sums of each.

use std::mem::MaybeUninit;

use crate::math::simd::{LANES, Lanes};
use crate::particles::Record;

/// Neighbours that are taken at a time.
pub(super) const CHUNK: usize = 64;

/// Squared distances below this (in support radii) count as this: a particle and itself.
const COINCIDENT: f64 = 1e-12;

/// Δx, Δy, Δy² and s = Δ² of a neighbour.
#[inline(always)]
pub(super) fn separation<L: Lanes>(x: L, y: L, record: &[f64; 8]) -> (L, L, L, L) {
    let dx = x - L::splat(record[Record::X]);
    let dy = y - L::splat(record[Record::Y]);
    let dy2 = dy.mul_add(dy, L::splat(COINCIDENT));
    (dx, dy, dy2, dx.mul_add(dx, dy2))
}

/// 1/q of a chunk of neighbours, eight lanes each.
pub(super) struct Inverses([MaybeUninit<[f64; LANES]>; CHUNK]);

impl Inverses {
    /// Room for a chunk.
    #[inline(always)]
    pub(super) fn new() -> Inverses {
        Inverses([const { MaybeUninit::uninit() }; CHUNK])
    }

    /// 1/q of up to [`CHUNK`] neighbours of the points (x, y).
    #[inline(always)]
    pub(super) fn fill<L: Lanes>(
        &mut self,
        x: L,
        y: L,
        neighbours: &[u32],
        records: &[Record],
    ) -> &[[f64; LANES]] {
        let count = neighbours.len().min(CHUNK);
        for (&j, inverse) in neighbours.iter().zip(&mut self.0) {
            let (.., s) = separation(x, y, &records[j as usize].0);
            inverse.write(s.rsqrt().to_array());
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
