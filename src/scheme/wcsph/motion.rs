//! Velocities and places: kick, drift, and what keeps particles in good order.

use super::passes::{TENSION_FROM, TENSION_FULL};
use super::{DensityDiffusion, Shifting, Wcsph};
use crate::body::BodyMotion;
use crate::boundary::Plane;
use crate::math::simd::LANES;
use crate::particles::Fluid;

/// Shifting fades in from this completeness of the support ...
const SHIFT_FROM: f64 = 0.85;
/// ... to this one.
const SHIFT_FULL: f64 = 0.97;
/// Hydrostatic density diffusion fades in from this completeness: near the surface the discrete
/// balance differs from the exact one, and diffusion would forever work against it ...
const DIFFUSE_FROM: f64 = 0.9;
/// ... to this one.
const DIFFUSE_FULL: f64 = 0.99;
/// No shift is longer than this many particle spacings.
const SHIFT_LIMIT: f64 = 0.05;
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
        let accelerate = |velocities: &mut [f64], rates: &[f64]| {
            velocities.iter_mut().zip(rates).for_each(|(velocity, rate)| *velocity += dt * rate);
        };
        accelerate(&mut fluid.vx[..n], &work.acceleration_x);
        accelerate(&mut fluid.vy[..n], &work.acceleration_y);
        if self.substep == 0 && self.options.density_diffusion == DensityDiffusion::Hydrostatic {
            for (share, completeness) in work.diffused_share.iter_mut().zip(&work.completeness) {
                let inside = (completeness - DIFFUSE_FROM) / (DIFFUSE_FULL - DIFFUSE_FROM);
                *share = inside.clamp(0.0, 1.0);
            }
        }
    }

    /// Moves the particles; returns the energy that shifting takes out.
    pub(super) fn drift(&mut self, dt: f64, bodies: &[BodyMotion]) -> f64 {
        let (fluid, work, options) = (&mut self.fluid, &self.work, &self.options);
        let n = fluid.len();
        let advance = |values: &mut [f64], rates: &[f64]| {
            values.iter_mut().zip(rates).for_each(|(value, rate)| *value += dt * rate);
        };
        advance(&mut fluid.density[..n], &work.density_rate);
        advance(&mut fluid.x[..n], &fluid.vx);
        advance(&mut fluid.y[..n], &fluid.vy);
        let mut planes = std::mem::take(&mut self.planes);
        planes.clear();
        planes.extend(
            self.ghosts
                .bodies
                .iter()
                .zip(bodies)
                .map(|(body, motion)| body.plane.moved(motion.offset).moved(dt * motion.velocity)),
        );
        let spray_loss = if options.corrected_gradients { self.settle_surface(dt) } else { 0.0 };
        let shifting_loss = match self.options.shifting {
            Shifting::Interior if self.at_full_step() => self.shift(self.since_full, &planes),
            _ => 0.0,
        };
        self.hold_inside(&planes, bodies);
        self.planes = planes;
        shifting_loss + spray_loss
    }

    /// Relaxes the density of particles that feel no pressure: spray with too few neighbours, and
    /// water near the surface that would be under tension. Both are at the pressure of the air.
    /// Returns the elastic energy that goes.
    fn settle_surface(&mut self, dt: f64) -> f64 {
        let state = self.options.state;
        let rate = (dt * state.sound_speed / self.options.smoothing_length()).min(1.0);
        let mut loss = 0.0;
        for k in 0..self.fluid.len() {
            let completeness = self.work.completeness[k];
            if completeness >= TENSION_FULL {
                continue; // As nearly all are.
            }
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

    /// Shifts particles towards an even spread; returns the energy that goes.
    fn shift(&mut self, dt: f64, planes: &[Plane]) -> f64 {
        let (fluid, work, options) = (&mut self.fluid, &self.work, &self.options);
        let n = fluid.len();
        let strength = options.shifting_coefficient * options.smoothing_length() * dt;
        let limit = SHIFT_LIMIT * options.spacing;
        let inverse_radius = self.scaling.inverse_radius;
        let reach = options.spacing;
        let hydrostatic = options.hydrostatic_slope();
        let mut work_done = 0.0;
        for block in 0..fluid.padded_len() / LANES {
            let near = any_nearer(planes, fluid, block, 1.5 * reach);
            for k in block * LANES..n.min((block + 1) * LANES) {
                let inside = (work.completeness[k] - SHIFT_FROM) / (SHIFT_FULL - SHIFT_FROM);
                let speed = (fluid.vx[k] * fluid.vx[k] + fluid.vy[k] * fluid.vy[k]).sqrt();
                let factor = -strength * speed * inside.clamp(0.0, 1.0);
                let fade = |distance: f64| (distance / reach - 0.5).clamp(0.0, 1.0);
                let mut shift = [
                    (factor * work.concentration_x[k]).clamp(-limit, limit),
                    (factor * work.concentration_y[k]).clamp(-limit, limit),
                ];
                if near {
                    for plane in planes {
                        let distance = -plane.beyond([fluid.x[k], fluid.y[k]]);
                        if distance < 1.5 * reach {
                            shift = plane.with_across(shift, |across| across * fade(distance));
                        }
                    }
                }
                let [dx, dy] = shift;
                let rise = (dx * work.gradient_x[k] + dy * work.gradient_y[k]) * inverse_radius
                    - hydrostatic * dy;
                let density = fluid.density[k];
                work_done += fluid.mass[k]
                    * (options.gravity * dy + work.pressure[k] / (density * density) * rise);
                fluid.x[k] += dx;
                fluid.y[k] += dy;
                fluid.density[k] += rise;
            }
        }
        -work_done
    }

    /// Puts particles that have slipped through a wall back onto its face, with its velocity.
    fn hold_inside(&mut self, planes: &[Plane], bodies: &[BodyMotion]) {
        let fluid = &mut self.fluid;
        let skin = 1e-3 * self.options.spacing;
        for block in 0..fluid.padded_len() / LANES {
            if !any_nearer(planes, fluid, block, 0.0) {
                continue;
            }
            for k in block * LANES..fluid.len().min((block + 1) * LANES) {
                // In an acute corner one wall may push behind the other.
                for _ in 0..4 {
                    let place = [fluid.x[k], fluid.y[k]];
                    let crossed =
                        planes.iter().zip(bodies).find(|(plane, _)| plane.beyond(place) > 0.0);
                    let Some((plane, motion)) = crossed else { break };
                    [fluid.x[k], fluid.y[k]] = plane.in_front(place, skin);
                    let wall = motion.velocity * plane.normal[0];
                    if fluid.vx[k] * plane.normal[0] + fluid.vy[k] * plane.normal[1] > wall {
                        let velocity = [fluid.vx[k], fluid.vy[k]];
                        [fluid.vx[k], fluid.vy[k]] = plane.with_across(velocity, |_| wall);
                    }
                }
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

/// Whether one of eight particles is nearer than `distance` to a wall's face, or behind it.
#[inline(always)]
fn any_nearer(planes: &[Plane], fluid: &Fluid, block: usize, distance: f64) -> bool {
    let (x, y) = (&fluid.x.as_chunks::<LANES>().0[block], &fluid.y.as_chunks::<LANES>().0[block]);
    let mut nearest = f64::NEG_INFINITY;
    for plane in planes {
        for lane in 0..LANES {
            let beyond = plane.beyond([x[lane], y[lane]]);
            nearest = if beyond > nearest { beyond } else { nearest };
        }
    }
    nearest > -distance
}
