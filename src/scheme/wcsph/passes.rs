//! The pair loops, in the variant that a run needs.

use std::marker::PhantomData;
use std::ops::Range;

use super::acoustic::Acoustic;
use super::continuity::{Continuity, FADED, OFF, PLAIN, RENORMALISED};
use super::correction::surface_share;
use super::flow::Flow;
use super::laminar::Laminar;
use super::momentum::{CONCENTRATION, FORCES, GRADIENTS, Momentum, OnPart};
use super::parts::power;
use super::precision::{Double, Precision, Single};
use super::{DensityDiffusion, Shifting, Wcsph};
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch, dispatch_vectors};
use crate::math::team::window;
use crate::with_kernel;

/// Water bears tension from this completeness: none at the surface ...
pub(super) const TENSION_FROM: f64 = 0.6;
/// ... and all of it from this.
pub(super) const TENSION_FULL: f64 = 0.9;

/// The share of tension that water bears under the surface: what is left out of its correction
/// there, for the balance under gravity, is not left out of its tension.
struct Bearing<'a> {
    tension: &'a mut [f64],
    completeness: &'a [f64],
    first_row: f64,
}

impl Task for Bearing<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let (tensions, _) = self.tension.as_chunks_mut::<LANES>();
        for (tension, completeness) in tensions.iter_mut().zip(self.completeness.as_chunks().0) {
            let completeness = L::load(completeness);
            let inside = (completeness - L::splat(TENSION_FROM))
                * L::splat(1.0 / (TENSION_FULL - TENSION_FROM));
            inside
                .max(zero)
                .div(surface_share(completeness, self.first_row))
                .min(one)
                .store(tension);
        }
    }
}

impl Wcsph {
    /// Pressure forces on some parts' water, and its loads in their tallies.
    pub(super) fn acoustic_pass(&mut self, some: Range<usize>) {
        let mut found = self.work.acceleration_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let (parts, rows) = window(&mut self.parts, rows, some);
        let (path, fluid, factors, work) =
            (self.path, &self.fluid, self.numbers.pressures(), &self.work);
        let (bodies, gravity) = (self.ghosts.bodies.len(), self.options.gravity);
        macro_rules! pass {
            ($corrected:literal) => {
                self.team.share(parts, rows, &|part, acceleration| {
                    let pass = Acoustic::<$corrected> {
                        fluid,
                        factors,
                        part,
                        work,
                        acceleration,
                        bodies,
                        gravity,
                    };
                    dispatch(path, pass);
                })
            };
        }
        if self.options.corrected_gradients {
            pass!(true)
        } else {
            pass!(false)
        }
        put_back(self.work.acceleration_mut(), found);
    }

    /// The loads of an acoustic step, once all parts have been through its pass.
    pub(super) fn sum_loads(&mut self) {
        for (load, held) in self.work.loads.iter_mut().zip(&self.work.held_loads) {
            load[0] = *held;
        }
        self.work.add_loads(&self.parts);
    }

    /// How much tension the water bears in the steps to come.
    pub(super) fn set_tension(&mut self) {
        if self.options.corrected_gradients {
            let (tension, completeness) = (&mut *self.work.tension, &*self.work.completeness);
            let first_row = self.options.first_row_share();
            dispatch(self.path, Bearing { tension, completeness, first_row });
        }
    }

    pub(super) fn momentum_pass(&mut self) -> f64 {
        self.work.loads.fill([0.0; 2]);
        self.work.held_loads.fill(0.0);
        self.round();
        let mut found = self.work.found_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let options = &self.options;
        let sums = match (options.density_diffusion, options.shifting) {
            (DensityDiffusion::Renormalised, _) => GRADIENTS,
            // Corrected forces need all sums that shifting does.
            (_, Shifting::None) if !options.corrected_gradients => FORCES,
            _ => CONCENTRATION,
        };
        let viscosity = options.artificial_viscosity
            * options.smoothing_length()
            * options.state.sound_speed
            * options.density
            * self.scaling.inverse_radius;
        // The portable path multiplies by zero instead of having a variant without.
        let viscous = viscosity > 0.0 || self.path == SimdPath::Portable;
        macro_rules! pass {
            ($K:ty, $sums:ident, $corrected:literal) => {
                match (options.precision, viscous) {
                    (Precision::F64, true) => {
                        pass!($K, Double, $sums, $corrected, true, records, dispatch)
                    }
                    (Precision::F64, false) => {
                        pass!($K, Double, $sums, $corrected, false, records, dispatch_vectors)
                    }
                    (Precision::F32, true) => {
                        pass!($K, Single, $sums, $corrected, true, singles, dispatch)
                    }
                    (Precision::F32, false) => {
                        pass!($K, Single, $sums, $corrected, false, singles, dispatch_vectors)
                    }
                }
            };
            (
                $K:ty, $P:ty, $sums:ident, $corrected:literal, $viscous:literal, $records:ident,
                $dispatch:ident
            ) => {{
                let pass = &Momentum::<$K, $P, $sums, $corrected, $viscous> {
                    fluid: &self.fluid,
                    records: &self.$records,
                    diffused: &self.diffused,
                    strain: &self.strain,
                    responses: self.exchange.responses(),
                    first_ghost: self.fluid.padded_len(),
                    work: &self.work,
                    bodies: self.ghosts.bodies.len(),
                    responds: self.responds,
                    viscosity,
                    support_radius: self.scaling.support_radius,
                    first_row: options.first_row_share(),
                    density: options.density,
                    gravity: options.gravity,
                    steps: f64::from(options.acoustic_substeps),
                    kernel: PhantomData,
                };
                let path = self.path;
                self.team.share(&mut self.parts, rows, &|part, found| {
                    $dispatch(path, OnPart { pass, part, found });
                });
            }};
        }
        with_kernel!(options.kernel, K => match (sums, options.corrected_gradients) {
            (GRADIENTS, true) => pass!(K, GRADIENTS, true),
            (GRADIENTS, false) => pass!(K, GRADIENTS, false),
            (_, true) => pass!(K, CONCENTRATION, true),
            (CONCENTRATION, false) => pass!(K, CONCENTRATION, false),
            (_, false) => pass!(K, FORCES, false),
        });
        put_back(self.work.found_mut(), found);
        self.work.add_loads(&self.parts);
        power(&self.parts)
    }

