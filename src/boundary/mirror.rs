//! Laws of mirrors: what a ghost's velocity is, given the water's.

use super::exchange::Exchange;
use super::ghosts::{Ghosts, Reflection};
use crate::body::BodyMotion;
use crate::math::simd::LANES;

/// A ghost's mirrored velocity is at most this many times the water's.
const MIRROR_LIMIT: f64 = 3.0;

impl Exchange {
    /// u_w - (ū - u_w) d_ghost/d̄ across the wall; along it ū goes on (free slip) or, where `stuck`,
    /// is reversed likewise (no slip). d̄ is the distance of the water that ū was taken from.
    pub(super) fn mirrored_velocity(
        &self,
        ghosts: &Ghosts,
        g: usize,
        motion: &BodyMotion,
        stuck: bool,
    ) -> [f64; 2] {
        let (block, lane) = (g / LANES, g % LANES);
        if self.scale[block][lane] == 0.0 {
            return [motion.velocity, 0.0];
        }
        let means = &self.means[block];
        let relative = [means.vx[lane] - motion.velocity, means.vy[lane]];
        let x = ghosts.x[g] + motion.offset;
        let apart = [x - means.x[lane], ghosts.y[g] - means.y[lane]];
        let distance = ghosts.distance[g];
        let ratio = |across: f64| {
            if across <= distance * (1.0 + 1.0 / MIRROR_LIMIT) {
                MIRROR_LIMIT
            } else {
                distance / (across - distance)
            }
        };
        let mirrored = match ghosts.reflection[g] {
            Reflection::Corner => {
                let factor = ratio(apart[0].hypot(apart[1]));
                [-factor * relative[0], -factor * relative[1]]
            }
            Reflection::Plane { normal: [nx, ny] } => {
                let factor = ratio(apart[0] * nx + apart[1] * ny);
                let across = relative[0] * nx + relative[1] * ny;
                let along = [relative[0] - across * nx, relative[1] - across * ny];
                let kept = if stuck { -factor } else { 1.0 };
                [kept * along[0] - factor * across * nx, kept * along[1] - factor * across * ny]
            }
        };
        [mirrored[0] + motion.velocity, mirrored[1]]
    }
}
