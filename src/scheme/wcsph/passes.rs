//! What the pair loops read, and which of their variants a run needs.

use std::marker::PhantomData;

use super::acoustic::Acoustic;
use super::continuity::{Continuity, FADED, OFF, PLAIN, RENORMALISED};
use super::held::{Concentration, Factors};
use super::laminar::Laminar;
use super::momentum::{CONCENTRATION, FORCES, GRADIENTS, Momentum, OnPart};
use super::parts::power;
use super::precision::{Double, Precision, Single};
use super::{DensityDiffusion, Shifting, Wcsph};
use crate::math::simd::dispatch;
use crate::particles::{Record, SingleRecord};
use crate::with_kernel;

/// Water bears tension from this completeness: none at the surface ...
pub(super) const TENSION_FROM: f64 = 0.6;
/// ... and all of it from this.
pub(super) const TENSION_FULL: f64 = 0.9;

impl Wcsph {
    /// Pressures, with tension left out near the free surface, and what density diffusion smooths:
    /// ρ, or ρ less what it is in still water.
    fn find_pressures(&mut self) {
        let n = self.fluid.padded_len();
        let (state, bulk_time) = (self.options.state, self.bulk_time);
        let hydrostatic = self.options.hydrostatic_slope();
        let (density, y) = (&self.fluid.density[..n], &self.fluid.y[..n]);
        let (rate, tension) = (&self.work.density_rate[..n], &self.work.tension[..n]);
        let pressures = &mut self.work.pressure[..n];
        for k in 0..n {
            let pressure = state.pressure(density[k] + bulk_time * rate[k]);
            pressures[k] = if pressure < 0.0 { pressure * tension[k] } else { pressure };
        }
        let diffused = &mut self.diffused[..n];
        if hydrostatic > 0.0 {
            let surface = state.surface_density;
            for k in 0..n {
                diffused[k] = surface * small_log(density[k] / surface - 1.0) + hydrostatic * y[k];
            }
        } else {
            diffused.copy_from_slice(density);
        }
    }

    /// Pressures, and everything about the fluid that the pass of a full step reads.
    pub(super) fn pack(&mut self) {
        self.find_pressures();
        let n = self.fluid.padded_len();
        let (fluid, work, scaling) = (&self.fluid, &mut self.work, self.scaling);
        let [x, y] = [&self.ahead[0][..n], &self.ahead[1][..n]];
        let (vx, vy) = (&fluid.vx[..n], &fluid.vy[..n]);
        let (mass, density) = (&fluid.mass[..n], &fluid.density[..n]);
        let (scaled_x, scaled_y) = (&mut work.scaled_x[..n], &mut work.scaled_y[..n]);
        let pressure = &work.pressure[..n];
        let [xx, xy, yy] =
            [&work.correction_xx[..n], &work.correction_xy[..n], &work.correction_yy[..n]];
        let records = &mut self.records[..n];
        for k in 0..n {
            let (x, y) = (x[k] * scaling.inverse_radius, y[k] * scaling.inverse_radius);
            (scaled_x[k], scaled_y[k]) = (x, y);
            let weight = mass[k] / density[k] * scaling.weight_per_volume;
            // Without corrections these are the identity.
            let p = pressure[k];
            records[k] = Record([x, y, vx[k], vy[k], weight, p * xx[k], p * xy[k], p * yy[k]]);
        }
    }

    /// New pressures alone, for an acoustic step: see [`Acoustic`] for what a neighbour's are.
    pub(super) fn pack_pressures(&mut self) {
        self.find_pressures();
        let n = self.fluid.padded_len();
        let work = &self.work;
        let (pressure, x, y) = (&work.pressure[..n], &work.scaled_x[..n], &work.scaled_y[..n]);
        let [xx, xy, yy] =
            [&work.correction_xx[..n], &work.correction_xy[..n], &work.correction_yy[..n]];
        let factors = &mut self.factors[..n];
        for k in 0..n {
            let p = pressure[k];
            let pressed = [p * xx[k], p * xy[k], p * yy[k]];
            factors[k] = pressure_factors(pressed, [x[k], y[k]]);
        }
    }

