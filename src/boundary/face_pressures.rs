//! Pressures along a wall's face.

use std::ops::Range;

use super::exchange::Exchange;
use super::ghosts::Ghosts;
use super::sums::Water;
use super::{AMPLIFICATION_LIMIT, InterpolatorChoice, MlsLinear, Normalized};
use crate::body::{BodyMotion, Place};
use crate::math::simd::{LANES, SimdPath};

impl Ghosts {
    /// The points up a body's face; none if there is no such body. Points of the back of a wall
    /// with a crest come after them and are left out.
    pub fn up(&self, body: usize) -> Range<usize> {
        let faces = self.bodies.get(body).map_or(0..0, |body| body.faces.clone());
        let crest = self.crest.as_ref().filter(|_| body == Place::Right.number());
        let is_up = |face: &usize| {
            let [x, y] = [self.target_x[*face], self.target_y[*face]];
            crest.is_none_or(|crest| x == crest.ends[0] && y <= crest.height)
        };
        faces.start..faces.clone().find(|face| !is_up(face)).unwrap_or(faces.end)
    }
}

impl Exchange {
    /// The water's pressure at every point up a body's face, Pa; 0 where it is dry. Moving least
    /// squares find it, whatever gives the ghosts their values: in a thin jet the nearest particle
    /// alone may have twice the pressure of the water around it. Across a wall the pressure has no
    /// slope, so in even water they differ little from the mean around the point. Where particles
    /// lie apart at the wall they may follow noise: the difference is at most a row's weight.
    pub fn face_pressures(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        (body, motion): (usize, &BodyMotion),
        water: Water<'_>,
        pressures: &mut Vec<f64>,
    ) {
        let amplification_limit = AMPLIFICATION_LIMIT;
        let smooth = InterpolatorChoice::MlsLinear(MlsLinear { amplification_limit });
        let mean = InterpolatorChoice::Normalized(Normalized);
        self.weigh_face(path, ghosts, (body, motion), water, mean);
        pressures.clear();
        pressures.extend(ghosts.up(body).map(|face| self.moved_to_face(ghosts, motion, face)));
        self.weigh_face(path, ghosts, (body, motion), water, smooth);
        let most = self.rules.surface_density * self.rules.gravity * self.rules.spacing;
        for (face, pressure) in ghosts.up(body).zip(pressures) {
            let wet = self.wet_share(body, face);
            let near = self.moved_to_face(ghosts, motion, face);
            let near = near.max(*pressure - most).min(*pressure + most);
            *pressure = if wet > 0.0 { wet * near } else { 0.0 };
        }
    }

    /// Weights and means at the points of a body's face. The body has this motion, the others
    /// stand.
    pub(super) fn weigh_face(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        (body, motion): (usize, &BodyMotion),
        water: Water<'_>,
        interpolator: InterpolatorChoice,
    ) {
        let faces = &ghosts.bodies[body].faces;
        let blocks = faces.start / LANES..faces.end.div_ceil(LANES);
        let mut bodies = std::mem::take(&mut self.motions);
        bodies.clear();
        bodies.resize(ghosts.bodies.len(), BodyMotion::default());
        bodies[body] = *motion;
        self.weigh_blocks(path, (ghosts, &bodies), water, blocks, interpolator);
        self.motions = bodies;
    }

    /// The water's pressure at a point of a face, Pa; 0 where no water is near. The weight of the
    /// water between moves the mean to the face: p = p_m - ρ (g (y - y_m) + a (x - x_m)). The
    /// water's own acceleration counts, too.
    pub(super) fn moved_to_face(&self, ghosts: &Ghosts, motion: &BodyMotion, face: usize) -> f64 {
        let (block, lane) = (face / LANES, face % LANES);
        if self.scale[block][lane] == 0.0 {
            return 0.0;
        }
        let means = &self.means[block];
        let x = ghosts.target_x[face] + motion.offset - means.x[lane];
        let y = ghosts.target_y[face] - means.y[lane];
        let falling = self.falling(ghosts, face, [x, y]);
        let head = self.rules.gravity * y + motion.acceleration * x + falling;
        means.pressure[lane] - self.density(face) * head
    }
}
