//! Simplified finite difference interpolation.

use serde::{Deserialize, Serialize};

use super::weighing::{Stencil, Totals, Weighing, choose};
use super::{AMPLIFICATION_LIMIT, Interpolator};
use crate::math::simd::{LANES, Lanes};

/// Which part of N = Σ w ΔΔᵀ/Δ² is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SfdiMatrix {
    /// All of it: exact for linear fields everywhere.
    Full,
    /// Its diagonal, as Huang et al. 2019 print it: exact only on symmetric neighbourhoods.
    Diagonal,
}

/// f(r) = Σ w_j f_j/Σ w_j - Σ B_j (f_j - f_i) around the particle i nearest to r (Huang et al.
/// 2019, Eqs. 10-13; Ma 2008), with
/// B_j = R0ᵀ N⁻¹ Δ_j w(|Δ_j|)/Δ_j², Δ_j = r_j - r_i, R0 = Σ w_j (r_j - r)/Σ w_j.
///
/// Eq. 12 is printed with r_i - r_i in a denominator and an undefined n. By default N is taken in
/// full; the paper keeps its diagonal. If N is singular, or Σ|w_j| exceeds `amplification_limit`, B
/// is dropped. What remains is the normalized interpolation without its V_j, and the ghost counts
/// as a fallback.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sfdi {
    /// Full N or the paper's.
    pub matrix: SfdiMatrix,
    /// Largest Σ|w_j|: how much the weights may amplify noise.
    pub amplification_limit: f64,
}

/// Smallest det N over (tr N)² that counts as not singular.
const SINGULAR: f64 = 1e-9;
/// Δ² over R² below which two particles are one.
const COINCIDENT: f64 = 1e-12;

/// Δ = r_j - r_i, and w(|Δ|)/Δ². The latter is zero for the particle itself and where w_j is zero.
#[inline(always)]
fn difference<L: Lanes>(
    stencil: &Stencil<'_, L>,
    number: usize,
    centre: (L, L),
    near: L,
) -> (L, L, L) {
    let (x, y) = stencil.apart(number);
    let (dx, dy) = (x - centre.0, y - centre.1);
    let s = dx.mul_add(dx, dy * dy);
    let value = stencil.shape(s).div(s.max(L::splat(COINCIDENT)));
    let value = L::splat(COINCIDENT).select_less(s, value, L::splat(0.0));
    (dx, dy, L::splat(0.0).select_less(near, value, L::splat(0.0)))
}

impl Interpolator for Sfdi {
    const TRIED: &'static [Sfdi] = &[
        Sfdi { matrix: SfdiMatrix::Full, amplification_limit: AMPLIFICATION_LIMIT },
        Sfdi { matrix: SfdiMatrix::Diagonal, amplification_limit: AMPLIFICATION_LIMIT },
    ];
    const SIGNED: bool = true;

    #[inline(always)]
    fn weigh<L: Lanes>(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        // Means around the point, and the nearest particle in each lane.
        let (mut sum, mut rx, mut ry) = (zero, zero, zero);
        let (mut least, mut number) = (L::splat(f64::MAX), zero);
        let (mut cx, mut cy) = (zero, zero);
        for (k, weight) in weights.iter_mut().enumerate() {
            let (x, y) = stencil.apart(k);
            let s = x.mul_add(x, y * y);
            let value = stencil.shape(s);
            value.store(weight);
            sum += value;
            rx = value.mul_add(x, rx);
            ry = value.mul_add(y, ry);
            number = s.select_less(least, L::splat(k as f64), number);
            cx = s.select_less(least, x, cx);
            cy = s.select_less(least, y, cy);
            least = s.min(least);
        }
        let inverse = one.div(sum.max(L::splat(1e-200)));
        let (rx, ry) = (rx * inverse, ry * inverse);
        // N around the nearest particle.
        let (mut nxx, mut nxy, mut nyy) = (zero, zero, zero);
        for (k, weight) in weights.iter().enumerate() {
            let (dx, dy, value) = difference(stencil, k, (cx, cy), L::load(weight));
            nxx = (value * dx).mul_add(dx, nxx);
            nxy = (value * dx).mul_add(dy, nxy);
            nyy = (value * dy).mul_add(dy, nyy);
        }
        if self.matrix == SfdiMatrix::Diagonal {
            nxy = zero;
        }
        let trace = nxx + nyy;
        let determinant = nxx.mul_sub(nyy, nxy * nxy);
        let unsolved = (trace * trace * L::splat(SINGULAR)).select_less(determinant, zero, one);
        let factor = sum.div(determinant.max(L::splat(1e-200)));
        let bx = choose(unsolved, zero, nyy.mul_sub(rx, nxy * ry) * factor);
        let by = choose(unsolved, zero, nxx.mul_sub(ry, nxy * rx) * factor);
        // Σ w times B_j, all of which goes to the nearest particle.
        let mut given = zero;
        let mut totals = Totals::zero();
        for (k, weight) in weights.iter().enumerate() {
            let near = L::load(weight);
            let (dx, dy, value) = difference(stencil, k, (cx, cy), near);
            let taken = value * dx.mul_add(bx, dy * by);
            given += taken;
            totals.add(near - taken);
        }
        // The nearest particle's two parts are counted separately, which gives an upper bound of
        // Σ|w_j|.
        totals.add(given);
        let unfit = totals.unfit(self.amplification_limit, unsolved);
        let (bx, by) = (choose(unfit, zero, bx), choose(unfit, zero, by));
        let given = choose(unfit, zero, given);
        let mut sum = given;
        for (k, weight) in weights.iter_mut().enumerate() {
            let near = L::load(weight);
            let (dx, dy, value) = difference(stencil, k, (cx, cy), near);
            let rest = value.negated_mul_add(dx.mul_add(bx, dy * by), near);
            rest.store(weight);
            sum += rest;
        }
        let (given, number) = (given.to_array(), number.to_array());
        for (lane, (given, number)) in given.into_iter().zip(number).enumerate() {
            if let Some(weight) = weights.get_mut(number as usize) {
                weight[lane] += given;
            }
        }
        Weighing::of_sum(sum, unfit)
    }
}