    /// The ghosts' new pressures, likewise.
    pub(super) fn pack_ghost_pressures(&mut self) {
        let first = self.fluid.padded_len();
        for &g in self.exchange.counting() {
            let record = &self.records[first + g as usize].0;
            let pressed = [
                record[Record::PRESSURE],
                record[Record::PRESSURE_XY],
                record[Record::PRESSURE_YY],
            ];
            self.factors[first + g as usize] =
                pressure_factors(pressed, [record[Record::X], record[Record::Y]]);
        }
    }

    /// New velocities, for the continuity pass: see [`Continuity`] for what a neighbour's are.
    pub(super) fn pack_velocities(&mut self) {
        let n = self.fluid.padded_len();
        let (fluid, work) = (&self.fluid, &self.work);
        let (vx, vy) = (&fluid.vx[..n], &fluid.vy[..n]);
        let (x, y) = (&work.scaled_x[..n], &work.scaled_y[..n]);
        let (share, diffused) = (&work.diffused_share[..n], &self.diffused[..n]);
        let factors = &mut self.factors[..n];
        match self.options.density_diffusion {
            DensityDiffusion::None | DensityDiffusion::Hydrostatic => {
                for k in 0..n {
                    let smoothed = [share[k], share[k] * diffused[k]];
                    factors[k] = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                }
            }
            DensityDiffusion::Molteni => {
                for k in 0..n {
                    let smoothed = [1.0, diffused[k]];
                    factors[k] = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                }
            }
            DensityDiffusion::Renormalised => {
                let (slope_x, slope_y) = (&work.gradient_x[..n], &work.gradient_y[..n]);
                for k in 0..n {
                    let slant = slope_x[k] * x[k] + slope_y[k] * y[k];
                    let smoothed = [1.0, 2.0 * diffused[k] - slant];
                    factors[k] = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                    self.slants[k].0[..4].copy_from_slice(&[slope_x[k], slope_y[k], x[k], y[k]]);
                }
            }
        }
    }

    /// The ghosts' new velocities, likewise.
    pub(super) fn pack_ghost_velocities(&mut self) {
        let first = self.fluid.padded_len();
        for &g in self.exchange.counting() {
            let record = &self.records[first + g as usize].0;
            let velocity = [record[Record::VX], record[Record::VY]];
            let place = [record[Record::X], record[Record::Y]];
            self.factors[first + g as usize] = velocity_factors(velocity, place, [0.0; 2]);
        }
    }

