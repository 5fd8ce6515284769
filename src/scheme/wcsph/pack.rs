//! What the pair loops read of each particle, packed ahead of them.

use std::ops::Range;

use super::held::Factors;
use super::{DensityDiffusion, Wcsph, WcsphOptions};
use crate::particles::{Fluid, Record};
use crate::scheme::StateEquation;

/// From densities to pressures.
#[derive(Clone, Copy)]
struct Pressing<'a> {
    state: StateEquation,
    /// Pressures are ahead of the densities by this time, seconds.
    bulk_time: f64,
    /// g ρ_s/c0² where diffusion takes still water for uniform, else 0.
    hydrostatic: f64,
    density: &'a [f64],
    y: &'a [f64],
    rate: &'a [f64],
    tension: &'a [f64],
}

impl<'a> Pressing<'a> {
    /// With the rates of change of density and the shares of tension that the water bears.
    fn of(
        options: &WcsphOptions,
        bulk_time: f64,
        fluid: &'a Fluid,
        [rate, tension]: [&'a [f64]; 2],
    ) -> Pressing<'a> {
        Pressing {
            state: options.state,
            bulk_time,
            hydrostatic: options.hydrostatic_slope(),
            density: &fluid.density,
            y: &fluid.y,
            rate,
            tension,
        }
    }

    /// Pressures, with tension left out near the free surface, and what density diffusion smooths:
    /// ρ, or ρ less what it is in still water.
    #[inline(always)]
    fn find(self, lanes: Range<usize>, pressures: &mut [f64], diffused: &mut [f64]) {
        let Pressing { state, bulk_time, hydrostatic, .. } = self;
        let [density, y, rate, tension] =
            [self.density, self.y, self.rate, self.tension].map(|field| &field[lanes.clone()]);
        let n = density.len();
        let (pressures, diffused) = (&mut pressures[..n], &mut diffused[..n]);
        for k in 0..n {
            let pressure = state.pressure(density[k] + bulk_time * rate[k]);
            pressures[k] = if pressure < 0.0 { pressure * tension[k] } else { pressure };
        }
        if hydrostatic > 0.0 {
            let surface = state.surface_density;
            for k in 0..n {
                diffused[k] = surface * small_log(density[k] / surface - 1.0) + hydrostatic * y[k];
            }
        } else {
            diffused.copy_from_slice(density);
        }
    }
}

impl Wcsph {
    /// Pressures, and everything about the fluid that the pass of a full step reads.
    pub(super) fn pack(&mut self) {
        let n = self.fluid.padded_len();
        let (fluid, scaling) = (&self.fluid, self.scaling);
        let ahead = [&*self.ahead[0], &*self.ahead[1]];
        let work = &mut self.work;
        let pressing =
            Pressing::of(&self.options, self.bulk_time, fluid, [&work.density_rate, &work.tension]);
        let correction = [&*work.correction_xx, &*work.correction_xy, &*work.correction_yy];
        let fields = [
            &mut work.pressure[..n],
            &mut self.diffused[..n],
            &mut work.scaled_x[..n],
            &mut work.scaled_y[..n],
        ];
        let rows = (fields, &mut self.records[..n]);
        self.team.share(&mut self.parts, rows, &|part, (fields, records)| {
            let [pressure, diffused, scaled_x, scaled_y] = fields;
            let lanes = part.lanes();
            pressing.find(lanes.clone(), pressure, diffused);
            let [x, y] = ahead.map(|field| &field[lanes.clone()]);
            let [xx, xy, yy] = correction.map(|field| &field[lanes.clone()]);
            let [vx, vy, mass, density] =
                [&fluid.vx, &fluid.vy, &fluid.mass, &fluid.density].map(|f| &f[lanes.clone()]);
            let n = records.len();
            let (pressure, scaled_x, scaled_y) =
                (&pressure[..n], &mut scaled_x[..n], &mut scaled_y[..n]);
            for (k, record) in records.iter_mut().enumerate() {
                let (x, y) = (x[k] * scaling.inverse_radius, y[k] * scaling.inverse_radius);
                (scaled_x[k], scaled_y[k]) = (x, y);
                let weight = mass[k] / density[k] * scaling.weight_per_volume;
                // Without corrections these are the identity.
                let p = pressure[k];
                *record = Record([x, y, vx[k], vy[k], weight, p * xx[k], p * xy[k], p * yy[k]]);
            }
        });
    }

    /// New pressures alone, for an acoustic step: see [`super::acoustic::Acoustic`] for what a
    /// neighbour's are.
    pub(super) fn pack_pressures(&mut self) {
        let n = self.fluid.padded_len();
        let (fluid, work) = (&self.fluid, &mut self.work);
        let pressing =
            Pressing::of(&self.options, self.bulk_time, fluid, [&work.density_rate, &work.tension]);
        let fields = [
            &*work.scaled_x,
            &*work.scaled_y,
            &*work.correction_xx,
            &*work.correction_xy,
            &*work.correction_yy,
        ];
        let rows = ([&mut work.pressure[..n], &mut self.diffused[..n]], &mut self.factors[..n]);
        self.team.share(&mut self.parts, rows, &|part, ([pressure, diffused], factors)| {
            let lanes = part.lanes();
            pressing.find(lanes.clone(), pressure, diffused);
            let [x, y, xx, xy, yy] = fields.map(|field| &field[lanes.clone()]);
            for (k, factors) in factors.iter_mut().enumerate() {
                let p = pressure[k];
                let pressed = [p * xx[k], p * xy[k], p * yy[k]];
                *factors = pressure_factors(pressed, [x[k], y[k]]);
            }
        });
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

    /// New velocities, for the continuity pass: see [`super::continuity::Continuity`] for what a
    /// neighbour's are.
    pub(super) fn pack_velocities(&mut self) {
        let n = self.fluid.padded_len();
        let (fluid, work, diffusion) = (&self.fluid, &self.work, self.options.density_diffusion);
        let fields = [&*fluid.vx, &*fluid.vy, &*work.scaled_x, &*work.scaled_y, &*self.diffused];
        // Not all of these are there, or wanted, with every form of diffusion.
        let (share, slopes) = (&*work.diffused_share, [&*work.gradient_x, &*work.gradient_y]);
        let rows = (&mut self.factors[..n], &mut self.slants[..]);
        self.team.share(&mut self.parts, rows, &|part, (factors, slants)| {
            let lanes = part.lanes();
            let [vx, vy, x, y, diffused] = fields.map(|field| &field[lanes.clone()]);
            match diffusion {
                DensityDiffusion::None | DensityDiffusion::Hydrostatic => {
                    let share = &share[lanes];
                    for (k, factors) in factors.iter_mut().enumerate() {
                        let smoothed = [share[k], share[k] * diffused[k]];
                        *factors = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                    }
                }
                DensityDiffusion::Molteni => {
                    for (k, factors) in factors.iter_mut().enumerate() {
                        let smoothed = [1.0, diffused[k]];
                        *factors = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                    }
                }
                DensityDiffusion::Renormalised => {
                    let [slope_x, slope_y] = slopes.map(|field| &field[lanes.clone()]);
                    for (k, factors) in factors.iter_mut().enumerate() {
                        let slant = slope_x[k] * x[k] + slope_y[k] * y[k];
                        let smoothed = [1.0, 2.0 * diffused[k] - slant];
                        *factors = velocity_factors([vx[k], vy[k]], [x[k], y[k]], smoothed);
                        let slant = [slope_x[k], slope_y[k], x[k], y[k]];
                        slants[k].0[..4].copy_from_slice(&slant);
                    }
                }
            }
        });
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
