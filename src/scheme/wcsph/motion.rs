//! Velocities and places: kick, drift, and what keeps particles evenly spread.

use super::shifting::Shift;
use super::volume::Restore;
use super::{Wcsph, WcsphOptions};
use crate::body::{BodyMotion, Place};
use crate::boundary::Plane;
use crate::math::simd::dispatch;
use crate::pairs::{Fluid, Ramp};
use crate::water::HoldInside;

/// Hydrostatic density diffusion fades in from this completeness ... Near the surface the discrete
/// balance differs from the exact one, and diffusion would always work against it.
const DIFFUSE_FROM: f64 = 0.9;
/// ... to this one, where it is full.
const DIFFUSE_FULL: f64 = 0.99;

/// Most by which the extrapolation changes any component of a correction. Waves up to H/h = 0.3
/// stay below. Where a jet lands, the correction may change by half within a full step. That change
/// says nothing of the next one.
const MOST_TAKEN_ON: f64 = 0.1;

impl Wcsph {
    /// Adds to the accelerations the effect of the wall's own acceleration, and the field.
    pub(super) fn complete_accelerations(&mut self, wall_acceleration: f64) {
        let (fluid, work) = (&self.fluid, &mut self.work);
        if wall_acceleration != 0.0 {
            for tally in self.pairs.tallies() {
                let accelerations = [&mut *work.acceleration_x, &mut *work.acceleration_y];
                tally.add_responses(wall_acceleration, accelerations);
            }
        }
        if let Some(field) = self.options.field {
            for k in 0..fluid.len() {
                let [x, y] = field.acceleration([fluid.x[k], fluid.y[k]]);
                work.acceleration_x[k] += x;
                work.acceleration_y[k] += y;
            }
        }
    }

    /// Finds the share of each particle in the density diffusion until the next full step.
    pub(super) fn find_diffused_shares(&mut self) {
        if self.options.density_diffusion.reads().fades {
            let (values, shares) = (&*self.work.completeness, &mut *self.work.diffused_share);
            let (from, to) = (DIFFUSE_FROM, DIFFUSE_FULL);
            dispatch(self.pairs.path, Ramp { values, from, to, shares });
        }
    }

    /// The walls' faces at the end of a step.
    pub(super) fn move_planes(&mut self, dt: f64, bodies: &[BodyMotion]) {
        self.planes.clear();
        self.planes.extend(
            self.ghosts
                .bodies
                .iter()
                .zip(bodies)
                .map(|(body, motion)| body.plane.moved(motion.offset).moved(dt * motion.velocity)),
        );
        if self.ghosts.crest.is_some() {
            // Here the outline is the wall: water may go over it.
            let wall = &mut self.planes[Place::Right.number()];
            *wall = Plane::nowhere(wall.normal);
        }
        if self.ghosts.keeps_behind() {
            // The floor behind the wall may lie lower.
            let bed = &mut self.planes[Place::Bed.number()];
            *bed = Plane::nowhere(bed.normal);
        }
    }

    /// Shifts the particles, if that is wanted, for the time since the last full step. Returns the
    /// energy that is lost.
    pub(super) fn shift(&mut self, fades_in: [f64; 2]) -> f64 {
        let n = self.fluid.padded_len();
        let Fluid { x, y, vx, vy, density, mass, .. } = &mut self.fluid;
        let shift = Shift {
            mass,
            velocity: [vx, vy],
            work: &self.work,
            options: &self.options,
            planes: &self.planes,
            bed: self.ghosts.outline(),
            strain: &self.strain,
            fades_in,
            dt: self.since_full,
            inverse_radius: self.scaling.inverse_radius,
        };
        let rows = [&mut x[..n], &mut y[..n], &mut density[..n]];
        -self.pairs.sum_each(rows, &shift)
    }

    /// Corrects the volume that was lost since the last full step, if that is wanted. Returns the
    /// energy that is lost.
    pub(super) fn restore_volume(&mut self) -> f64 {
        let Some(shortfall) = &self.shortfall else { return 0.0 };
        let options = &self.options;
        let n = self.fluid.padded_len();
        let Fluid { density, mass, .. } = &mut self.fluid;
        let restore = Restore {
            mass,
            work: &self.work,
            options,
            shortfall,
            rate: options.volume_feedback
                * options.state.sound_speed
                * self.scaling.inverse_radius
                * self.since_full,
        };
        -self.pairs.sum_each(&mut density[..n], &restore)
    }

    /// Holds the particles in front of the walls. Returns the energy that is lost.
    pub(super) fn hold_inside(&mut self, bodies: &[BodyMotion]) -> f64 {
        let (n, all) = (self.fluid.padded_len(), self.fluid.len());
        let WcsphOptions { spacing, gravity, .. } = self.options;
        let Fluid { x, y, vx, vy, mass, .. } = &mut self.fluid;
        let walls = (&self.ghosts, &*self.planes, bodies);
        let hold = HoldInside::of((all, mass), [spacing, gravity], walls);
        let rows = [[x, y], [vx, vy]].map(|pair| pair.map(|field| &mut field[..n]));
        -self.pairs.sum_each(rows, &hold)
    }

    /// Takes the correction that the last pass has found for the coming full step. With
    /// `extrapolated_correction` its last change is added once more: L + (L - L_before). The change
    /// is at most [`MOST_TAKEN_ON`]. The first correction has none.
    ///
    /// Without this, the correction lags and the pressure always pushes a little too late. This
    /// feeds waves.
    pub(super) fn take_next_correction(&mut self) {
        let work = &mut self.work;
        if self.options.extrapolated_correction {
            let next = [
                &mut work.next_correction_xx,
                &mut work.next_correction_xy,
                &mut work.next_correction_yy,
            ];
            for (next, before) in next.into_iter().zip(&mut work.carried.found_correction) {
                if before.is_empty() {
                    before.clone_from(next);
                    continue;
                }
                for (next, before) in next.iter_mut().zip(before) {
                    let found = *next;
                    let change = found - std::mem::replace(before, found);
                    *next += change.clamp(-MOST_TAKEN_ON, MOST_TAKEN_ON);
                }
            }
        }
        std::mem::swap(&mut work.carried.correction_xx, &mut work.next_correction_xx);
        std::mem::swap(&mut work.carried.correction_xy, &mut work.next_correction_xy);
        std::mem::swap(&mut work.carried.correction_yy, &mut work.next_correction_yy);
        std::mem::swap(&mut work.acceleration_x, &mut work.carried.last_acceleration_x);
        std::mem::swap(&mut work.acceleration_y, &mut work.carried.last_acceleration_y);
        self.set_tension();
    }
}
