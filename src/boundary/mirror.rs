//! The velocity of a ghost, from that of the water.

use super::exchange::Exchange;
use super::ghosts::{Ghosts, Reflection};
use crate::body::BodyMotion;
use crate::math::simd::LANES;

/// A ghost's mirrored velocity is at most this many times the water's.
const MIRROR_LIMIT: f64 = 3.0;

impl Exchange {
    /// A ghost's velocity relative to its wall per that of the water: xx, xy, yy. Across the wall
    /// it is reversed, times the ghost's distance over that of the water's mean place. Along the
    /// wall it is the water's (free slip). If `stuck`, it is reversed there in the same way (no
    /// slip).
    pub(super) fn mirror(
        &self,
        ghosts: &Ghosts,
        g: usize,
        motion: &BodyMotion,
        stuck: bool,
    ) -> [f64; 3] {
        let (means, lane) = (&self.means[g / LANES], g % LANES);
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
        match ghosts.reflection[g] {
            Reflection::Corner => {
                let factor = ratio((apart[0] * apart[0] + apart[1] * apart[1]).sqrt());
                [-factor, 0.0, -factor]
            }
            Reflection::Plane { normal: [nx, ny] } => {
                let factor = ratio(apart[0] * nx + apart[1] * ny);
                let kept = if stuck { -factor } else { 1.0 };
                let less = kept + factor;
                [kept - less * nx * nx, -less * nx * ny, kept - less * ny * ny]
            }
        }
    }
}
