//! Viscosity: that of the fluid, and that of the scheme on what a linear velocity leaves.

use std::cell::Cell;

use super::images::Point;
use crate::pairs::{Eight, Here, Near, Neighbour, Other, Pair, Real, Record, Term};

/// Viscous accelerations: 2 ν Σ F (u_j - u_i), Liang et al. 2017, Eq. 3, and α h c Σ F π Δ with π =
/// (u_j - u_i)·Δ/r² less what a linear, divergence-free velocity gives, limited so that every pair
/// dissipates or does nothing. F = -g, Δ = r_j - r_i; both signs cancel.
#[derive(Clone, Copy)]
struct Drag<'a> {
    /// Of every point, images too: u, and the strain in place of the pressure.
    records: &'a [Record],
    points: &'a [Point],
    /// α h c.
    artificial: f64,
    /// 2 ν.
    physical: f64,
    /// What Δ² is taken for at least, m².
    least: f64,
    /// m_i, padded.
    mass: &'a [f64],
    /// What the water does to the bodies, whose images do this to the water.
    on_bodies: &'a [Cell<f64>],
}

impl Term for Drag<'_> {
    /// Velocity and strain, and the mass.
    type Own<R: Real> = ([R; 4], R);
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> ([R; 4], R) {
        let slots = [Record::VX, Record::VY, Record::PRESSURE, Record::PRESSURE_XY];
        (here.slots(self.records, slots), here.of(self.mass))
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        &([u, v, p, q], mass): &([R; 4], R),
        pair: &Pair<R>,
        other: Other<'_, N>,
        [along, up]: &mut [R; 2],
    ) {
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
        let factor = pair.slope() * (R::splat(self.artificial) * left).div(square);
        let weight = pair.slope() * R::splat(self.physical);
        let (x, y) = (factor.mul_add(dx, weight * du), factor.mul_add(dy, weight * dv));
        *along += x;
        *up += y;
        // The images come behind the water and its padding.
        if other.number >= self.mass.len() {
            let force = &self.on_bodies[self.points[other.number].body as usize];
            force.set(force.get() - (mass * x).total());
        }
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
    /// Adds viscous accelerations to `drag`, and what they do to the bodies to `on_bodies`. Velocities
    /// are in the records; the strain of the water comes in place of its pressure.
    pub fn drag(
        &self,
        (near, points): (&mut Near, &[Point]),
        (strain, mass): (&[[f64; 2]], &[f64]),
        (drag, on_bodies): (&mut [[f64; 2]], &mut [f64]),
    ) {
        if self.artificial + self.physical == 0.0 {
            return;
        }
        for (at, point) in near.records.iter_mut().zip(points) {
            let [p, q] = strain[point.original as usize];
            at.set_pressure(point.turned_tensor([p, q, -p]));
        }
        let terms = Drag {
            records: &near.records,
            points,
            artificial: self.artificial,
            physical: 2.0 * self.physical,
            least: 1e-12 * self.spacing * self.spacing,
            mass,
            on_bodies: Cell::from_mut(on_bodies).as_slice_of_cells(),
        };
        near.sum(terms, |i, found| drag[i] = found);
    }
}