    pub(super) fn acoustic_pass(&mut self) {
        for (load, held) in self.work.loads.iter_mut().zip(&self.work.held_loads) {
            load[0] = *held;
        }
        let mut found = self.work.acceleration_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let (path, fluid, factors, work) = (self.path, &self.fluid, &*self.factors, &self.work);
        let (bodies, gravity) = (self.ghosts.bodies.len(), self.options.gravity);
        macro_rules! pass {
            ($corrected:literal) => {
                self.team.share(&mut self.parts, rows, &|part, acceleration| {
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
        self.work.add_loads(&self.parts);
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
        self.work.loads.fill([0.0; 2]);
        self.work.held_loads.fill(0.0);
        self.round();
        let mut found = self.work.found_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
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
                match (options.precision, options.corrected_gradients) {
                    (Precision::F64, true) => pass!($K, Double, $sums, true, records),
                    (Precision::F64, false) => pass!($K, Double, $sums, false, records),
                    (Precision::F32, true) => pass!($K, Single, $sums, true, singles),
                    (Precision::F32, false) => pass!($K, Single, $sums, false, singles),
                }
            };
            ($K:ty, $P:ty, $sums:ident, $corrected:literal, $records:ident) => {{
                let pass = &Momentum::<$K, $P, $sums, $corrected> {
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
                    gravity: options.gravity,
                    steps: f64::from(options.acoustic_substeps),
                    kernel: PhantomData,
                };
                let path = self.path;
                self.team.share(&mut self.parts, rows, &|part, found| {
                    dispatch(path, OnPart { pass, part, found });
                });
            }};
        }
        with_kernel!(options.kernel, K => match sums {
            GRADIENTS => pass!(K, GRADIENTS),
            CONCENTRATION => pass!(K, CONCENTRATION),
            _ => pass!(K, FORCES),
        });
        put_back(self.work.found_mut(), found);
        self.work.add_loads(&self.parts);
        power(&self.parts)
    }

    /// The records in single precision, where pair terms are.
    fn round(&mut self) {
        if self.options.precision == Precision::F32 {
            self.singles.clear();
            let strain = self.strain.iter().copied().chain(std::iter::repeat([0.0; 2]));
            let rounded = self.records.iter().zip(strain);
            self.singles.extend(rounded.map(|(record, strain)| SingleRecord::new(record, strain)));
        }
    }

    /// Where the momentum pass was in single precision, renews the sum that held passes share with it.
    pub(super) fn renew_concentration(&mut self) {
        if self.options.precision == Precision::F64 {
            return;
        }
        for (factors, record) in self.factors.iter_mut().zip(&self.records) {
            factors.0[..3].copy_from_slice(&[1.0, record.0[Record::X], record.0[Record::Y]]);
        }
        let work = &mut self.work;
        let (path, factors) = (self.path, &*self.factors);
        let places = [&*work.scaled_x, &*work.scaled_y];
        let rows = [&mut *work.concentration_x, &mut *work.concentration_y];
        let groups = self.ghosts.bodies.len() + 1;
        self.team.share(&mut self.parts, rows, &|part, sums| {
            dispatch(path, Concentration { part, factors, places, sums, groups });
        });
    }

    /// Physical viscosity, where there is any; returns its power.
    pub(super) fn laminar_pass(&mut self) -> f64 {
        let options = &self.options;
        if options.kinematic_viscosity == 0.0 {
            return 0.0;
        }
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

    pub(super) fn continuity_pass(&mut self, sample: bool) -> f64 {
        let options = &self.options;
        let diffusion = options.diffusion_coefficient
            * options.smoothing_length()
            * options.state.sound_speed
            * self.scaling.inverse_radius;
        let mut rate = std::mem::take(&mut self.work.density_rate);
        let rows = (&mut *self.strain, &mut *rate);
        let (path, fluid, work) = (self.path, &self.fluid, &self.work);
        let (factors, slants, diffused) = (&*self.factors, &*self.slants, &*self.diffused);
        let (support_radius, bodies) = (self.scaling.support_radius, self.ghosts.bodies.len());
        macro_rules! pass {
            ($diffusion:ident) => {
                if options.corrected_gradients {
                    pass!($diffusion, true)
                } else {
                    pass!($diffusion, false)
                }
            };
            ($diffusion:ident, $corrected:literal) => {
                self.team.share(&mut self.parts, rows, &|part, (strain, rate)| {
                    let pass = Continuity::<$diffusion, $corrected> {
                        fluid,
                        factors,
                        slants,
                        diffused,
                        part,
                        strain,
                        rate,
                        work,
                        support_radius,
                        bodies,
                        diffusion,
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
        self.work.density_rate = rate;
        power(&self.parts)
    }
}

/// Fields go back to where they were taken from.
fn put_back<const N: usize>(fields: [&mut Vec<f64>; N], found: [Vec<f64>; N]) {
    for (field, found) in fields.into_iter().zip(found) {
        *field = found;
    }
}

/// P_xx, P_xy, P_yy, (P r)_x, (P r)_y, 1, x, y.
#[inline(always)]
fn pressure_factors([xx, xy, yy]: [f64; 3], [x, y]: [f64; 2]) -> Factors {
    Factors([xx, xy, yy, xx * x + xy * y, xy * x + yy * y, 1.0, x, y])
}

/// u, v, u x, u y, v x, v y, and two more.
#[inline(always)]
fn velocity_factors([u, v]: [f64; 2], [x, y]: [f64; 2], [a, b]: [f64; 2]) -> Factors {
    Factors([u, v, u * x, u * y, v * x, v * y, a, b])
}

/// ln(1 + u) for |u| far below one, to u⁵: still water is exactly uniform in ln ρ + g y/c0².
#[inline(always)]
fn small_log(u: f64) -> f64 {
    u * (1.0 - u * (0.5 - u * (1.0 / 3.0 - u * (0.25 - 0.2 * u))))
}
