//! How heavy the water beside a wall is, along its face.
//!
//! A ghost's pressure is that of the water around its mirror point, moved on by ∇p = ρ (g - a). Across the face the
//! water goes with the wall, and a is the wall's acceleration. Along the face no wall holds the water, and a is its own.
//! In a tip that falls freely the pressure is the same at all heights. Ghosts that saw it at rest would have less of it
//! the higher they are, and would draw the water next to the wall upwards.

use super::exchange::Exchange;
use super::ghosts::{Ghosts, Reflection};
use super::rules::GhostGravity;
use crate::body::Place;
use crate::math::simd::LANES;

/// A face rises if its normal has at least this part along x. Floors and tops of crests carry the water, as beds do.
const RISES: f64 = 0.45;

impl Exchange {
    /// What the water's own acceleration along a face adds to the head from its mean place around a target to another
    /// one, so far away, m²/s². It is no lighter than in free fall, and no more than twice as heavy as at rest.
    pub(super) fn falling(&self, ghosts: &Ghosts, target: usize, [x, y]: [f64; 2]) -> f64 {
        let body = ghosts.target_body[target / LANES] as usize;
        if self.rules.ghost_gravity != GhostGravity::Falling || body == Place::Bed.number() {
            return 0.0;
        }
        let [nx, ny] = match ghosts.reflection.get(target) {
            Some(Reflection::Plane { normal }) => *normal,
            Some(Reflection::Corner) => return 0.0,
            None => ghosts.bodies[body].plane.normal,
        };
        if nx.abs() < RISES {
            return 0.0;
        }
        let [along_x, along_y] = [-ny * nx.signum(), nx.abs()];
        let [ax, ay] = self.means[target / LANES].acceleration.map(|lanes| lanes[target % LANES]);
        let most = self.rules.gravity * along_y;
        let own = (along_x * ax + along_y * ay).clamp(-most, most);
        own * (along_x * x + along_y * y)
    }
}
