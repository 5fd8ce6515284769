//! Velocities and places: kick, drift, and what keeps particles in good order.

use super::fields::{Advance, Ramp};
use super::inside::HoldInside;
use super::passes::{TENSION_FROM, TENSION_FULL};
use super::shifting::Shift;
use super::{DensityDiffusion, Shifting, Wcsph};
use crate::body::BodyMotion;
use crate::math::simd::{LANES, dispatch};
use crate::particles::Fluid;

/// Hydrostatic density diffusion fades in from this completeness: near the surface the discrete
/// balance differs from the exact one, and diffusion would forever work against it ...
const DIFFUSE_FROM: f64 = 0.9;
/// ... to this one.
const DIFFUSE_FULL: f64 = 0.99;
/// A particle is spray from this completeness ...
const SPRAY_FROM: f64 = 0.45;
/// ... and wholly so from this.
const SPRAY_FULL: f64 = 0.25;

impl Wcsph {
    pub(super) fn kick(&mut self, dt: f64, wall_acceleration: f64) {
        let (fluid, work) = (&mut self.fluid, &mut self.work);
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
        let n = fluid.len();
        let fields = [
            (&mut fluid.vx[..n], &*work.acceleration_x),
            (&mut fluid.vy[..n], &*work.acceleration_y),
        ];
        dispatch(self.path, Advance { fields, dt });
        if self.substep == 0 && self.options.density_diffusion == DensityDiffusion::Hydrostatic {
            let (values, shares) = (&*work.completeness, &mut *work.diffused_share);
            let (from, to) = (DIFFUSE_FROM, DIFFUSE_FULL);
            dispatch(self.path, Ramp { values, from, to, shares });
        }
    }

    /// Moves the particles; returns the energy that shifting takes out.
    pub(super) fn drift(&mut self, dt: f64, bodies: &[BodyMotion]) -> f64 {
        let n = self.fluid.len();
        let Fluid { x, y, vx, vy, density, .. } = &mut self.fluid;
        let fields = [
            (&mut density[..n], &*self.work.density_rate),
            (&mut x[..n], &**vx),
            (&mut y[..n], &**vy),
        ];
        dispatch(self.path, Advance { fields, dt });
        let mut planes = std::mem::take(&mut self.planes);
        planes.clear();
        planes.extend(
            self.ghosts
                .bodies
                .iter()
                .zip(bodies)
                .map(|(body, motion)| body.plane.moved(motion.offset).moved(dt * motion.velocity)),
        );
        let spray_loss =
            if self.options.corrected_gradients { self.settle_surface(dt) } else { 0.0 };
        let shifting_loss = match self.options.shifting {
            Shifting::Interior if self.at_full_step() => dispatch(
                self.path,
                Shift {
                    fluid: &mut self.fluid,
                    work: &self.work,
                    options: &self.options,
                    planes: &planes,
                    dt: self.since_full,
                    inverse_radius: self.scaling.inverse_radius,
                },
            ),
            _ => 0.0,
        };
        let skin = 1e-3 * self.options.spacing;
        let fluid = &mut self.fluid;
        dispatch(self.path, HoldInside { fluid, planes: &planes, bodies, skin });
        self.planes = planes;
        shifting_loss + spray_loss
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
    /// Returns the elastic energy that goes.
    fn settle_surface(&mut self, dt: f64) -> f64 {
        let state = self.options.state;
        let rate = (dt * state.sound_speed / self.options.smoothing_length()).min(1.0);
        let mut loss = 0.0;
        for &k in &self.near_surface {
            let k = k as usize;
            let completeness = self.work.completeness[k];
            let density = self.fluid.density[k];
            let alone = (SPRAY_FROM - completeness) / (SPRAY_FROM - SPRAY_FULL);
            let slack = if density < state.surface_density {
                (TENSION_FULL - completeness) / (TENSION_FULL - TENSION_FROM)
            } else {
                0.0
            };
            let share = alone.max(slack).min(1.0);
            if share > 0.0 {
                let rise = rate * share * (state.surface_density - density);
                // Tension that did no work as it grew takes none away.
                let acting = if rise > 0.0 { self.work.tension[k] } else { 1.0 };
                let pressure = state.pressure(density) * acting;
                loss -= self.fluid.mass[k] * pressure / (density * density) * rise;
                self.fluid.density[k] += rise;
            }
        }
        loss
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
