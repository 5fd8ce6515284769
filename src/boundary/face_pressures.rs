//! Pressures along a wall's face, from the water that the first ghosts behind it mirror.

use std::ops::Range;

use super::exchange::Exchange;
use super::ghosts::Ghosts;
use crate::body::{BodyMotion, Place};
use crate::math::simd::LANES;

impl Ghosts {
    /// The points up a body's face; none if there is no such body. Points of the back of a wall
    /// with a crest come after them and are left out.
    pub fn up(&self, body: usize) -> Range<usize> {
        let faces = self.bodies.get(body).map_or(0..0, |body| body.faces.clone());
        let crest = self.crest.as_ref().filter(|_| body == Place::Right.number());
        let is_up = |x: &f64| crest.is_none_or(|crest| *x == crest.ends[0]);
        faces.start..faces.start + self.target_x[faces].partition_point(is_up)
    }
}

impl Exchange {
    /// The ghost next to each point of a body's face: the nearest of those whose wetness the point
    /// gives.
    pub(super) fn fronts(ghosts: &Ghosts) -> Vec<Option<u32>> {
        let first = ghosts.len();
        let mut fronts: Vec<Option<u32>> = vec![None; ghosts.target_x.len() - first];
        for g in (0..first).filter(|&g| ghosts.volume[g] > 0.0) {
            let Some(at) = (ghosts.face[g] as usize).checked_sub(first) else { continue };
            let Some(front) = fronts.get_mut(at) else { continue };
            if front.is_none_or(|other| ghosts.distance[g] < ghosts.distance[other as usize]) {
                *front = Some(g as u32);
            }
        }
        fronts
    }

    /// The water's pressure at every point up a body's face, Pa; 0 where it is dry. It is the mean
    /// around the mirror point of the next ghost, moved to the face. It needs no interpolation of
    /// its own.
    pub fn face_pressures(
        &self,
        ghosts: &Ghosts,
        body: usize,
        motion: &BodyMotion,
        pressures: &mut Vec<f64>,
    ) {
        let pressure = |face: usize| {
            let wet = self.wet_share(body, face);
            let front = self.fronts[face - ghosts.len()].filter(|_| wet > 0.0);
            front.map_or(0.0, |g| wet * self.moved_to_face(ghosts, motion, g as usize, face))
        };
        pressures.clear();
        pressures.extend(ghosts.up(body).map(pressure));
    }

    /// The water's pressure at a point of a face, Pa; 0 where no water is near. `from` is the
    /// target, a ghost or a face point, around which the mean was taken. The weight of the water
    /// between moves the mean to the face: p = p_m - ρ (g (y - y_m) + a (x - x_m)), with the effect
    /// of the water's own acceleration.
    pub(super) fn moved_to_face(
        &self,
        ghosts: &Ghosts,
        motion: &BodyMotion,
        from: usize,
        face: usize,
    ) -> f64 {
        let (block, lane) = (from / LANES, from % LANES);
        if self.scale[block][lane] == 0.0 {
            return 0.0;
        }
        let means = &self.means[block];
        let x = ghosts.target_x[face] + motion.offset - means.x[lane];
        let y = ghosts.target_y[face] - means.y[lane];
        let falling = self.falling(ghosts, from, [x, y]);
        let head = self.rules.gravity * y + motion.acceleration * x + falling;
        means.pressure[lane] - self.density(from) * head
    }
}
