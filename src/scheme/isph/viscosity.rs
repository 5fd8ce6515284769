//! Viscosity: that of the fluid, and an artificial one on what is not linear in the velocity.

use std::cell::Cell;

use super::images::Point;
use crate::pairs::{Eight, Field, Here, Near, Neighbour, Other, Pair, Real, Record, Term};

/// Viscous accelerations. The physical one is 8 ν Σ F π Δ with π = (u_j - u_i)·Δ/r², Monaghan &
/// Gingold 1983. The artificial one is α h c Σ F π' Δ, where π' is π less its part from a linear,
/// divergence-free velocity. It is limited, so that every pair dissipates or does nothing. F = -g,
/// Δ = r_j - r_i; both signs cancel.
///
/// Inside the water the first is ν∇²u, like 2 ν Σ F (u_j - u_i) of Liang et al. 2017, Eq. 3. At a
/// free surface they differ. The surface then bears no stress, but in Eq. 3 the stress is ν∇u in
/// place of ν(∇u + ∇uᵀ). Eq. 3 takes ν|∇u|² from the water, and this one 2ν E:E as real water does:
/// twice as much of a wave.
#[derive(Clone, Copy)]
struct Drag<'a> {
    /// Of every point, with images: u, and the strain rate in place of the pressure.
    records: &'a [Record],
    /// α h c.
    artificial: f64,
    /// 8 ν.
    physical: f64,
    /// Least value of Δ², m².
    least: f64,
}

impl Drag<'_> {
    /// The contribution of one pair, along x and up.
    #[inline(always)]
    fn of<R: Real, N: Neighbour>(
        &self,
        &[u, v, p, q]: &[R; 4],
        pair: &Pair<R>,
        other: Other<'_, N>,
    ) -> [R; 2] {
        let Pair { dx, dy, .. } = *pair;
        let ([their_u, their_v], [their_p, their_q, _]) =
            (other.velocity::<R>(), other.pressure::<R>());
        let (du, dv) = (u - their_u, v - their_v);
        let (p, q) = ((their_p + p) * R::splat(0.5), their_q + q);
        let approach = du.mul_add(dx, dv * dy);
        let linear = p.mul_add(dx * dx - dy * dy, q * (dx * dy));
        let zero = R::splat(0.0);
        let left = (approach - linear).min(approach.max(zero)).max(approach.min(zero));
        let square = dx.mul_add(dx, dy * dy).max(R::splat(self.least));
        let taken = R::splat(self.physical).mul_add(approach, R::splat(self.artificial) * left);
        let factor = pair.slope() * taken.div(square);
        [factor * dx, factor * dy]
    }
}

impl Term for Drag<'_> {
    /// Velocity and strain.
    type Own<R: Real> = [R; 4];
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> [R; 4] {
        let slots = [Record::VX, Record::VY, Record::PRESSURE, Record::PRESSURE_XY];
        here.slots(self.records, slots)
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        own: &[R; 4],
        pair: &Pair<R>,
        other: Other<'_, N>,
        [along, up]: &mut [R; 2],
    ) {
        let [x, y] = self.of(own, pair, other);
        *along += x;
        *up += y;
    }
}

/// The drag on the bodies through their images: the same with the opposite sign.
#[derive(Clone, Copy)]
struct Pull<'a> {
    drag: Drag<'a>,
    points: &'a [Point],
    /// m_i, padded.
    mass: &'a [f64],
    on_bodies: &'a [Cell<f64>],
}

impl Term for Pull<'_> {
    /// What the drag reads, and the mass.
    type Own<R: Real> = ([R; 4], R);
    type Sum<R: Real> = [R; 0];
    type Total = [Eight; 0];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> ([R; 4], R) {
        (Term::own::<R, N>(&self.drag, here), here.of(self.mass))
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        (own, mass): &([R; 4], R),
        pair: &Pair<R>,
        other: Other<'_, N>,
        _: &mut [R; 0],
    ) {
        let number = other.number;
        let [x, _] = self.drag.of(own, pair, other);
        let force = &self.on_bodies[self.points[number].body as usize];
        force.set(force.get() - (*mass * x).total());
    }
}

/// How viscous the water is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viscosity {
    /// α h c, m²/s.
    pub artificial: f64,
    /// ν, m²/s.
    pub physical: f64,
    /// Particle spacing, metres.
    pub spacing: f64,
}

impl Viscosity {
    /// Adds viscous accelerations to `drag`, and the viscous forces on bodies to `on_bodies`.
    /// Velocities are in the records. The strain rate of the water is written in place of its
    /// pressure.
    pub fn drag(
        &self,
        (near, points): (&mut Near, &[Point]),
        (strain, mass): (&[[f64; 2]], &[f64]),
        (drag, on_bodies): (&mut [[f64; 2]], &mut [f64]),
    ) {
        if self.artificial + self.physical == 0.0 {
            return;
        }
        near.each_point(|[e, j], at| {
            let [p, q] = strain[j];
            at.set_pressure(points[e].turned_tensor([p, q, -p]));
        });
        let terms = Drag {
            records: &near.records,
            artificial: self.artificial,
            physical: 8.0 * self.physical,
            least: 1e-12 * self.spacing * self.spacing,
        };
        near.sum(terms, Field(drag), |_, found| found);
        let on_bodies = Cell::from_mut(on_bodies).as_slice_of_cells();
        near.over_images(Pull { drag: terms, points, mass, on_bodies });
    }
}
