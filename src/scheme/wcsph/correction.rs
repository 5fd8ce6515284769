//! Small symmetric matrices of a particle's neighbourhood: its completeness, and the correction of
//! its gradients.

use super::Workspace;
use crate::pairs::Double;

/// Most by which the extrapolation changes any component of a correction. Waves up to H/h = 0.3
/// stay below. Where a jet lands, the correction may change by half within a full step. That change
/// says nothing of the next one.
const MOST_TAKEN_ON: f64 = 0.1;

/// R ∇ρ = A⁻¹ Σ g (ρ_j - ρ_i) Δ with A = -Σ g ΔΔᵀ, which is positive: signs cancel. If fewer than
/// three particles span the plane, A is singular and the gradient is set to zero.
#[inline(always)]
pub(super) fn solve_symmetric<D: Double>([xx, xy, yy]: [D; 3], [bx, by]: [D; 2]) -> [D; 2] {
    let zero = D::splat(0.0);
    let determinant = xx * yy - xy * xy;
    let trace = xx + yy;
    let floor = trace * trace * D::splat(1e-4);
    let safe = determinant.max(floor.max(D::splat(1e-300)));
    let usable = |value: D| floor.select_less(determinant, value, zero);
    // Both sides are Δ-sums of the same sign, so all minus signs but one cancel.
    let x = (yy * bx - xy * by).div(safe);
    let y = (xx * by - xy * bx).div(safe);
    [usable(zero - x), usable(zero - y)]
}

/// Smallest eigenvalue of a symmetric matrix: 1 inside the water, 0 for a lone particle.
#[inline(always)]
pub(super) fn smallest_eigenvalue<D: Double>([xx, xy, yy]: [D; 3]) -> D {
    let half = D::splat(0.5);
    let (mean, apart) = ((xx + yy) * half, (xx - yy) * half);
    let radius = apart.mul_add(apart, xy * xy).max(D::splat(1e-300)).sqrt();
    mean - radius
}

/// Inverse of Σ V (x_j - x_i) ⊗ ∇W. It fades to the identity where the support is too incomplete
/// for the inverse to be trusted. Beside walls it fades later, because their ghosts move with the
/// water; `of_walls` is their part of the sum's trace. Under the surface only a share of it is
/// taken: see [`surface_share`].
#[inline(always)]
pub(super) fn correction<D: Double>(
    [xx, xy, yy]: [D; 3],
    completeness: D,
    of_walls: D,
    first_row: f64,
) -> [D; 3] {
    const TRUSTED_FROM: f64 = 0.35;
    const TRUSTED_FULL: f64 = 0.48;
    const LOWER_AT_WALLS: f64 = 0.16;
    const AT_WALLS: f64 = 1.0 / 3.0;
    let (zero, one) = (D::splat(0.0), D::splat(1.0));
    let determinant = (xx * yy - xy * xy).max(D::splat(1e-3));
    let at_walls = (of_walls * D::splat(1.0 / AT_WALLS)).min(one);
    let raised = at_walls.mul_add(D::splat(LOWER_AT_WALLS), completeness);
    let trust = (raised - D::splat(TRUSTED_FROM)) * D::splat(1.0 / (TRUSTED_FULL - TRUSTED_FROM));
    let trust = trust.max(zero).min(one);
    let share = (trust * surface_share(completeness, first_row)).div(determinant);
    let rest = one - trust;
    [yy.mul_add(share, rest), zero - xy * share, xx.mul_add(share, rest)]
}

/// Share of the inverse with which linear pressure balances still water under a flat surface.
///
/// Pairs push with V_i V_j (p_i L_i + p_j L_j). If L were the whole inverse, the second row of
/// particles would have to bear half a spacing of water less than lies on it. So the share was
/// found at which ρ g d balances, row by row. It depends on the completeness of the rows alone, on
/// square and hexagonal lattices, level or askew. It is `first_row` up to 0.5, where the first row
/// is, some 0.65 from 0.6 to 0.75, and 1 inside the water.
///
/// The divergence has the same L, so energy is conserved as before. Water that keeps its volume
/// does so for any share.
#[inline(always)]
pub(super) fn surface_share<D: Double>(completeness: D, first_row: f64) -> D {
    const FROM: f64 = 0.5;
    const FULL: f64 = 0.6;
    const FADES_FROM: f64 = 0.72;
    const LEFT_OUT: f64 = 0.36;
    let (zero, one) = (D::splat(0.0), D::splat(1.0));
    let rise = (completeness - D::splat(FROM)) * D::splat(1.0 / (FULL - FROM));
    let fall = (one - completeness) * D::splat(1.0 / (1.0 - FADES_FROM));
    let (rise, fall) = (rise.max(zero).min(one), fall.max(zero).min(one));
    let fall = fall * fall * (D::splat(3.0) - fall - fall);
    let first = (one - rise) * D::splat(first_row - 1.0);
    (rise * fall).negated_mul_add(D::splat(LEFT_OUT), one + first)
}

/// The share of the first row under a flat surface, for a support of this many spacings (of
/// Wendland C2, or of a kernel as wide).
///
/// The wider the support, the more rows share the load of the first one. Square and hexagonal
/// lattices that lie level need 1.04 and 1.11 at 4 spacings, 1.16 and 1.26 at 4.5, 1.31 and 1.42 at
/// 5, 1.60 and 1.73 at 6. Up to 4 it is 1.
pub(super) fn first_row_share(support: f64) -> f64 {
    const FROM: f64 = 4.0;
    const RISE: f64 = 0.3;
    1.0 + RISE * (support - FROM).max(0.0)
}

impl Workspace {
    /// Takes the correction that the last pass has found for the coming full step. If it is
    /// extrapolated, its last change is added once more: L + (L - L_before). The change is at most
    /// [`MOST_TAKEN_ON`]. The first correction has none.
    ///
    /// Without this, the correction lags and the pressure always pushes a little too late. This
    /// feeds waves.
    pub(super) fn take_next_correction(&mut self, extrapolated: bool) {
        let carried = &mut self.carried;
        let next = [
            &mut self.next_correction_xx,
            &mut self.next_correction_xy,
            &mut self.next_correction_yy,
        ];
        if extrapolated {
            for (next, before) in next.into_iter().zip(&mut carried.found_correction) {
                if before.is_empty() {
                    before.clone_from(next);
                    continue;
                }
                for (next, before) in next.iter_mut().zip(before) {
                    let found = *next;
                    let change = found - std::mem::replace(before, found);
                    *next += change.clamp(-MOST_TAKEN_ON, MOST_TAKEN_ON);
                }
            }
        }
        std::mem::swap(&mut carried.correction_xx, &mut self.next_correction_xx);
        std::mem::swap(&mut carried.correction_xy, &mut self.next_correction_xy);
        std::mem::swap(&mut carried.correction_yy, &mut self.next_correction_yy);
    }
}

#[cfg(test)]
mod tests;
