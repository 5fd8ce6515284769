//! Moving least squares with a quadratic basis.

use serde::{Deserialize, Serialize};

use super::mls_linear::Plane;
use super::weighing::{Stencil, Totals, Weighing, choose};
use super::{AMPLIFICATION_LIMIT, Interpolator};
use crate::math::simd::{LANES, Lanes};

/// Huang et al. 2019, Eqs. 8-9, with b = (1, ξ, η, ξ², ξη, η²), (ξ, η) = (r_j - r)/R: exact for
/// quadratic fields.
///
/// M is factored as L D Lᵀ. A pivot vanishes for fewer than six particles, or if all are on a
/// conic. If so, or if Σ|w_j| exceeds `amplification_limit`, the linear basis is used. If that
/// fails too, the normalized interpolation is used. The ghost counts as a fallback once.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MlsQuadratic {
    /// Largest Σ|w_j|: how much the weights may amplify noise.
    pub amplification_limit: f64,
}

const SIZE: usize = 6;

/// Powers of ξ and η in the basis. The constant is last, so that the forward substitution leaves
/// the right-hand side e unchanged.
const POWERS: [[usize; 2]; SIZE] = [[2, 0], [1, 1], [0, 2], [1, 0], [0, 1], [0, 0]];

/// Smallest pivot over its diagonal entry that counts as not singular.
const SINGULAR: f64 = 1e-9;

/// Σ W V ξᵃ ηᵇ for a + b ≤ 4, at `[a][b]`.
type Moments<L> = [[L; 5]; 5];

/// Coefficients of the weights in the basis, up to a factor: M c ∝ e; and 1 in singular lanes.
#[inline(always)]
fn solve<L: Lanes>(moments: &Moments<L>) -> ([L; SIZE], L) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let mut matrix = [[zero; SIZE]; SIZE];
    for (row, p) in matrix.iter_mut().zip(POWERS) {
        for (entry, q) in row.iter_mut().zip(POWERS) {
            *entry = moments[p[0] + q[0]][p[1] + q[1]];
        }
    }
    let mut unsolved = zero;
    for k in 0..SIZE - 1 {
        let p = POWERS[k];
        let least = moments[2 * p[0]][2 * p[1]] * L::splat(SINGULAR);
        let pivot = matrix[k][k];
        unsolved = least.select_less(pivot, unsolved, one);
        let inverse = one.div(least.select_less(pivot, pivot, one));
        let mut column = [zero; SIZE];
        for i in k + 1..SIZE {
            column[i] = matrix[i][k];
            let factor = column[i] * inverse;
            for (entry, other) in matrix[i].iter_mut().zip(column).take(i + 1).skip(k + 1) {
                *entry = factor.negated_mul_add(other, *entry);
            }
            matrix[i][k] = factor;
        }
    }
    // Lᵀ c = e: the factor 1/D of the last row is left to the normalisation.
    let mut c = [zero; SIZE];
    c[SIZE - 1] = one;
    for k in (0..SIZE - 1).rev() {
        let mut value = zero;
        for i in k + 1..SIZE {
            value = matrix[i][k].negated_mul_add(c[i], value);
        }
        c[k] = value;
    }
    (c, unsolved)
}

/// The factor of a neighbour's kernel weight, from coefficients in the basis.
#[inline(always)]
fn polynomial<L: Lanes>(c: &[L; SIZE], (x, y): (L, L)) -> L {
    let along_x = x.mul_add(c[0], y.mul_add(c[1], c[3]));
    let along_y = y.mul_add(c[2], c[4]);
    x.mul_add(along_x, y.mul_add(along_y, c[5]))
}

impl Interpolator for MlsQuadratic {
    const TRIED: &'static [MlsQuadratic] =
        &[MlsQuadratic { amplification_limit: AMPLIFICATION_LIMIT }];
    const FROM_KERNEL: bool = true;
    const SIGNED: bool = true;

    #[inline(always)]
    fn weigh<L: Lanes>(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        let zero = L::splat(0.0);
        let mut moments = [[zero; 5]; 5];
        for (k, weight) in weights.iter().enumerate() {
            let (mut wx, (x, y)) = (L::load(weight), stencil.apart(k));
            for (a, row) in moments.iter_mut().enumerate() {
                let mut wxy = wx;
                for entry in row.iter_mut().take(5 - a) {
                    *entry += wxy;
                    wxy = wxy * y;
                }
                wx = wx * x;
            }
        }
        let (mut c, unsolved) = solve(&moments);
        let mut totals = Totals::zero();
        for (k, weight) in weights.iter().enumerate() {
            totals.add(L::load(weight) * polynomial(&c, stencil.apart(k)));
        }
        let limit = self.amplification_limit;
        let unfit = totals.unfit(limit, unsolved);
        if L::splat(0.5).any_less(unfit) {
            let [row, along_x, along_xx, ..] = moments;
            let (plane, unsolved) =
                Plane::solve([row[0], along_x[0], row[1], along_xx[0], along_x[1], row[2]]);
            let Plane([a, b, d]) = plane.flattened(plane.unfit(stencil, weights, limit, unsolved));
            for (old, new) in c.iter_mut().zip([zero, zero, zero, b, d, a]) {
                *old = choose(unfit, new, *old);
            }
        }
        let mut sum = zero;
        for (k, weight) in weights.iter_mut().enumerate() {
            let value = L::load(weight) * polynomial(&c, stencil.apart(k));
            value.store(weight);
            sum += value;
        }
        Weighing::of_sum(sum, unfit)
    }
}
