//! The improved Shepard interpolation of Huang et al. 2019.

use serde::{Deserialize, Serialize};

use super::Interpolator;
use super::weighing::{Stencil, Weighing};
use crate::math::simd::{LANES, Lanes};

/// w_j ∝ φ(r_j)⁴, φ = β(r)/r, β = exp(-σ q²/(1 - q^λ)), q = r/R (Huang et al. 2019, Eqs. 17-20).
///
/// β is dimensionless through q. The paper has r in metres, where β ≈ 1 and σ has no effect. μ = 4
/// as in the paper. There are only sums and no matrix, so it cannot fail in any neighbourhood. At a
/// coincident point it takes that particle's value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ImprovedShepard {
    /// λ, the index that shapes the attenuation.
    pub lambda: f64,
    /// σ, the strength of the attenuation.
    pub sigma: f64,
}

const MU: f64 = 4.0;

impl ImprovedShepard {
    /// q^λ from s = q².
    #[inline(always)]
    fn power<L: Lanes>(&self, s: L) -> L {
        if self.lambda == 2.0 {
            s
        } else if self.lambda == 1.0 {
            s.sqrt()
        } else if self.lambda == 4.0 {
            s * s
        } else {
            let exponent = 0.5 * self.lambda;
            let powers = s.to_array().map(|s| libm::pow(s, exponent));
            L::load(&powers)
        }
    }
}

impl Interpolator for ImprovedShepard {
    const TRIED: &'static [ImprovedShepard] = &[ImprovedShepard { lambda: 2.0, sigma: 1.0 }];
    const PEAKED: bool = true;

    #[inline(always)]
    fn weigh<L: Lanes>(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        let one = L::splat(1.0);
        let mut sum = L::splat(0.0);
        for (k, weight) in weights.iter_mut().enumerate() {
            let (dx, dy) = stencil.apart(k);
            // Nearer than 1e-6 R is coincident: the weight is then 1e20 times all others.
            let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
            let room = (one - self.power(s)).max(L::splat(1e-3));
            // One division for both 1/s² and 1/(1 - q^λ).
            let square = s * s;
            let inverse = one.div(square * room);
            let exponent = inverse * square * (s * L::splat(-MU * self.sigma));
            let value = inverse * room * exponent.max(L::splat(-600.0)).exp();
            let value = s.select_less(one, value, L::splat(0.0));
            value.store(weight);
            sum += value;
        }
        Weighing::of_sum(sum, L::splat(0.0))
    }
}
