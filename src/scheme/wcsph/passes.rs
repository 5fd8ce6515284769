//! What the pair loops read, and which of their variants a run needs.

use std::marker::PhantomData;

use super::acoustic::Acoustic;
use super::continuity::{Continuity, FADED, OFF, PLAIN, RENORMALISED};
use super::laminar::Laminar;
use super::momentum::{CONCENTRATION, FORCES, GRADIENTS, Momentum};
use super::{DensityDiffusion, Shifting, Wcsph};
use crate::math::simd::dispatch;
use crate::particles::Record;
use crate::with_kernel;

/// Water bears tension from this completeness: none at the surface ...
pub(super) const TENSION_FROM: f64 = 0.6;
/// ... and all of it from this.
pub(super) const TENSION_FULL: f64 = 0.9;

impl Wcsph {
    /// Pressures, and everything about the fluid that the pair loops read.
    pub(super) fn pack(&mut self) {
        let options = &self.options;
        let corrected = options.corrected_gradients;
        let fluid = &self.fluid;
        for k in 0..fluid.padded_len() {
            let density = fluid.density[k];
            let pressure = self.pressure_of(density, k);
            self.work.pressure[k] = pressure;
            self.diffused[k] = self.diffused_of(density, k);
            let x = self.ahead[0][k] * self.scaling.inverse_radius;
            let y = self.ahead[1][k] * self.scaling.inverse_radius;
            self.work.scaled_x[k] = x;
            self.work.scaled_y[k] = y;
            let weight = fluid.mass[k] / density * self.scaling.weight_per_volume;
            let [xx, xy, yy] = if corrected {
                let work = &self.work;
                [work.correction_xx[k], work.correction_xy[k], work.correction_yy[k]]
                    .map(|component| pressure * component)
            } else {
                [pressure, 0.0, pressure]
            };
            self.records[k] = Record([x, y, fluid.vx[k], fluid.vy[k], weight, xx, xy, yy]);
        }
    }

    /// New pressures alone, for an acoustic step.
    pub(super) fn pack_pressures(&mut self) {
        let options = &self.options;
        let corrected = options.corrected_gradients;
        for k in 0..self.fluid.padded_len() {
            let density = self.fluid.density[k];
            let pressure = self.pressure_of(density, k);
            self.diffused[k] = self.diffused_of(density, k);
            self.work.pressure[k] = pressure;
            let work = &self.work;
            let parts = if corrected {
                [work.correction_xx[k], work.correction_xy[k], work.correction_yy[k]]
                    .map(|component| pressure * component)
            } else {
                [pressure, 0.0, pressure]
            };
            self.records[k].0[Record::PRESSURE..].copy_from_slice(&parts);
        }
    }

    /// What density diffusion smooths: ρ, or ρ less what it is in still water.
    #[inline(always)]
    fn diffused_of(&self, density: f64, k: usize) -> f64 {
        let hydrostatic = self.options.hydrostatic_slope();
        if hydrostatic > 0.0 {
            let surface = self.options.state.surface_density;
            surface * small_log(density / surface - 1.0) + hydrostatic * self.fluid.y[k]
        } else {
            density
        }
    }

    /// A pressure, with tension left out near the free surface.
    #[inline(always)]
    fn pressure_of(&self, density: f64, k: usize) -> f64 {
        let ahead = density + self.bulk_time * self.work.density_rate[k];
        let pressure = self.options.state.pressure(ahead);
        if pressure < 0.0 { pressure * self.work.tension[k] } else { pressure }
    }

    pub(super) fn acoustic_pass(&mut self) {
        macro_rules! pass {
            ($corrected:literal) => {
                dispatch(
                    self.path,
                    Acoustic::<$corrected> {
                        fluid: &self.fluid,
                        records: &self.records,
                        pairs: &self.pairs,
                        slopes: &self.slopes,
                        work: &mut self.work,
                        bodies: self.ghosts.bodies.len(),
                        gravity: self.options.gravity,
                    },
                )
            };
        }
        if self.options.corrected_gradients { pass!(true) } else { pass!(false) }
    }

