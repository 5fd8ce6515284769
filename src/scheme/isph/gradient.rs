//! The gradient of the pressure, and the force of the water on the walls.

use std::cell::Cell;

use super::images::Point;
use super::operators::Operators;
use crate::pairs::{Eight, Field, Here, Near, Neighbour, Other, Pair, Real, Record, Term};

/// Σ_j V_j p_j L_j ∇_iW_ij, of Liang et al. 2017, Eq. 9: along x from g Δx and g Δy, along y from both.
#[derive(Clone, Copy)]
struct Pressure;

impl Term for Pressure {
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
        [x, more_x, y, more_y]: &mut [R; 4],
    ) {
        let [gx, gy] = pair.gradient();
        let [xx, xy, yy] = other.pressure::<R>();
        *x = gx.mul_add(xx, *x);
        *more_x = gy.mul_add(xy, *more_x);
        *y = gx.mul_add(xy, *y);
        *more_y = gy.mul_add(yy, *more_y);
    }
}

/// Σ V_j (p_i L_i + p_j L_j) ∇_iW_ij for the pressures p_i, with p_j L_j in the records, times a factor.
pub(super) fn gradient(
    (near, operators): (&Near, &Operators),
    (pressure, factor): (&[f64], f64),
    slope: &mut [[f64; 2]],
) {
    near.sum(Pressure, Field(slope), |i, [x, more_x, y, more_y]| {
        let ([sx, sy], [xx, xy, yy], p) = (operators.sway[i], operators.correction[i], pressure[i]);
        let along = (x + more_x) + p * (xx * sx + xy * sy);
        let up = (y + more_y) + p * (xy * sx + yy * sy);
        [factor * along, factor * up]
    });
}

/// The force of the walls' images on the water, along x: the sum of V_i V_j ((p_i L_i + p_j L_j)
/// ∇_iW_ij)_x over pairs. Each pair is added to the force on the image's body (Eq. 14).
#[derive(Clone, Copy)]
struct Reaction<'a> {
    records: &'a [Record],
    /// V_i, padded.
    volume: &'a [f64],
    points: &'a [Point],
    forces: &'a [Cell<f64>],
}

impl Term for Reaction<'_> {
    /// V_i, and xx and xy of p_i L_i.
    type Own<R: Real> = [R; 3];
    type Sum<R: Real> = [R; 0];
    type Total = [Eight; 0];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> [R; 3] {
        let [xx, xy] = here.slots(self.records, [Record::PRESSURE, Record::PRESSURE_XY]);
        [here.of(self.volume), xx, xy]
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        &[volume, own_xx, own_xy]: &[R; 3],
        pair: &Pair<R>,
        other: Other<'_, N>,
        _: &mut [R; 0],
    ) {
        let [gx, gy] = pair.gradient();
        let [xx, xy, _] = other.pressure::<R>();
        let along = (gx * (xx + own_xx)) + gy * (xy + own_xy);
        let force = &self.forces[self.points[other.number].body as usize];
        force.set(force.get() + (volume * along).total());
    }
}

/// Force of the water on every body along x: the momentum reaction of Liang et al. 2017, Eq. 14.
/// The sum is over fluid i and images j, with the corrected gradients of the momentum equation. So
/// it is minus the force that the water itself feels. p L is in the records.
pub(super) fn reaction(near: &Near, points: &[Point], forces: &mut [f64]) {
    forces.fill(0.0);
    near.over_images(Reaction {
        records: &near.records,
        volume: &near.volume,
        points,
        forces: Cell::from_mut(forces).as_slice_of_cells(),
    });
}
