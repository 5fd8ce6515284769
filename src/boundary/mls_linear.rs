//! Moving least squares with a linear basis.

use serde::{Deserialize, Serialize};

use super::weighing::{Stencil, Totals, Weighing, choose};
use super::{AMPLIFICATION_LIMIT, Interpolator};
use crate::math::simd::{LANES, Lanes};

/// w_j = e₁ᵀM⁻¹ b_j W_j V_j, M = Σ b_j ⊗ b_j W_j V_j, b = (1, x_j - x, y_j - y) (Huang et al. 2019,
/// Eqs. 8-9): exact for linear fields.
///
/// With the weighted centre r̄ and scatter C of the neighbours this is w_j ∝ W_j V_j [1 - (r_j -
/// r̄)·g], g = C⁻¹(r̄ - r) Σ W V. C is singular for fewer than three particles, or if all are on a
/// line. If so, or if Σ|w_j| exceeds `amplification_limit`, the normalized interpolation is used (g
/// = 0), and the ghost counts as a fallback.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MlsLinear {
    /// Largest Σ|w_j|: how much the weights may amplify noise.
    pub amplification_limit: f64,
}

/// Smallest det C over (tr C)², and tr C over R² Σ W V, that count as not singular.
const SINGULAR: f64 = 1e-9;

/// Σ W V times 1, ξ, η, ξ², ξη, η².
pub(super) type Moments<L> = [L; 6];

/// W V times a + b ξ + c η.
#[derive(Clone, Copy)]
pub(super) struct Plane<L>(pub [L; 3]);

impl<L: Lanes> Plane<L> {
    /// From the moments of the neighbours; also 1 in the singular lanes, whose plane is flat.
    #[inline(always)]
    pub fn solve([m, mx, my, mxx, mxy, myy]: Moments<L>) -> (Plane<L>, L) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let inverse = one.div(m.max(L::splat(1e-200)));
        let (x, y) = (mx * inverse, my * inverse);
        let cxx = x.negated_mul_add(mx, mxx);
        let cxy = x.negated_mul_add(my, mxy);
        let cyy = y.negated_mul_add(my, myy);
        let trace = cxx + cyy;
        let determinant = cxx.mul_sub(cyy, cxy * cxy);
        let flat = (trace * trace * L::splat(SINGULAR)).select_less(determinant, zero, one);
        let unsolved = (m * L::splat(SINGULAR)).select_less(trace, flat, one);
        let factor = m.div(determinant.max(L::splat(1e-200)));
        let gx = choose(unsolved, zero, cyy.mul_sub(x, cxy * y) * factor);
        let gy = choose(unsolved, zero, cxx.mul_sub(y, cxy * x) * factor);
        (Plane([x.mul_add(gx, y.mul_add(gy, one)), zero - gx, zero - gy]), unsolved)
    }

    /// Sets the slope to zero in the lanes above one half.
    #[inline(always)]
    pub fn flattened(self, lanes: L) -> Plane<L> {
        let Plane([a, b, c]) = self;
        let zero = L::splat(0.0);
        Plane([choose(lanes, L::splat(1.0), a), choose(lanes, zero, b), choose(lanes, zero, c)])
    }

    /// The factor of a neighbour's kernel weight.
    #[inline(always)]
    pub fn at(&self, (x, y): (L, L)) -> L {
        let Plane([a, b, c]) = *self;
        x.mul_add(b, y.mul_add(c, a))
    }

    /// 1 in lanes whose weights amplify too much.
    #[inline(always)]
    pub fn unfit(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &[[f64; LANES]],
        limit: f64,
        unsolved: L,
    ) -> L {
        let mut totals = Totals::zero();
        for (k, weight) in weights.iter().enumerate() {
            totals.add(L::load(weight) * self.at(stencil.apart(k)));
        }
        totals.unfit(limit, unsolved)
    }
}

impl Interpolator for MlsLinear {
    const TRIED: &'static [MlsLinear] = &[MlsLinear { amplification_limit: AMPLIFICATION_LIMIT }];
    const FROM_KERNEL: bool = true;
    const SIGNED: bool = true;

    #[inline(always)]
    fn weigh<L: Lanes>(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        let zero = L::splat(0.0);
        let [mut m, mut mx, mut my, mut mxx, mut mxy, mut myy] = [zero; 6];
        for (k, weight) in weights.iter().enumerate() {
            let (weight, (x, y)) = (L::load(weight), stencil.apart(k));
            let (wx, wy) = (weight * x, weight * y);
            m += weight;
            mx += wx;
            my += wy;
            mxx = wx.mul_add(x, mxx);
            mxy = wx.mul_add(y, mxy);
            myy = wy.mul_add(y, myy);
        }
        let (plane, unsolved) = Plane::solve([m, mx, my, mxx, mxy, myy]);
        let unfit = plane.unfit(stencil, weights, self.amplification_limit, unsolved);
        let plane = plane.flattened(unfit);
        let mut sum = zero;
        for (k, weight) in weights.iter_mut().enumerate() {
            let value = L::load(weight) * plane.at(stencil.apart(k));
            value.store(weight);
            sum += value;
        }
        Weighing::of_sum(sum, unfit)
    }
}
