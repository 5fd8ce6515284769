//! What the pair loops read, and which of their variants a run needs.

use std::marker::PhantomData;

use super::continuity::{Continuity, FADED, OFF, PLAIN, RENORMALISED};
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
        let state = options.state;
        let hydrostatic = options.hydrostatic_slope();
        let surface = state.surface_density;
        let corrected = options.corrected_gradients;
        let fluid = &self.fluid;
        for k in 0..fluid.padded_len() {
            let density = fluid.density[k];
            let mut pressure = state.pressure(density);
            if corrected && pressure < 0.0 {
                let inside =
                    (self.work.completeness[k] - TENSION_FROM) / (TENSION_FULL - TENSION_FROM);
                pressure *= inside.clamp(0.0, 1.0);
            }
            let diffused = if hydrostatic > 0.0 {
                surface * small_log(density / surface - 1.0) + hydrostatic * fluid.y[k]
            } else {
                density
            };
            self.work.pressure[k] = pressure;
            self.diffused[k] = diffused;
            let x = fluid.x[k] * self.scaling.inverse_radius;
            let y = fluid.y[k] * self.scaling.inverse_radius;
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

    pub(super) fn momentum_pass(&mut self, sample: bool) -> f64 {
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
                match (options.corrected_gradients, sample) {
                    (false, false) => pass!($K, $sums, false, false),
                    (false, true) => pass!($K, $sums, false, true),
                    (true, false) => pass!($K, $sums, true, false),
                    (true, true) => pass!($K, $sums, true, true),
                }
            };
            ($K:ty, $sums:ident, $corrected:literal, $energy:literal) => {
                dispatch(
                    self.path,
                    Momentum::<$K, $sums, $corrected, $energy> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        strain: &self.strain,
                        responses: self.exchange.responses(),
                        first_ghost: self.fluid.padded_len(),
                        pairs: &self.pairs,
                        work: &mut self.work,
                        bodies: self.ghosts.bodies.len(),
                        responds: self.responds,
                        viscosity,
                        support_radius: self.scaling.support_radius,
                        gravity: options.gravity,
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

    pub(super) fn continuity_pass(&mut self, sample: bool) -> f64 {
        let options = &self.options;
        let diffusion = options.diffusion_coefficient
            * options.smoothing_length()
            * options.state.sound_speed
            * self.scaling.inverse_radius;
        macro_rules! pass {
            ($K:ty, $diffusion:expr, $energy:literal) => {
                if options.corrected_gradients {
                    pass!($K, $diffusion, true, $energy)
                } else {
                    pass!($K, $diffusion, false, $energy)
                }
            };
            ($K:ty, $diffusion:expr, $corrected:literal, $energy:literal) => {
                dispatch(
                    self.path,
                    Continuity::<$K, { $diffusion }, $corrected, $energy> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        strain: &mut self.strain,
                        pairs: &self.pairs,
                        work: &mut self.work,
                        support_radius: self.scaling.support_radius,

                        bodies: self.ghosts.bodies.len(),
                        diffusion,
                        kernel: PhantomData,
                    },
                )
            };
        }
        use DensityDiffusion::{Hydrostatic, Molteni, None, Renormalised};
        with_kernel!(options.kernel, K => match (options.density_diffusion, sample) {
            (None, _) => pass!(K, OFF, false),
            (Molteni, false) => pass!(K, PLAIN, false),
            (Molteni, true) => pass!(K, PLAIN, true),
            (Hydrostatic, false) => pass!(K, FADED, false),
            (Hydrostatic, true) => pass!(K, FADED, true),
            (Renormalised, false) => pass!(K, RENORMALISED, false),
            (Renormalised, true) => pass!(K, RENORMALISED, true),
        })
    }
}

/// ln(1 + u) for |u| far below one, to u⁵: still water is exactly uniform in ln ρ + g y/c0².
#[inline(always)]
fn small_log(u: f64) -> f64 {
    u * (1.0 - u * (0.5 - u * (1.0 / 3.0 - u * (0.25 - 0.2 * u))))
}