    /// Physical viscosity; returns its power.
    pub(super) fn laminar_pass(&mut self) -> f64 {
        let options = &self.options;
        let mut found = self.work.acceleration_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let (path, fluid, records, work) = (self.path, &self.fluid, &*self.records, &self.work);
        let bodies = self.ghosts.bodies.len();
        let steps = f64::from(options.acoustic_substeps);
        let viscosity =
            8.0 * options.kinematic_viscosity * options.density * self.scaling.inverse_radius;
        self.team.share(&mut self.parts, rows, &|part, acceleration| {
            let pass =
                Laminar { fluid, records, part, work, acceleration, bodies, viscosity, steps };
            dispatch(path, pass);
        });
        put_back(self.work.acceleration_mut(), found);
        self.work.add_loads(&self.parts);
        power(&self.parts)
    }

    /// What the continuity pass of this step wants.
    pub(super) fn flow(&self) -> Flow {
        let corrected = self.options.corrected_gradients;
        Flow {
            corrected,
            strained: corrected && self.substep + 1 == self.options.acoustic_substeps,
            diffusing: self.options.density_diffusion != DensityDiffusion::None,
            sharing: self.substep == 0,
        }
    }

    /// Rates of change of density of some parts' water over a step of `dt` seconds, and with `sample`
    /// in their tallies the power that diffusion takes.
    pub(super) fn continuity_pass(&mut self, dt: f64, sample: bool, some: Range<usize>) {
        let (options, flow) = (&self.options, self.flow());
        let diffusion = options.diffusion_coefficient
            * options.smoothing_length()
            * options.state.sound_speed
            * self.scaling.inverse_radius;
        let mut rate = std::mem::take(&mut self.work.density_rate);
        let mut shares = std::mem::take(&mut self.work.shares);
        let mut turning = std::mem::take(&mut self.work.turning);
        let rows = (&mut *self.strain, [&mut *rate, &mut *shares, &mut *turning]);
        let (parts, rows) = window(&mut self.parts, rows, some);
        let (path, fluid, work) = (self.path, &self.fluid, &self.work);
        let (factors, slants, diffused) =
            (self.numbers.velocities(), &*self.slants, &*self.diffused);
        let (support_radius, bodies) = (self.scaling.support_radius, self.ghosts.bodies.len());
        let first_row = options.first_row_share();
        macro_rules! pass {
            ($diffusion:ident) => {
                if options.corrected_gradients {
                    pass!($diffusion, true)
                } else {
                    pass!($diffusion, false)
                }
            };
            ($diffusion:ident, $corrected:literal) => {
                self.team.share(parts, rows, &|part, (strain, [rate, shares, turning])| {
                    let pass = Continuity::<$diffusion, $corrected> {
                        fluid,
                        factors,
                        slants,
                        diffused,
                        part,
                        strain,
                        rate,
                        shares,
                        turning,
                        first_row,
                        work,
                        support_radius,
                        bodies,
                        diffusion,
                        flow,
                        dt,
                        sample,
                    };
                    dispatch(path, pass);
                })
            };
        }
        match options.density_diffusion {
            DensityDiffusion::None => pass!(OFF),
            DensityDiffusion::Molteni => pass!(PLAIN),
            DensityDiffusion::Hydrostatic => pass!(FADED),
            DensityDiffusion::Renormalised => pass!(RENORMALISED),
        }
        (self.work.density_rate, self.work.shares, self.work.turning) = (rate, shares, turning);
    }
}

/// Fields go back to where they were taken from.
fn put_back<const N: usize>(fields: [&mut Vec<f64>; N], found: [Vec<f64>; N]) {
    for (field, found) in fields.into_iter().zip(found) {
        *field = found;
    }
}
