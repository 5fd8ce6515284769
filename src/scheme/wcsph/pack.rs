//! What the pair loops read of each particle, packed ahead of them.

use super::diffusion::{Diffusion, with_diffusion};
use super::pressing::Pressing;
use super::{DensityDiffusion, Wcsph, Workspace};
use crate::pairs::{Double, Each, Factors, Flow, Fluid, Here, Record, Scaling};

/// Everything about the water that the pass of a full step reads.
struct Whole<'a> {
    pressing: Pressing<'a>,
    scaling: Scaling,
    fluid: &'a Fluid,
    /// Where the particles will be.
    ahead: [&'a [f64]; 2],
    /// Kernel gradient's, without corrections the identity: xx, xy, yy.
    correction: [&'a [f64]; 3],
}

/// Rows of the pressure, of what diffusion smooths, and of the places over R; then the records.
type WholeRows<'r> = ([&'r mut [f64]; 4], &'r mut [Record]);

impl Each<WholeRows<'_>> for Whole<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, records): &mut WholeRows<'_>) {
        let Whole { pressing, scaling, fluid, ahead, correction } = self;
        let [pressures, diffused, scaled_x, scaled_y] = fields;
        let [p, smoothed] = pressing.find::<D>(here);
        here.put(pressures, p);
        here.put(diffused, smoothed);
        let inverse_radius = D::splat(scaling.inverse_radius);
        let [x, y] = here.all::<D, 2>(*ahead);
        let (x, y) = (x * inverse_radius, y * inverse_radius);
        here.put(scaled_x, x);
        here.put(scaled_y, y);
        let [vx, vy, mass, density] =
            here.all::<D, 4>([&fluid.vx, &fluid.vy, &fluid.mass, &fluid.density]);
        let weight = mass.div(density) * D::splat(scaling.weight_per_volume);
        let [xx, xy, yy] = here.all::<D, 3>(*correction);
        here.put_numbers(records, [x, y, vx, vy, weight, p * xx, p * xy, p * yy]);
    }
}

/// New pressures of the water alone, for an acoustic step: see [`super::acoustic::Acoustic`] for what a
/// neighbour's are.
struct Pressures<'a> {
    pressing: Pressing<'a>,
    /// Places over R.
    places: [&'a [f64]; 2],
    correction: [&'a [f64]; 3],
}

/// Rows of the pressure and of what diffusion smooths; then the numbers.
type PressureRows<'r> = ([&'r mut [f64]; 2], &'r mut [Factors]);

impl Each<PressureRows<'_>> for Pressures<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, factors): &mut PressureRows<'_>) {
        let [pressures, diffused] = fields;
        let [p, smoothed] = self.pressing.find::<D>(here);
        here.put(pressures, p);
        here.put(diffused, smoothed);
        let [xx, xy, yy] = here.all::<D, 3>(self.correction);
        let place = here.all(self.places);
        here.put_numbers(factors, Factors::of_pressure([p * xx, p * xy, p * yy], place));
    }
}

/// New velocities of some of the water, for the continuity pass: see [`Flow`] for what a neighbour's are.
struct Velocities<'a, F> {
    fluid: &'a Fluid,
    /// Places over R.
    places: [&'a [f64]; 2],
    flow: Flow,
    formulation: F,
    diffused: &'a [f64],
}

impl<F: Diffusion> Each<&mut [Factors]> for Velocities<'_, F> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, factors: &mut &mut [Factors]) {
        let velocity = here.all::<D, 2>([&self.fluid.vx, &self.fluid.vy]);
        let smoothed = self.formulation.neighbour(here, here.of::<D>(self.diffused));
        here.put_numbers(factors, self.flow.numbers(velocity, here.all(self.places), smoothed));
    }
}

/// What [`super::diffusion::Renormalised`] reads of each particle.
struct Slants<'a> {
    gradient: [&'a [f64]; 2],
    places: [&'a [f64]; 2],
}

impl Each<&mut [Factors]> for Slants<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, slants: &mut &mut [Factors]) {
        let ([slope_x, slope_y], [x, y]) =
            (here.all::<D, 2>(self.gradient), here.all::<D, 2>(self.places));
        let zero = D::splat(0.0);
        here.put_numbers(slants, [slope_x, slope_y, x, y, zero, zero, zero, zero]);
    }
}

impl Wcsph {
    /// Pressures, and everything about the fluid that the pass of a full step reads.
    pub(super) fn pack(&mut self) {
        let n = self.fluid.padded_len();
        let Workspace { carried, pressure, scaled_x, scaled_y, .. } = &mut self.work;
        let (fluid, scaling) = (&self.fluid, self.scaling);
        let state = [&*carried.density_rate, &*carried.tension];
        let whole = Whole {
            pressing: Pressing::of(&self.options, self.bulk_time, fluid, state),
            scaling,
            fluid,
            ahead: [&self.ahead[0], &self.ahead[1]],
            correction: carried.correction(),
        };
        let fields =
            [&mut pressure[..n], &mut self.diffused[..n], &mut scaled_x[..n], &mut scaled_y[..n]];
        self.pairs.each((fields, &mut self.records[..n]), &whole);
    }

    /// The new pressures alone.
    pub(super) fn pack_pressures(&mut self) {
        let (n, work) = (self.fluid.padded_len(), &mut self.work);
        let state = [&*work.carried.density_rate, &*work.carried.tension];
        let pressures = Pressures {
            pressing: Pressing::of(&self.options, self.bulk_time, &self.fluid, state),
            places: [&work.scaled_x, &work.scaled_y],
            correction: work.carried.correction(),
        };
        let fields = [&mut work.pressure[..n], &mut self.diffused[..n]];
        self.pairs.each((fields, &mut self.numbers[..n]), &pressures);
    }

    /// The new velocities.
    pub(super) fn pack_velocities(&mut self) {
        let n = self.fluid.padded_len();
        let (flow, work, fluid, diffused) = (self.flow(), &self.work, &self.fluid, &*self.diffused);
        let places = [&*work.scaled_x, &*work.scaled_y];
        if self.options.density_diffusion == DensityDiffusion::Renormalised {
            let gradient = [&*work.gradient_x, &*work.gradient_y];
            self.pairs.each(&mut self.slants[..n], &Slants { gradient, places });
        }
        let factors = &mut self.numbers[..n];
        with_diffusion!(self.options.density_diffusion, work, &[], formulation => {
            self.pairs.each(factors, &Velocities { fluid, places, flow, formulation, diffused });
        });
    }

    /// New pressures of the ghosts that count.
    pub(super) fn press_ghosts(&mut self) {
        let (path, bodies, water) = (self.pairs.path, &self.held_bodies, &*self.work.pressure);
        self.exchange.refresh_pressures(path, &self.ghosts, bodies, water);
        self.exchange.pack_pressures(path, &mut self.numbers[self.fluid.padded_len()..]);
    }

    /// New velocities of the ghosts that count.
    pub(super) fn mirror_ghosts(&mut self) {
        let (path, bodies, flow) = (self.pairs.path, &self.held_bodies, self.flow());
        let water = [&*self.fluid.vx, &*self.fluid.vy];
        self.exchange.refresh_velocities(path, &self.ghosts, bodies, water);
        self.exchange.pack_velocities(path, flow, &mut self.numbers[self.fluid.padded_len()..]);
    }
}
