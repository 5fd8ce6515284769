//! Parting: keeps particles near the surface evenly spread.
//!
//! Water that climbs a wall is stretched upwards and pressed together across, and so are its
//! particles. The row at the tip became a line with four particles to a spacing, two and a half
//! spacings above the next row. The support of such a line is too poor for the pressure that lifts
//! it. An exactly divergence-free flow has no noise to break it up. Shifting along ∇C stops short
//! of the surface, because it would push the surface outwards.

use super::images::Point;
use crate::pairs::{Fluid, Near};
use crate::water::shifted_share;

/// Pairs closer than this many particle spacings are moved apart ...
const CLOSE: f64 = 0.8;
/// ... by at most this many in a step.
const LIMIT: f64 = 0.1;

/// The neighbourhood of the water, and how far pairs are moved apart.
pub(super) struct Parting<'a> {
    pub near: &'a Near,
    pub points: &'a [Point],
    /// See [`Operators`](super::operators::Operators).
    pub completeness: &'a [f64],
    /// A, the strength of shifting.
    pub strength: f64,
    /// Completenesses of the support between which shifting takes over.
    pub fades_in: [f64; 2],
    /// Particle spacing, metres.
    pub spacing: f64,
    /// The time step, seconds.
    pub dt: f64,
}

impl Parting<'_> {
    /// Moves pairs near the surface that are closer than r0 = 0.8 Δx apart, each by
    ///
    /// δr = -λ (1 - r/r0) Δ/r, λ = min(2A |u| Δt, 0.1 Δx),
    ///
    /// Here |u| is the pair's mean speed and A the strength of shifting. It acts to the share to
    /// which the surface switches shifting off. The moves of a pair are equal and opposite. So the
    /// water's centre of mass stays, except for pairs with images. Returns Σ m δy, kg m per metre.
    pub fn part(&self, fluid: &mut Fluid) -> f64 {
        let per_speed = 2.0 * self.strength * self.dt;
        let (reach, limit) = (CLOSE * self.spacing, LIMIT * self.spacing);
        let [x, y] = &self.near.places;
        let mut lifted = 0.0;
        for i in 0..fluid.len() {
            let own = self.near_surface_share(i);
            if own == 0.0 {
                continue;
            }
            for &e in self.near.around(i) {
                let e = e as usize;
                let (dx, dy) = (x[e] - x[i], y[e] - y[i]);
                let square = dx * dx + dy * dy;
                if square >= reach * reach || square < 1e-12 * reach * reach {
                    continue;
                }
                let j = self.points[e].original as usize;
                let other = self.near_surface_share(j);
                let length = (0.5 * per_speed * (fluid.speed(i) + fluid.speed(j))).min(limit);
                let factor = 0.5 * (own + other) * length * (1.0 / square.sqrt() - 1.0 / reach);
                let (dx, dy) = (factor * dx, factor * dy);
                lifted += shove(fluid, i, [-dx, -dy]);
                if other == 0.0 {
                    // j's own turn leaves this pair out.
                    let [a, b, c, d] = self.points[e].turn;
                    lifted += shove(fluid, j, [a * dx + c * dy, b * dx + d * dy]);
                }
            }
        }
        lifted
    }

    /// 1 where shifting is off because of the surface, 0 where it acts in full.
    fn near_surface_share(&self, i: usize) -> f64 {
        1.0 - shifted_share(self.completeness[i], self.fades_in)
    }
}

/// Moves a particle; returns its mass times how far it rises.
fn shove(fluid: &mut Fluid, i: usize, [dx, dy]: [f64; 2]) -> f64 {
    fluid.x[i] += dx;
    fluid.y[i] += dy;
    fluid.mass[i] * dy
}
