//! Velocities and places: kick, drift, and what keeps particles in good order.

use std::ops::Range;

use super::fields::{Advance, Ramp};
use super::passes::{TENSION_FROM, TENSION_FULL};
use super::shifting::Shift;
use super::{DensityDiffusion, Wcsph};
use crate::body::BodyMotion;
use crate::math::simd::{LANES, dispatch};
use crate::particles::Fluid;
use crate::water::{HoldInside, Slack};

/// Hydrostatic density diffusion fades in from this completeness: near the surface the discrete
/// balance differs from the exact one, and diffusion would forever work against it ...
const DIFFUSE_FROM: f64 = 0.9;
/// ... to this one.
const DIFFUSE_FULL: f64 = 0.99;
/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.45, 0.25], tension: [TENSION_FULL, TENSION_FROM] };

impl Wcsph {
    /// Adds to the accelerations what the wall's own brings about, and the field.
    pub(super) fn complete_accelerations(&mut self, wall_acceleration: f64) {
        let (fluid, work) = (&self.fluid, &mut self.work);
        if wall_acceleration != 0.0 {
            let responding = self.parts.iter().flat_map(|part| &part.responding);
            for (cluster, response_x, response_y) in responding {
                let at = *cluster as usize * LANES;
                for lane in 0..LANES {
                    work.acceleration_x[at + lane] += wall_acceleration * response_x[lane];
                    work.acceleration_y[at + lane] += wall_acceleration * response_y[lane];
                }
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

    /// Finds how much of the density diffusion each particle takes part in until the next full step.
    pub(super) fn find_diffused_shares(&mut self) {
        if self.options.density_diffusion == DensityDiffusion::Hydrostatic {
            let (values, shares) = (&*self.work.completeness, &mut *self.work.diffused_share);
            let (from, to) = (DIFFUSE_FROM, DIFFUSE_FULL);
            dispatch(self.path, Ramp { values, from, to, shares });
        }
    }

    /// New velocities of some particles, of whole vectors.
    pub(super) fn kick(&mut self, dt: f64, lanes: Range<usize>) {
        let (fluid, work) = (&mut self.fluid, &self.work);
        let some = lanes.start..lanes.end.min(fluid.len());
        let fields = [
            (&mut fluid.vx[some.clone()], &work.acceleration_x[some.clone()]),
            (&mut fluid.vy[some.clone()], &work.acceleration_y[some]),
        ];
        dispatch(self.path, Advance { fields, dt });
    }

    /// New densities and places of some particles, of whole vectors.
    pub(super) fn drift(&mut self, dt: f64, lanes: Range<usize>) {
        let some = lanes.start..lanes.end.min(self.fluid.len());
        let Fluid { x, y, vx, vy, density, .. } = &mut self.fluid;
        let fields = [
            (&mut density[some.clone()], &self.work.density_rate[some.clone()]),
            (&mut x[some.clone()], &vx[some.clone()]),
            (&mut y[some.clone()], &vy[some]),
        ];
        dispatch(self.path, Advance { fields, dt });
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
    }

    /// Shifts the particles, if they are, for the time since the last full step; returns the energy
    /// that goes.
    pub(super) fn shift(&mut self) -> f64 {
        dispatch(
            self.path,
            Shift {
                fluid: &mut self.fluid,
                work: &self.work,
                options: &self.options,
                planes: &self.planes,
                strain: &self.strain,
                dt: self.since_full,
                inverse_radius: self.scaling.inverse_radius,
            },
        )
    }

    /// Holds some particles, of whole vectors, in front of the walls.
    pub(super) fn hold_inside(&mut self, bodies: &[BodyMotion], lanes: Range<usize>) {
        let skin = 1e-3 * self.options.spacing;
        let (fluid, planes) = (&mut self.fluid, &*self.planes);
        dispatch(self.path, HoldInside { fluid, lanes, planes, bodies, skin });
    }

    /// Finds the particles that [`Wcsph::settle_surface`] may change: few, and the same ones until
    /// the next full step.
    pub(super) fn find_surface(&mut self) {
        let completeness = &self.work.completeness[..self.fluid.len()];
        self.near_surface.clear();
        let near = completeness.iter().enumerate().filter(|(_, share)| **share < TENSION_FULL);
        self.near_surface.extend(near.map(|(k, _)| k as u32));
    }

    /// Relaxes the density of particles that feel no pressure: spray with too few neighbours, and
    /// water near the surface that would be under tension. Both are at the pressure of the air.
    /// Does so for some of the particles, and adds the elastic energy that goes to the `loss`.
    pub(super) fn settle_surface(&mut self, dt: f64, lanes: Range<usize>, loss: &mut f64) {
        let before = |end: usize| self.near_surface.partition_point(|&k| (k as usize) < end);
        let some = before(lanes.start)..before(lanes.end);
        let state = self.options.state;
        let rate = (dt * state.sound_speed / self.options.smoothing_length()).min(1.0);
        for &k in &self.near_surface[some] {
            let k = k as usize;
            let completeness = self.work.completeness[k];
            let density = self.fluid.density[k];
            let share = SLACK.share(completeness, density < state.surface_density).min(1.0);
            if share > 0.0 {
                let rise = rate * share * (state.surface_density - density);
                // Tension that did no work as it grew takes none away.
                let acting = if rise > 0.0 { self.work.tension[k] } else { 1.0 };
                let pressure = state.pressure(density) * acting;
                *loss -= self.fluid.mass[k] * pressure / (density * density) * rise;
                self.fluid.density[k] += rise;
            }
        }
    }

    pub(super) fn take_next_correction(&mut self) {
        let work = &mut self.work;
        std::mem::swap(&mut work.correction_xx, &mut work.next_correction_xx);
        std::mem::swap(&mut work.correction_xy, &mut work.next_correction_xy);
        std::mem::swap(&mut work.correction_yy, &mut work.next_correction_yy);
        std::mem::swap(&mut work.acceleration_x, &mut work.last_acceleration_x);
        std::mem::swap(&mut work.acceleration_y, &mut work.last_acceleration_y);
        self.set_tension();
    }
}
