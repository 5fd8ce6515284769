//! The free surface: which particles are at it, and how its zero pressure acts on them.

use super::images::Point;
use super::lattice::Even;
use super::operators::Operators;
use crate::pairs::{Eight, Field, Here, Near, Neighbour, Other, Pair, Real, Term};

/// A particle is at the surface where ∇·r is below this (Liang et al. 2017, Eq. 13).
const SURFACE_DIVERGENCE: f64 = 1.5;
/// The surface lies this far outside the centres of its particles, in spacings.
const SKIN: f64 = 0.5;
/// No particle is closer to the surface than this, in spacings.
const CLOSEST: f64 = 0.25;

/// Sums over the surface particles in reach: F, F times their height over the particle, and F n. n
/// is their normal.
#[derive(Clone, Copy)]
struct Above<'a> {
    points: &'a [Point],
    original: &'a [u32],
    at_surface: &'a [bool],
    sway: &'a [[f64; 2]],
}

impl Term for Above<'_> {
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
        [weight, height, up_x, up_y]: &mut [R; 4],
    ) {
        let original = self.original[other.number] as usize;
        if !self.at_surface[original] {
            return;
        }
        let [nx, ny] = self.points[other.number].turned(normal(self.sway[original]));
        let to = [R::splat(nx), R::splat(ny)];
        let ([gx, gy], g) = (pair.gradient(), pair.slope());
        *weight = *weight - g;
        *height = gx.mul_add(to[0], gy.mul_add(to[1], *height));
        *up_x = g.negated_mul_add(to[0], *up_x);
        *up_y = g.negated_mul_add(to[1], *up_y);
    }
}

/// Outwards: away from where the neighbours are.
fn normal([sx, sy]: [f64; 2]) -> [f64; 2] {
    let length = (sx * sx + sy * sy).sqrt();
    if length > 0.0 { [-sx / length, -sy / length] } else { [0.0, 1.0] }
}

/// Finds surface particles by ∇·r = Σ V_j (r_j - r_i)·∇_iW_ij < 1.5 (Eq. 13, sign corrected). Sets
/// the condition p = 0 half a spacing outside them.
///
/// The pressure at the surface particle itself is not zero: that would put the surface half a
/// spacing too low. Instead the empty part of a particle's support is thought to be filled with
/// points. Their pressure goes on linearly from p_i, through zero at the surface at the distance
/// d_i. Their sum 2 Σ F (p_v - p_i) is -2 |s_i|/d_i p_i, where s_i = Σ F Δ is over the present
/// neighbours. This is a term on the diagonal alone, exact for a linear pressure. The full-support
/// diagonal 2 (Σ_full F - Σ F) of Nair & Tomar 2014 is its lower bound here.
pub(super) fn find_surface(
    operators: &mut Operators,
    (near, points): (&Near, &[Point]),
    (spacing, even): (f64, &Even),
) {
    let Operators { at_surface, grip, sway, moment, weight, .. } = operators;
    at_surface.clear();
    at_surface.extend(moment.iter().map(|[xx, _, yy]| xx + yy < SURFACE_DIVERGENCE));
    let above = Above { points, original: &near.original, at_surface, sway };
    near.sum(above, Field(grip), |i, [sum, height, up_x, up_y]| {
        if sum > 0.0 {
            let distance = (SKIN * spacing + height / sum).max(CLOSEST * spacing);
            let length = (up_x * up_x + up_y * up_y).sqrt().max(1e-300);
            let [sx, sy] = sway[i];
            let outwards = -(sx * up_x + sy * up_y) / length;
            let missing = (even.weight - weight[i]).max(0.0);
            2.0 * (outwards / distance).max(missing)
        } else {
            0.0
        }
    });
}
