//! The waterline at the walls: wetness of a face, level of the water, and force on the face.

use super::exchange::Exchange;
use super::ghosts::Ghosts;
use super::open::Open;
use super::plane::Plane;
use super::profile::Profile;
use super::sums::Water;
use super::waterline::{corner_angle, wedge_fraction};
use crate::body::{BodyMotion, Place};
use crate::math::simd::SimdPath;

/// This many points of the bed in a row are dry at the water's edge. At a step lower than a
/// spacing, one or two may read as dry under deep water.
const EDGE: usize = 3;

impl Exchange {
    /// Turns the kernel coverage of the face points into a wetness: 2 Σ W V over its value in a
    /// full, endless body of water. It is 1/2 at the waterline of a vertical wall.
    pub(super) fn wet_faces(&mut self, ghosts: &Ghosts, bodies: &[BodyMotion]) {
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for face in body.faces.clone() {
                let complete =
                    if number == 0 && self.rules.bed_between_walls && ghosts.profile.is_none() {
                        let [left, right] = span(ghosts, bodies);
                        let x = ghosts.target_x[face];
                        self.share(x - left) + self.share(right - x) - 1.0
                    } else {
                        self.complete[face]
                    };
                self.wetness[face] *= 2.0 / complete.max(0.1);
            }
        }
    }

    /// The share that the bed leaves of the half discs around points of walls that rise from it.
    pub(super) fn complete_walls(&mut self, ghosts: &Ghosts) {
        if let Some(profile) = ghosts.profile.as_ref().and(ghosts.outline()) {
            self.complete_along(ghosts, profile, |_, _| true);
            self.complete_below_crest(ghosts);
            return;
        }
        for body in ghosts.bodies.iter().skip(1) {
            let Plane { point, normal } = body.plane;
            for face in body.faces.clone() {
                let [x, y] = [ghosts.target_x[face], ghosts.target_y[face]];
                self.complete[face] = if normal[1] == 0.0 {
                    self.share(y)
                } else {
                    let along = (x - point[0]).hypot(y - point[1]);
                    let at = along * self.rules.scaling.inverse_radius;
                    wedge_fraction(self.rules.kernel, at, corner_angle(body.plane))
                };
            }
        }
        if let Some(crest) = &ghosts.crest {
            // Farther down the wall is as an endless one.
            let reach = self.rules.scaling.support_radius;
            let above = crest.height - reach;
            let front = crest.ends[0];
            self.complete_along(ghosts, &crest.outline, |body, [x, y]| {
                let behind = crest.end.is_some() && body == Place::Behind.number();
                behind || y > above && (x != front || body != Place::Right.number())
            });
            self.complete_below_crest(ghosts);
        }
    }

    /// Makes a level surface at the face of a wall with a crest read as the surface. Below the top
    /// the wall is as an endless one. Above it, water also lies over the top.
    fn complete_below_crest(&mut self, ghosts: &Ghosts) {
        let Some(crest) = &ghosts.crest else { return };
        let open = ghosts.profile.as_ref().map(|bed| Open::of_endless(&self.rules, bed, ghosts));
        for face in ghosts.bodies[Place::Right.number()].faces.clone() {
            let place @ [x, y] = [ghosts.target_x[face], ghosts.target_y[face]];
            if x != crest.ends[0] {
                continue;
            }
            if y > crest.height {
                self.complete[face] = 2.0 * self.share(y - crest.height);
            } else if let Some(open) = &open {
                self.complete[face] = 2.0 * open.share(place);
            }
        }
    }

    /// The share that bed and walls leave of the discs around points of faces. It is for outlines
    /// other than a level bed between endless walls. `asks` chooses points by body and place,
    /// metres.
    fn complete_along(
        &mut self,
        ghosts: &Ghosts,
        outline: &Profile,
        asks: impl Fn(usize, [f64; 2]) -> bool,
    ) {
        let open = Open::of(&self.rules, outline, ghosts);
        let place = |face: usize| [ghosts.target_x[face], ghosts.target_y[face]];
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for face in body.faces.clone().filter(|&face| asks(number, place(face))) {
                self.complete[face] = 2.0 * open.share(place(face));
            }
        }
    }

    /// [`crate::kernel::KernelChoice::half_plane_fraction`] at a distance in metres, from a table.
    fn share(&self, distance: f64) -> f64 {
        let at = distance * self.rules.scaling.inverse_radius;
        if at.abs() >= 1.0 {
            return if at > 0.0 { 1.0 } else { 0.0 };
        }
        let place = at.abs() * 256.0;
        let k = (place as usize).min(255);
        let part = place - k as f64;
        let share = self.half_plane[k] * (1.0 - part) + self.half_plane[k + 1] * part;
        if at > 0.0 { share } else { 1.0 - share }
    }

    /// The share of a ghost that counts. It is zero 0.4 spacings above the waterline, one 0.4 spacings
    /// below.
    pub(super) fn wet_share(&self, body: usize, face: usize) -> f64 {
        self.waterlines[body].wet_share(self.wetness[face])
    }

    /// Level of the water along a wall, metres above the bed. It is the first place where the
    /// wetness falls to that of a level surface at this wall (1/2 for a vertical one). So it is
    /// connected to the water below. If the water ends on the bed, it is the level of that edge.
    /// `offset` is how far the body has moved, metres.
    pub fn level(&self, ghosts: &Ghosts, body: usize, offset: f64) -> f64 {
        if body == Place::Right.number()
            && let Some(edge) = self.shoreline(ghosts, offset)
        {
            return edge;
        }
        let faces = ghosts.bodies[body].faces.clone();
        let wetness = &self.wetness[faces.clone()];
        let heights = &ghosts.target_y[faces];
        let contact = self.waterlines[body].contact;
        let Some(dry) = wetness.iter().position(|&wet| wet < contact) else {
            return heights.last().copied().unwrap_or(0.0);
        };
        if dry == 0 {
            return ghosts.bodies[body].plane.point[1];
        }
        let part = (wetness[dry - 1] - contact) / (wetness[dry - 1] - wetness[dry]);
        heights[dry - 1] + part * (heights[dry] - heights[dry - 1])
    }

    /// Height of the water's edge on a bed that is not level, metres. Going up from the paddle, it
    /// is the first place from which the bed is less than half wet for [`EDGE`] points. A tongue is
    /// some one spacing thick there. None if the water reaches the wall, which has moved by
    /// `offset`, metres: a bed that ends level goes on behind the wall and is dry there. None if
    /// the wall stands in water of its own, as at rest or behind a ridge that has run dry.
    fn shoreline(&self, ghosts: &Ghosts, offset: f64) -> Option<f64> {
        ghosts.profile.as_ref().filter(|_| !ghosts.lagoon)?;
        // If the wall has come nearer, no place before it is cut off as it is at rest.
        let near = if offset < 0.0 { self.rules.scaling.support_radius } else { 0.0 };
        let end = ghosts.bodies[Place::Right.number()].plane.point[0] + offset.min(0.0) - near;
        let faces = ghosts.bodies[0].faces.clone();
        let before = ghosts.target_x[faces.clone()].partition_point(|&x| x < end);
        let faces = faces.start..faces.start + before;
        let wetness = &self.wetness[faces.clone()];
        let heights = &ghosts.target_y[faces];
        let from = |place: usize| &wetness[place..wetness.len().min(place + EDGE)];
        let edge = (0..wetness.len()).find(|&place| from(place).iter().all(|&wet| wet < 0.5))?;
        // Behind a ridge that has run dry, the water at the wall counts.
        let foot = heights.last()? + 0.5 * self.rules.spacing;
        let at_wall = from(wetness.len().saturating_sub(EDGE)).iter().all(|&wet| wet >= 0.5);
        if at_wall && heights[edge..].iter().any(|&height| height > foot) {
            return None;
        }
        let Some(before) = edge.checked_sub(1) else { return Some(heights[0]) };
        let part = (wetness[before] - 0.5) / (wetness[before] - wetness[edge]);
        Some(heights[before] + part * (heights[edge] - heights[before]))
    }

    /// Integral of the interpolated pressure over the face of a wall, along x, N per metre of
    /// width. It checks the momentum reaction, and shares nothing with it but the particles.
    pub fn face_force(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        body: usize,
        motion: &BodyMotion,
        water: Water<'_>,
    ) -> f64 {
        let faces = ghosts.bodies[body].faces.clone();
        let [across, _] = ghosts.bodies[body].plane.normal;
        // The distance between rows comes from whole rows in the depth. It is not the spacing along
        // the bed.
        if faces.len() < 2 {
            return 0.0;
        }
        let [a, b] = [faces.start, faces.start + 1];
        let apart = [&ghosts.target_x, &ghosts.target_y].map(|places| places[b] - places[a]);
        let spacing = apart[0].hypot(apart[1]);
        self.weigh_face(path, ghosts, (body, motion), water, self.rules.interpolator);
        faces
            .map(|face| {
                let wet = self.wet_share(body, face);
                let pressure = self.moved_to_face(ghosts, motion, face);
                let height = ghosts.crest.as_ref().map_or(spacing, |crest| {
                    crest.below([ghosts.target_x[face], ghosts.target_y[face]], spacing)
                });
                wet * pressure * height * across.abs()
            })
            .sum()
    }
}

/// Toes of the bodies 1 and 2, where the bed ends. Behind a wall at the end of a slope there is no
/// bed to be cut off.
pub(super) fn span(ghosts: &Ghosts, bodies: &[BodyMotion]) -> [f64; 2] {
    let face = |body: usize| ghosts.bodies[body].plane.point[0] + bodies[body].offset;
    [face(1), if ghosts.end_on_slope() { f64::MAX } else { face(2) }]
}
