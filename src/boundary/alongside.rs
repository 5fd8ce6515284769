//! A bed that gives back, beside walls that move (see `giving.rs`).
//!
//! Water at a wall's foot moves along the bed with the wall, and the bed's ghosts end there. So a
//! ghost has water on one side only. Water that moves along the bed then counts as a flow into the
//! ghost: D_g, which the water around its mirror point gives. A particle has ghosts on one side
//! only, and seems to flow away from them.
//!
//! The sum of both is zero. But a ghost takes from all the water around it, which is farther from
//! the corner, so water gathers in the corner. So both use velocities relative to U = t
//! (U_w·n)/(t·n) within the support radius R of a wall. U is the velocity of water that moves along
//! the bed (t) and with the wall (n). Beyond R each of the two parts is zero by itself. No energy
//! is made: what is taken out of both parts has the same pressure, except for its change over R.

use super::ghosts::{Ghosts, Reflection};
use super::plane::Plane;
use crate::body::{BodyMotion, Place};
use crate::math::simd::{LANES, Lanes};

/// The walls with which water may move.
pub(super) const WALLS: [Place; 2] = [Place::Left, Place::Right];

/// The least sine of the angle between wall and bed. A wall nearly in line with the bed pushes no
/// water along it.
const ACROSS: f64 = 0.25;

/// U per velocity of each wall, at eight ghosts, along x and up.
type Share = [[[f64; LANES]; 2]; 2];

/// The velocity U along the bed beside moving walls.
#[derive(Debug, Clone, Default)]
pub struct Alongside {
    shares: Vec<Share>,
    /// The walls' faces over the support radius: normal, and the face's distance along it.
    faces: [[f64; 3]; 2],
}

impl Alongside {
    /// Finds which of the bed's blocks lie beside which wall. The bed's offset and the support
    /// radius are in metres. Ghosts within two support radii count: water within one radius of the
    /// wall has those in reach.
    pub(super) fn find(
        &mut self,
        (ghosts, walls): (&Ghosts, &[Plane; 2]),
        offset: f64,
        radius: f64,
        blocks: &[u32],
    ) {
        let bed = Place::Bed.number();
        self.faces = walls
            .map(|Plane { point: [x, y], normal: [nx, ny] }| [nx, ny, (nx * x + ny * y) / radius]);
        self.shares.resize(ghosts.bodies[bed].ghosts.len() / LANES, Share::default());
        for &block in blocks {
            let share = &mut self.shares[block as usize];
            *share = Share::default();
            for (wall, [along_x, along_y]) in walls.iter().zip(share) {
                for (lane, share) in along_x.iter_mut().zip(along_y).enumerate() {
                    let g = block as usize * LANES + lane;
                    let place = [ghosts.x[g] + offset, ghosts.y[g]];
                    let Reflection::Plane { normal: [nx, ny] } = ghosts.reflection[g] else {
                        continue;
                    };
                    let along = [-ny, nx];
                    let across = along[0] * wall.normal[0] + along[1] * wall.normal[1];
                    if wall.beyond(place) > -2.0 * radius && across.abs() > ACROSS {
                        let speed = wall.normal[0] / across;
                        (*share.0, *share.1) = (speed * along[0], speed * along[1]);
                    }
                }
            }
        }
    }

    /// How far places, over the support radius, lie behind the nearest wall; negative in the water.
    #[inline(always)]
    pub fn beyond<L: Lanes>(&self, [x, y]: [L; 2]) -> L {
        let [left, right] = self
            .faces
            .map(|[nx, ny, face]| L::splat(nx).mul_add(x, L::splat(ny).mul_sub(y, L::splat(face))));
        left.max(right)
    }

    /// U at a block of the bed's ghosts, m/s.
    #[inline(always)]
    pub(super) fn velocity<L: Lanes>(&self, block: usize, bodies: &[BodyMotion]) -> [L; 2] {
        let [left, right] = &self.shares[block];
        let [from_left, from_right] = WALLS.map(|place| L::splat(bodies[place.number()].velocity));
        std::array::from_fn(|part| {
            from_left.mul_add(L::load(&left[part]), from_right * L::load(&right[part]))
        })
    }
}
