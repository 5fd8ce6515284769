//! The free surface: which particles are at it, and where its zero pressure takes hold.

use super::Isph;
use super::images::Points;
use super::lists::{Lists, Numbers};
use super::state::Operators;
use super::sums::pull;
use crate::math::simd::{LANES, Lanes, Task, dispatch};

/// A particle is at the surface where ∇·r is below this (Liang et al. 2017, Eq. 13).
pub(super) const SURFACE_DIVERGENCE: f64 = 1.5;
/// The surface lies this far outside the centres of its particles, in spacings.
const SKIN: f64 = 0.5;
/// No particle is closer to the surface than this, in spacings.
const CLOSEST: f64 = 0.25;

/// Where the surface particles hold those in their reach, eight of these at a time.
struct Surface<'a> {
    lists: Lists<'a>,
    numbers: &'a [Numbers],
    points: &'a Points,
    at_surface: &'a [bool],
    /// Σ F of each particle, and of one with full support.
    weight: &'a [f64],
    full_weight: f64,
    spacing: f64,
    grip: &'a mut [f64],
}

impl Surface<'_> {
    /// Holds a particle by the surface particles in reach: Σ F of them, of how high they are over it, and
    /// of their normal.
    fn hold(&mut self, i: usize, [sum, height, up_x, up_y]: [f64; 4]) {
        let distance = (SKIN * self.spacing + height / sum).max(CLOSEST * self.spacing);
        let length = (up_x * up_x + up_y * up_y).sqrt().max(1e-300);
        let [sx, sy] = self.lists.sway[i];
        let outwards = -(sx * up_x + sy * up_y) / length;
        let missing = (self.full_weight - self.weight[i]).max(0.0);
        self.grip[i] = 2.0 * (outwards / distance).max(missing);
    }
}

/// Outwards: away from where the neighbours are.
fn normal([sx, sy]: [f64; 2]) -> [f64; 2] {
    let length = (sx * sx + sy * sy).sqrt();
    if length > 0.0 { [-sx / length, -sy / length] } else { [0.0, 1.0] }
}

impl Task for Surface<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Surface { lists, numbers, points, at_surface, .. } = self;
        for cluster in 0..at_surface.len().div_ceil(LANES) {
            let place = lists.place::<L>(cluster);
            let mut sums = [L::splat(0.0); 4];
            let (near, weights) = lists.of(cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let e = e as usize;
                let original = points.original[e] as usize;
                if !at_surface[original] {
                    continue;
                }
                let [nx, ny] = normal(lists.sway[original]);
                let [a, b, c, d] = points.turn[e];
                let to = [L::splat(a * nx + b * ny), L::splat(c * nx + d * ny)];
                let [gx, gy] = pull(weights, &numbers[e], place);
                let f = L::load(weights);
                sums[0] += f;
                sums[1] = gx.mul_add(to[0], gy.mul_add(to[1], sums[1]));
                sums[2] = f.mul_add(to[0], sums[2]);
                sums[3] = f.mul_add(to[1], sums[3]);
            }
            let sums = L::to_arrays(sums);
            for lane in 0..LANES.min(at_surface.len() - cluster * LANES) {
                if sums[0][lane] > 0.0 {
                    let [sum, height, x, y] = &sums;
                    let sums = [sum[lane], height[lane], x[lane], y[lane]];
                    self.hold(cluster * LANES + lane, sums);
                }
            }
        }
    }
}

impl Isph {
    /// Finds surface particles by ∇·r = Σ V_j (r_j - r_i)·∇_iW_ij < 1.5 (Eq. 13, sign corrected) and
    /// sets the condition p = 0 half a spacing outside them.
    ///
    /// Not the surface particle's own pressure is zero: that would put the surface half a spacing
    /// too low. The part of a particle's support that sticks out of the water is thought filled
    /// with points whose pressure goes on linearly from p_i through zero at the surface, at the
    /// distance d_i. Their sum 2 Σ F (p_v - p_i) is -2 |s_i|/d_i p_i, s_i = Σ F Δ over what is there:
    /// a term on the diagonal alone, exact for a linear pressure (compare Nair & Tomar 2014, whose
    /// full-support diagonal 2 (Σ_full F - Σ F) is its lower bound here).
    pub(super) fn find_surface(&mut self) {
        let Operators { at_surface, moment, sway, correction, weight, grip, .. } =
            &mut self.operators;
        at_surface.clear();
        at_surface.extend(moment.iter().map(|[xx, _, yy]| xx + yy < SURFACE_DIVERGENCE));
        let places = [&self.points.x[..], &self.points.y[..]];
        let surface = Surface {
            lists: Lists { pairs: &self.pairs, weights: &self.weights, places, sway, correction },
            numbers: &self.numbers,
            points: &self.points,
            at_surface,
            weight,
            full_weight: self.full_weight,
            spacing: self.options.spacing,
            grip,
        };
        dispatch(self.path, surface);
    }
}
