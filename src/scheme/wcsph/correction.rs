//! Small symmetric matrices of a particle's neighbourhood: how complete it is, and what mends its
//! gradients.

use crate::math::simd::Lanes;

/// R ∇ρ = A⁻¹ Σ g (ρ_j - ρ_i) Δ with A = -Σ g ΔΔᵀ taken positive: signs cancel. Where fewer than
/// three particles span the plane A is singular and the gradient is left at zero.
#[inline(always)]
pub(super) fn solve_symmetric<L: Lanes>([xx, xy, yy]: [L; 3], [bx, by]: [L; 2]) -> [L; 2] {
    let zero = L::splat(0.0);
    let determinant = xx * yy - xy * xy;
    let trace = xx + yy;
    let floor = trace * trace * L::splat(1e-4);
    let safe = determinant.max(floor.max(L::splat(1e-300)));
    let usable = |value: L| floor.select_less(determinant, value, zero);
    // A Δ-sum of the same sign convention on both sides: minus signs cancel except one.
    let x = (yy * bx - xy * by).div(safe);
    let y = (xx * by - xy * bx).div(safe);
    [usable(zero - x), usable(zero - y)]
}

/// Smallest eigenvalue of a symmetric matrix: 1 inside the water, 0 for a lone particle.
#[inline(always)]
pub(super) fn smallest_eigenvalue<L: Lanes>([xx, xy, yy]: [L; 3]) -> L {
    let half = L::splat(0.5);
    let (mean, apart) = ((xx + yy) * half, (xx - yy) * half);
    let radius = apart.mul_add(apart, xy * xy).max(L::splat(1e-300)).sqrt();
    mean - radius
}

/// Inverse of Σ V (x_j - x_i) ⊗ ∇W, fading to the identity where the support is too incomplete
/// for the inverse to be trusted: later beside walls (`of_walls`: their part of the sum's trace),
/// whose ghosts move with the water.
#[inline(always)]
pub(super) fn correction<L: Lanes>([xx, xy, yy]: [L; 3], completeness: L, of_walls: L) -> [L; 3] {
    const TRUSTED_FROM: f64 = 0.35;
    const TRUSTED_FULL: f64 = 0.48;
    const LOWER_AT_WALLS: f64 = 0.16;
    const AT_WALLS: f64 = 1.0 / 3.0;
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let determinant = (xx * yy - xy * xy).max(L::splat(1e-3));
    let at_walls = (of_walls * L::splat(1.0 / AT_WALLS)).min(one);
    let raised = at_walls.mul_add(L::splat(LOWER_AT_WALLS), completeness);
    let trust = (raised - L::splat(TRUSTED_FROM)) * L::splat(1.0 / (TRUSTED_FULL - TRUSTED_FROM));
    let trust = trust.max(zero).min(one);
    let share = trust.div(determinant);
    let rest = one - trust;
    [yy.mul_add(share, rest), zero - xy * share, xx.mul_add(share, rest)]
}
