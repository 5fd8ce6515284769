//! The divergence of the velocity, and its strain rate.

use super::operators::Operators;
use crate::pairs::{Eight, Field, Here, Near, Neighbour, Other, Pair, Real, Term};

/// Σ_j V_j u_j ∇_iW_ij, of Liang et al. 2017, Eq. 5: along x and y, of u and of v.
#[derive(Clone, Copy)]
struct Divergence;

impl Term for Divergence {
    type Own<R: Real> = ();
    type Sum<R: Real> = [R; 4];
    type Total = [Eight; 4];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, _: Here) {}

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        (): &(),
        pair: &Pair<R>,
        other: Other<'_, N>,
        [ux, uy, vx, vy]: &mut [R; 4],
    ) {
        let [gx, gy] = pair.gradient();
        let [u, v] = other.velocity::<R>();
        *ux = gx.mul_add(u, *ux);
        *uy = gy.mul_add(u, *uy);
        *vx = gx.mul_add(v, *vx);
        *vy = gy.mul_add(v, *vy);
    }
}

/// Writes `of(i, d)`, where d is Σ V_j (u_j - u_i)·L_i ∇_iW_ij for the particle i with the velocity
/// u_i. u_j is in the records.
pub(super) fn divergence(
    (near, operators): (&Near, &Operators),
    own: &[[f64; 2]],
    found: &mut [f64],
    of: impl Fn(usize, f64) -> f64 + Sync,
) {
    near.sum(Divergence, Field(found), |i, [ux, uy, vx, vy]| {
        let ([sx, sy], [lxx, lxy, lyy], [u, v]) =
            (operators.sway[i], operators.correction[i], own[i]);
        let divergence =
            lxx * (ux - sx * u) + lxy * (uy + vx - sx * v - sy * u) + lyy * (vy - sy * v);
        of(i, divergence)
    });
}

/// ∇u with the correction L. Writes its trace, and the trace-free symmetric part (½ (∂u/∂x -
/// ∂v/∂y), ½ (∂u/∂y + ∂v/∂x)): the strain rate.
pub(super) fn strain(
    (near, operators): (&Near, &Operators),
    own: &[[f64; 2]],
    (strain, divergence): (&mut [[f64; 2]], &mut [f64]),
) {
    near.sum(Divergence, (Field(strain), Field(divergence)), |i, [ux, uy, vx, vy]| {
        let ([sx, sy], [xx, xy, yy], [u, v]) = (operators.sway[i], operators.correction[i], own[i]);
        let [ux, uy] = [ux - sx * u, uy - sy * u];
        let [vx, vy] = [vx - sx * v, vy - sy * v];
        let (along, across) = (ux * xx + uy * xy, vx * xy + vy * yy);
        let shear = ux * xy + uy * yy + vx * xx + vy * xy;
        ([0.5 * (along - across), 0.5 * shear], along + across)
    });
}
