//! The weight of the water beside a wall, along its face.
//!
//! A ghost's pressure is that of the water around its mirror point, extrapolated by ∇p = ρ (g - a).
//! Across the face the water moves with the wall, and a is the wall's acceleration. Along the face
//! no wall holds the water, and a is the water's own. In a tip that falls freely the pressure is
//! the same at all heights. Ghosts that took it to be at rest would have less pressure the higher
//! they are. They would draw the water next to the wall upwards.

use super::exchange::Exchange;
use super::ghosts::{Ghosts, Reflection};
use super::rules::GhostGravity;
use crate::body::Place;
use crate::math::simd::LANES;

/// A face rises if its normal has at least this part along x. Floors and tops of crests carry the
/// water as beds do.
const RISES: f64 = 0.45;

impl Exchange {
    /// The head that the water's own acceleration along a face adds, m²/s², from its mean place
    /// around a target to a place at this distance. The weight that results is between none (free
    /// fall) and twice that at rest.
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
