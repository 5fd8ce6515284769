//! The waterline at the walls: how wet a face is, how high the water stands, how hard it presses.

use super::exchange::Exchange;
use super::ghosts::Ghosts;
use super::sums::{Interpolate, Water};
use crate::body::BodyMotion;
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::{with_interpolator, with_kernel};

impl Exchange {
    /// Turns the kernel coverage of the face points into a wetness: 2 Σ W V over what a full,
    /// endless body of water would give there; 1/2 at the waterline.
    pub(super) fn wet_faces(&mut self, ghosts: &Ghosts, bodies: &[BodyMotion]) {
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for face in body.faces.clone() {
                let complete = if self.rules.bed_between_walls {
                    self.completeness(ghosts, bodies, number, face)
                } else {
                    1.0
                };
                self.wetness[face] *= 2.0 / complete.max(0.1);
            }
        }
    }

    /// Share of a face point's half disc of water that other walls leave.
    fn completeness(
        &self,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        number: usize,
        face: usize,
    ) -> f64 {
        if number > 0 {
            return self.share(ghosts.target_y[face]);
        }
        let [left, right] = span(ghosts, bodies);
        let x = ghosts.target_x[face];
        self.share(x - left) + self.share(right - x) - 1.0
    }

    /// [`KernelChoice::half_plane_fraction`] at a distance in metres, from a table.
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

    /// How much of a ghost counts: nothing half a spacing above the waterline, all of it half a
    /// spacing below.
    pub(super) fn wet_share(&self, face: usize) -> f64 {
        ((self.wetness[face] - self.dry_at) / (self.wet_at - self.dry_at)).clamp(0.0, 1.0)
    }

    /// Level of the water along an upright body, metres above the bed: the crossing of
    /// wetness 1/2 that is connected to the water below.
    pub fn level(&self, ghosts: &Ghosts, body: usize) -> f64 {
        let faces = ghosts.bodies[body].faces.clone();
        let wetness = &self.wetness[faces.clone()];
        let heights = &ghosts.target_y[faces];
        let Some(dry) = wetness.iter().position(|&wet| wet < 0.5) else {
            return heights.last().copied().unwrap_or(0.0);
        };
        if dry == 0 {
            return 0.0;
        }
        let part = (wetness[dry - 1] - 0.5) / (wetness[dry - 1] - wetness[dry]);
        heights[dry - 1] + part * (heights[dry] - heights[dry - 1])
    }

    /// Integral of the interpolated pressure over the face of an upright body, N per metre of
    /// width: a check on the momentum reaction that shares nothing with it but the particles.
    pub fn face_force(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        body: usize,
        motion: &BodyMotion,
        water: Water<'_>,
    ) -> f64 {
        let faces = ghosts.bodies[body].faces.clone();
        let rules = self.rules;
        let blocks = faces.start / LANES..faces.end.div_ceil(LANES);
        let Exchange { list, weights, scale, means, .. } = self;
        with_kernel!(rules.kernel, K => with_interpolator!(rules.interpolator, interpolator => {
            dispatch(path, Interpolate::<K, _> {
                interpolator,
                scaling: rules.scaling,
                ghosts,
                offset: motion.offset,
                water,
                list,
                weights,
                scale,
                means,
                blocks,
                kernel: std::marker::PhantomData,
            });
        }));
        faces
            .map(|face| {
                let (block, lane) = (face / LANES, face % LANES);
                let wet = self.wet_share(face);
                if self.scale[block][lane] == 0.0 {
                    return 0.0;
                }
                let means = &self.means[block];
                let mean = means.pressure[lane];
                let density =
                    rules.surface_density + mean / (rules.sound_speed * rules.sound_speed);
                let reach_x = ghosts.target_x[face] + motion.offset - means.x[lane];
                let reach_y = ghosts.target_y[face] - means.y[lane];
                let pressure =
                    mean - density * (rules.gravity * reach_y + motion.acceleration * reach_x);
                wet * pressure * rules.spacing
            })
            .sum()
    }
}

/// Faces of the bodies 1 and 2: the ends of the bed.
pub(super) fn span(ghosts: &Ghosts, bodies: &[BodyMotion]) -> [f64; 2] {
    let face = |body: usize| ghosts.target_x[ghosts.bodies[body].faces.start] + bodies[body].offset;
    [face(1), face(2)]
}
