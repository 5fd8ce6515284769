//! Artificial viscosity (Huang et al. 2019, Eq. 5), a term of the momentum equation.
//!
//! ```text
//! α h c0 ρ0 Σ_j V_j π_ij ∇W_ij,   π_ij = (u_ij · x_ij) / |x_ij|²
//! ```
//! The viscosity of water is another term, in a pass of its own (`laminar.rs`).

use crate::pairs::{Double, Eight, Fluid, Here, Neighbour, Other, Pair, Real, Term};

/// Σ_j V_j π_ij ∇W. With `CORRECTED`, the part of π_ij from a linear, divergence-free velocity
/// field is left out. At a wall (`GHOSTS`) the strain rate is the particle's own on both sides.
///
/// With `limited` every pair dissipates or does nothing. That damps smooth waves as well. Their
/// remaining π_ij has both signs, as ∇²u = 0, and only one sign is let through.
#[derive(Clone, Copy)]
pub(super) struct ArtificialViscosity<'a, const CORRECTED: bool, const GHOSTS: bool> {
    pub fluid: &'a Fluid,
    /// See [`super::momentum::Momentum::strain`].
    pub strain: &'a [[f64; 2]],
    /// Whether every pair must dissipate or do nothing.
    pub limited: bool,
}

impl<const CORRECTED: bool, const GHOSTS: bool> Term
    for ArtificialViscosity<'_, CORRECTED, GHOSTS>
{
    /// Velocity and strain.
    type Own<R: Real> = [[R; 2]; 2];
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> [[R; 2]; 2] {
        let velocity = here.all([&self.fluid.vx, &self.fluid.vy]);
        [velocity, if CORRECTED { here.both(self.strain) } else { [R::splat(0.0); 2] }]
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        &[[u, v], own]: &[[R; 2]; 2],
        pair: &Pair<R>,
        other: Other<'_, N>,
        [x, y]: &mut [R; 2],
    ) {
        let ([their_u, their_v], Pair { dx, dy, .. }) = (other.velocity(), *pair);
        let (du, dv) = (u - their_u, v - their_v);
        let mut approach = du.mul_add(dx, dv * dy);
        if CORRECTED {
            let theirs = if GHOSTS { own } else { other.strain(self.strain) };
            let (stretch, shear) = (own[0] + theirs[0], own[1] + theirs[1]);
            let apart = dx.mul_sub(dx, dy * dy);
            let rest = (dx * dy).negated_mul_add(shear, approach);
            let rest = apart.negated_mul_add(stretch, rest);
            approach = if self.limited {
                // Limited to the range from zero to the whole.
                let zero = R::splat(0.0);
                let (low, high) = (approach.min(zero), approach.max(zero));
                rest.min(high).max(low)
            } else {
                rest
            };
        }
        let [gx, gy] = pair.gradient();
        let drag = pair.over_square(approach);
        *x = drag.mul_add(gx, *x);
        *y = drag.mul_add(gy, *y);
    }
}

/// Velocities halfway through a step: the work of viscosity is found with these.
#[inline(always)]
pub(super) fn halfway<D: Double>(
    fluid: &Fluid,
    here: Here,
    [along, up]: [D; 2],
    half_step: f64,
) -> [D; 2] {
    let ([u, v], half_step) = (here.all::<D, 2>([&fluid.vx, &fluid.vy]), D::splat(half_step));
    [along.mul_add(half_step, u), up.mul_add(half_step, v)]
}
