//! The response of the water to the acceleration of a wall: it gives the wall's added mass.

use crate::pairs::{Eight, Here, Neighbour, Other, Pair, Real, Term};

/// Σ_j V_j b_j ∇W, where b is the change of a ghost's pressure per acceleration of its wall.
#[derive(Clone, Copy)]
pub(super) struct Response<'a> {
    /// b of all ghosts times the correction: xx, xy, yy.
    pub responses: &'a [[f64; 3]],
    /// Number of the first ghost among all neighbours.
    pub first_ghost: usize,
}

impl Term for Response<'_> {
    type Own<R: Real> = ();
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, _: Here) {}

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        (): &(),
        pair: &Pair<R>,
        other: Other<'_, N>,
        [x, y]: &mut [R; 2],
    ) {
        let [xx, xy, yy] = self.responses[other.number - self.first_ghost];
        let (xx, xy, yy) = (R::splat(xx), R::splat(xy), R::splat(yy));
        let [gx, gy] = pair.gradient();
        *x = xy.mul_add(gy, xx.mul_add(gx, *x));
        *y = yy.mul_add(gy, xy.mul_add(gx, *y));
    }
}