    /// How much tension the water bears in the steps to come.
    pub(super) fn set_tension(&mut self) {
        if self.options.corrected_gradients {
            for (tension, completeness) in self.work.tension.iter_mut().zip(&self.work.completeness)
            {
                let inside = (completeness - TENSION_FROM) / (TENSION_FULL - TENSION_FROM);
                *tension = inside.clamp(0.0, 1.0);
            }
        }
    }

    pub(super) fn momentum_pass(&mut self) -> f64 {
        let options = &self.options;
        let sums = match (options.density_diffusion, options.shifting) {
            (DensityDiffusion::Renormalised, _) => GRADIENTS,
            (_, Shifting::Interior) => CONCENTRATION,
            (_, Shifting::None) => FORCES,
        };
        let viscosity = options.artificial_viscosity
            * options.smoothing_length()
            * options.state.sound_speed
            * options.density
            * self.scaling.inverse_radius;
        macro_rules! pass {
            ($K:ty, $sums:ident) => {
                if options.corrected_gradients {
                    pass!($K, $sums, true)
                } else {
                    pass!($K, $sums, false)
                }
            };
            ($K:ty, $sums:ident, $corrected:literal) => {
                dispatch(
                    self.path,
                    Momentum::<$K, $sums, $corrected> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        strain: &self.strain,
                        responses: self.exchange.responses(),
                        first_ghost: self.fluid.padded_len(),
                        pairs: &self.pairs,
                        slopes: &mut self.slopes,
                        work: &mut self.work,
                        bodies: self.ghosts.bodies.len(),
                        responds: self.responds,
                        viscosity,
                        support_radius: self.scaling.support_radius,
                        gravity: options.gravity,
                        steps: f64::from(options.acoustic_substeps),
                        kernel: PhantomData,
                    },
                )
            };
        }
        with_kernel!(options.kernel, K => match sums {
            GRADIENTS => pass!(K, GRADIENTS),
            CONCENTRATION => pass!(K, CONCENTRATION),
            _ => pass!(K, FORCES),
        })
    }

    /// Physical viscosity, where there is any; returns its power.
    pub(super) fn laminar_pass(&mut self) -> f64 {
        let options = &self.options;
        if options.kinematic_viscosity == 0.0 {
            return 0.0;
        }
        let pass = Laminar {
            fluid: &self.fluid,
            records: &self.records,
            pairs: &self.pairs,
            slopes: &self.slopes,
            work: &mut self.work,
            bodies: self.ghosts.bodies.len(),
            viscosity: 8.0
                * options.kinematic_viscosity
                * options.density
                * self.scaling.inverse_radius,
            steps: f64::from(options.acoustic_substeps),
        };
        dispatch(self.path, pass)
    }

    pub(super) fn continuity_pass(&mut self, sample: bool) -> f64 {
        let options = &self.options;
        let diffusion = options.diffusion_coefficient
            * options.smoothing_length()
            * options.state.sound_speed
            * self.scaling.inverse_radius;
        macro_rules! pass {
            ($diffusion:ident) => {
                if options.corrected_gradients {
                    pass!($diffusion, true)
                } else {
                    pass!($diffusion, false)
                }
            };
            ($diffusion:ident, $corrected:literal) => {
                dispatch(
                    self.path,
                    Continuity::<$diffusion, $corrected> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        slopes: &self.slopes,
                        strain: &mut self.strain,
                        pairs: &self.pairs,
                        work: &mut self.work,
                        support_radius: self.scaling.support_radius,
                        bodies: self.ghosts.bodies.len(),
                        diffusion,
                        sample,
                    },
                )
            };
        }
        match options.density_diffusion {
            DensityDiffusion::None => pass!(OFF),
            DensityDiffusion::Molteni => pass!(PLAIN),
            DensityDiffusion::Hydrostatic => pass!(FADED),
            DensityDiffusion::Renormalised => pass!(RENORMALISED),
        }
    }
}

/// ln(1 + u) for |u| far below one, to u⁵: still water is exactly uniform in ln ρ + g y/c0².
#[inline(always)]
fn small_log(u: f64) -> f64 {
    u * (1.0 - u * (0.5 - u * (1.0 / 3.0 - u * (0.25 - 0.2 * u))))
}
