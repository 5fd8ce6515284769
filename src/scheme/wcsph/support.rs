//! The support of a particle: its completeness, and the correction of its gradients.

use super::correction::{correction, smallest_eigenvalue};
use crate::pairs::{Double, Eight, Here, Neighbour, Other, Pair, Real, Term};

/// Σ_j V_j ∇W ⊗ Δ: xx, xy, yy.
#[derive(Clone, Copy)]
pub(super) struct Moment;

impl Term for Moment {
    type Own<R: Real> = ();
    type Sum<R: Real> = [R; 3];
    type Total = [Eight; 3];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, _: Here) {}

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        (): &(),
        pair: &Pair<R>,
        _: Other<'_, N>,
        [xx, xy, yy]: &mut [R; 3],
    ) {
        let [gx, gy] = pair.gradient();
        *xx = gx.mul_add(pair.dx, *xx);
        *xy = gx.mul_add(pair.dy, *xy);
        *yy = gy.mul_add(pair.dy, *yy);
    }
}

/// How the moment is evaluated.
#[derive(Clone, Copy)]
pub(super) struct Support {
    /// Whether the completeness is wanted.
    pub wanted: bool,
    /// Whether the gradient's correction is wanted too.
    pub corrected: bool,
    /// R, metres.
    pub support_radius: f64,
    /// See [`super::correction::first_row_share`].
    pub first_row: f64,
}

impl Support {
    /// Writes the completeness of the support, then the next correction's xx, xy and yy. Inputs are
    /// the moment of all neighbours, and that of the water among them.
    #[inline(always)]
    pub fn put<D: Double>(
        self,
        here: Here,
        [xx, xy, yy]: [D; 3],
        [water_xx, _, water_yy]: [D; 3],
        [completenesses, next_xx, next_xy, next_yy]: &mut [&mut [f64]; 4],
    ) {
        if !self.wanted {
            return;
        }
        let radius = D::splat(-self.support_radius);
        let moment = [xx * radius, xy * radius, yy * radius];
        let completeness = smallest_eigenvalue(moment);
        here.put(completenesses, completeness);
        if self.corrected {
            let of_water = (water_xx + water_yy) * radius;
            let of_walls = moment[0] + moment[2] - of_water;
            let [xx, xy, yy] = correction(moment, completeness, of_walls, self.first_row);
            here.put(next_xx, xx);
            here.put(next_xy, xy);
            here.put(next_yy, yy);
        }
    }
}
