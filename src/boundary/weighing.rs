//! What interpolators share: the water around eight points, and the result of weighing.

use crate::kernel::{Kernel, KernelChoice, shape_within};
use crate::math::simd::{LANES, Lanes};
use crate::pairs::Record;
use crate::with_kernel;

/// Eight points (in support radii) and the fluid particles around them.
#[derive(Clone, Copy)]
pub struct Stencil<'a, L> {
    /// x of the points.
    pub x: L,
    /// y of the points.
    pub y: L,
    /// Numbers of the particles that may be in reach of any of them.
    pub neighbours: &'a [u32],
    /// All particles.
    pub records: &'a [Record],
    /// The scheme's kernel.
    pub kernel: KernelChoice,
}

/// The outcome of an interpolation at eight points.
#[derive(Clone, Copy)]
pub struct Weighing<L> {
    /// Makes each lane's weights sum to one; 0 where nothing is in reach.
    pub scale: L,
    /// 1 where a simpler method had to be used, else 0.
    pub fallback: L,
}

impl<L: Lanes> Weighing<L> {
    /// For weights with a positive sum, or a sum of zero where nothing is in reach.
    #[inline(always)]
    pub(super) fn of_sum(sum: L, fallback: L) -> Weighing<L> {
        let tiny = L::splat(1e-200);
        let scale = sum.select_less(tiny, L::splat(0.0), L::splat(1.0).div(sum.max(tiny)));
        Weighing { scale, fallback }
    }
}

impl<L: Lanes> Stencil<'_, L> {
    /// r_j - r over R of the neighbour number `k`.
    #[inline(always)]
    pub fn apart(&self, k: usize) -> (L, L) {
        let record = &self.records[self.neighbours[k] as usize].0;
        (L::splat(record[Record::X]) - self.x, L::splat(record[Record::Y]) - self.y)
    }

    /// The kernel's shape w(q) for s = q², exactly zero where q ≥ 1.
    #[inline(always)]
    pub(super) fn shape(&self, s: L) -> L {
        with_kernel!(self.kernel, K => shape_within::<K, L>(s))
    }

    /// Writes w(|r_j - r|) V_j up to a constant factor, exactly zero out of reach.
    #[inline(always)]
    pub fn kernel_weights<K: Kernel>(&self, weights: &mut [[f64; LANES]]) {
        for (k, weight) in weights.iter_mut().enumerate() {
            let (x, y) = self.apart(k);
            let record = &self.records[self.neighbours[k] as usize].0;
            // Records carry the sign of the kernel's slope.
            let volume = record[Record::WEIGHT] * K::SLOPE_FACTOR.signum();
            (shape_within::<K, L>(x.mul_add(x, y * y)) * L::splat(volume)).store(weight);
        }
    }
}

/// The sum of weights and of their magnitudes.
#[derive(Clone, Copy)]
pub(super) struct Totals<L> {
    sum: L,
    magnitude: L,
}

impl<L: Lanes> Totals<L> {
    #[inline(always)]
    pub fn zero() -> Totals<L> {
        Totals { sum: L::splat(0.0), magnitude: L::splat(0.0) }
    }

    #[inline(always)]
    pub fn add(&mut self, weight: L) {
        self.sum += weight;
        self.magnitude += weight.max(L::splat(0.0) - weight);
    }

    /// 1 where Σ|w_j| over Σ w_j exceeds `limit`, where the sum is not positive, or where
    /// `unsolved` is above one half; else 0.
    #[inline(always)]
    pub fn unfit(&self, limit: f64, unsolved: L) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let allowed = self.sum * L::splat(limit);
        let wild = allowed.select_less(self.magnitude, one, zero);
        // NaN is not below anything.
        let finite = self.magnitude.select_less(L::splat(f64::MAX), wild, one);
        L::splat(0.5).select_less(unsolved, one, finite)
    }
}

/// `new` in the lanes where `chosen` is above one half, `old` in the others.
#[inline(always)]
pub(super) fn choose<L: Lanes>(chosen: L, new: L, old: L) -> L {
    L::splat(0.5).select_less(chosen, new, old)
}

/// The weighted sum of a field of the water.
#[inline(always)]
pub(super) fn weighted<L: Lanes>(
    (neighbours, weights): (&[u32], &[[f64; LANES]]),
    field: &[f64],
) -> L {
    let of_one = |sum: L, (&j, weight): (&u32, &[f64; LANES])| {
        L::load(weight).mul_add(L::splat(field[j as usize]), sum)
    };
    neighbours.iter().zip(weights).fold(L::splat(0.0), of_one)
}
