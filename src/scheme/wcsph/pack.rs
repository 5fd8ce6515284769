//! The data of each particle, packed for the pair loops.

use super::pressing::Pressing;
use super::{Wcsph, Workspace};
use crate::pairs::{Double, Each, Factors, Fluid, Here, Record, Scaling};

/// Everything about the water that the pass of a full step reads.
struct Whole<'a> {
    pressing: Pressing<'a>,
    scaling: Scaling,
    fluid: &'a Fluid,
    /// The predicted positions.
    ahead: [&'a [f64]; 2],
    /// The kernel gradient's correction, xx, xy, yy; the identity without corrections.
    correction: [&'a [f64]; 3],
}

/// Rows of the pressure, of the field that diffusion smooths, and of the places over R; then the
/// records.
type WholeRows<'r> = ([&'r mut [f64]; 4], &'r mut [Record]);

impl Each<WholeRows<'_>> for Whole<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, records): &mut WholeRows<'_>) {
        let Whole { pressing, scaling, fluid, ahead, correction } = self;
        let [pressures, diffused, scaled_x, scaled_y] = fields;
        let (density, y) = (here.eight(&fluid.density), here.eight(&fluid.y));
        let [p, smoothed] = pressing.find::<D>(here, density, y);
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

impl Wcsph {
    /// Packs pressures and all data of the fluid for the pass of a full step.
    pub(super) fn pack(&mut self) {
        let n = self.fluid.padded_len();
        let Workspace { carried, pressure, scaled_x, scaled_y, .. } = &mut self.work;
        let (fluid, scaling) = (&self.fluid, self.scaling);
        let state = [&*carried.density_rate, &*carried.tension];
        let whole = Whole {
            pressing: Pressing::of(&self.options, self.bulk_time, state),
            scaling,
            fluid,
            ahead: [&self.ahead[0], &self.ahead[1]],
            correction: carried.correction(),
        };
        let fields =
            [&mut pressure[..n], &mut self.diffused[..n], &mut scaled_x[..n], &mut scaled_y[..n]];
        self.pairs.each((fields, &mut self.records[..n]), &whole);
    }

    /// New pressures of the ghosts that count.
    pub(super) fn press_ghosts(&mut self) {
        let (path, bodies, water) = (self.pairs.path, &self.held_bodies, &*self.work.pressure);
        let numbers = &mut self.numbers[self.fluid.padded_len()..];
        self.exchange.refresh_pressures(path, &self.ghosts, bodies, water, numbers);
    }

    /// New velocities of those ghosts.
    pub(super) fn mirror_ghosts(&mut self) {
        let (path, bodies, flow) = (self.pairs.path, &self.held_bodies, self.flow());
        let water = [&*self.fluid.vx, &*self.fluid.vy];
        let numbers = (flow, &mut self.numbers[self.fluid.padded_len()..]);
        self.exchange.refresh_velocities(path, &self.ghosts, bodies, water, numbers);
        if self.exchange.gives().next().is_some() {
            let padded = self.fluid.padded_len();
            self.bed_numbers.resize(self.numbers.len(), Factors::default());
            let numbers = (flow, &mut self.bed_numbers[padded..]);
            self.exchange.give_back(path, bodies, water, &mut self.work.given, numbers);
        }
    }
}
