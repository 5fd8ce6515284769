//! What the pair loops read of each particle, packed ahead of them.

use std::ops::Range;

use super::factors::Factors;
use super::flow::Flow;
use super::momentum::store;
use super::pressing::Pressing;
use super::separation::{all_lanes, lanes};
use super::{DensityDiffusion, Wcsph};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::math::team::window;
use crate::particles::{Fluid, Record, Scaling};

/// Everything about some of the water that the pass of a full step reads.
struct Whole<'a> {
    pressing: Pressing<'a>,
    scaling: Scaling,
    fluid: &'a Fluid,
    /// Where the particles will be.
    ahead: [&'a [f64]; 2],
    correction: [&'a [f64]; 3],
    /// The particles, whole vectors.
    range: Range<usize>,
    /// Their rows of the pressure, of what diffusion smooths, and of the places over R.
    fields: [&'a mut [f64]; 4],
    records: &'a mut [Record],
}

impl Task for Whole<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Whole { pressing, scaling, fluid, ahead, correction, range, fields, records } = self;
        let [pressure, diffused, scaled_x, scaled_y] = fields;
        pressing.find(range.clone(), pressure, diffused);
        let inverse_radius = L::splat(scaling.inverse_radius);
        let (blocks, _) = records.as_chunks_mut::<LANES>();
        for (block, records) in blocks.iter_mut().enumerate() {
            let to = block * LANES;
            let at = range.start + to;
            let [x, y] = all_lanes::<L, 2>(ahead, at);
            let (x, y) = (x * inverse_radius, y * inverse_radius);
            store(scaled_x, to, x);
            store(scaled_y, to, y);
            let [xx, xy, yy] = all_lanes::<L, 3>(correction, at);
            let [vx, vy, mass, density] =
                all_lanes::<L, 4>([&fluid.vx, &fluid.vy, &fluid.mass, &fluid.density], at);
            let weight = mass.div(density) * L::splat(scaling.weight_per_volume);
            // Without corrections these are the identity.
            let p = lanes::<L>(pressure, to);
            let numbers = [x, y, vx, vy, weight, p * xx, p * xy, p * yy];
            L::store_records(numbers, records);
        }
    }
}

/// New pressures of some of the water alone, for an acoustic step: see
/// [`super::acoustic::Acoustic`] for what a neighbour's are.
struct Pressures<'a> {
    pressing: Pressing<'a>,
    /// Places over R.
    places: [&'a [f64]; 2],
    correction: [&'a [f64]; 3],
    /// The particles, whole vectors.
    range: Range<usize>,
    /// Their rows of the pressure and of what diffusion smooths.
    fields: [&'a mut [f64]; 2],
    factors: &'a mut [Factors],
}

impl Task for Pressures<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Pressures { pressing, places, correction, range, fields, factors } = self;
        let [pressure, diffused] = fields;
        pressing.find(range.clone(), pressure, diffused);
        let (blocks, _) = factors.as_chunks_mut::<LANES>();
        for (block, factors) in blocks.iter_mut().enumerate() {
            let at = range.start + block * LANES;
            let p = lanes::<L>(pressure, block * LANES);
            let place = all_lanes::<L, 2>(places, at);
            let [xx, xy, yy] = all_lanes::<L, 3>(correction, at);
            let numbers = pressure_factors([p * xx, p * xy, p * yy], place);
            L::store_records(numbers, factors);
        }
    }
}

/// New velocities of some of the water, for the continuity pass: see
/// [`super::continuity::Continuity`] for what a neighbour's are.
struct Velocities<'a> {
    velocity: [&'a [f64]; 2],
    /// Places over R.
    places: [&'a [f64]; 2],
    flow: Flow,
    diffusion: DensityDiffusion,
    diffused: &'a [f64],
    /// Each particle's share in the diffusion.
    share: &'a [f64],
    /// R ∇ψ, where diffusion wants it.
    slopes: [&'a [f64]; 2],
    /// The particles, whole vectors.
    range: Range<usize>,
    factors: &'a mut [Factors],
    slants: &'a mut [Factors],
}

impl Task for Velocities<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Velocities { velocity, places, flow, diffusion, diffused, share, slopes, .. } = self;
        let (one, two) = (L::splat(1.0), L::splat(2.0));
        let (blocks, _) = self.factors.as_chunks_mut::<LANES>();
        for (block, factors) in blocks.iter_mut().enumerate() {
            let at = self.range.start + block * LANES;
            let velocity = all_lanes::<L, 2>(velocity, at);
            let [x, y] = all_lanes::<L, 2>(places, at);
            let diffused = lanes::<L>(diffused, at);
            let smoothed = match diffusion {
                DensityDiffusion::None | DensityDiffusion::Hydrostatic => {
                    let share = lanes::<L>(share, at);
                    [share * diffused, share]
                }
                DensityDiffusion::Molteni => [diffused, one],
                DensityDiffusion::Renormalised => {
                    let [slope_x, slope_y] = all_lanes::<L, 2>(slopes, at);
                    let zero = L::splat(0.0);
                    let slants = &mut self.slants.as_chunks_mut::<LANES>().0[block];
                    L::store_records([slope_x, slope_y, x, y, zero, zero, zero, zero], slants);
                    [two * diffused - (slope_x * x + slope_y * y), one]
                }
            };
            L::store_records(flow.numbers(velocity, [x, y], smoothed), factors);
        }
    }
}

impl Wcsph {
    /// Pressures, and everything about the fluid that the pass of a full step reads.
    pub(super) fn pack(&mut self) {
        let n = self.fluid.padded_len();
        let (path, fluid, scaling) = (self.path, &self.fluid, self.scaling);
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
            let range = part.lanes();
            dispatch(
                path,
                Whole { pressing, scaling, fluid, ahead, correction, range, fields, records },
            );
        });
    }

    /// The new pressures of some parts' water alone.
    pub(super) fn pack_pressures(&mut self, some: Range<usize>) {
        let n = self.fluid.padded_len();
        let (path, fluid, work) = (self.path, &self.fluid, &mut self.work);
        let pressing =
            Pressing::of(&self.options, self.bulk_time, fluid, [&work.density_rate, &work.tension]);
        let places = [&*work.scaled_x, &*work.scaled_y];
        let correction = [&*work.correction_xx, &*work.correction_xy, &*work.correction_yy];
        let rows = (
            [&mut work.pressure[..n], &mut self.diffused[..n]],
            &mut self.numbers.pressures_mut()[..n],
        );
        let (parts, rows) = window(&mut self.parts, rows, some);
        self.team.share(parts, rows, &|part, (fields, factors)| {
            let range = part.lanes();
            dispatch(path, Pressures { pressing, places, correction, range, fields, factors });
        });
    }

    /// The new velocities of some parts' water.
    pub(super) fn pack_velocities(&mut self, some: Range<usize>) {
        let n = self.fluid.padded_len();
        let (path, fluid, work, flow) = (self.path, &self.fluid, &self.work, self.flow());
        let (diffusion, diffused) = (self.options.density_diffusion, &*self.diffused);
        let velocity = [&*fluid.vx, &*fluid.vy];
        let places = [&*work.scaled_x, &*work.scaled_y];
        // Not all of these are there, or wanted, with every form of diffusion.
        let (share, slopes) = (&*work.diffused_share, [&*work.gradient_x, &*work.gradient_y]);
        let rows = (&mut self.numbers.velocities_mut()[..n], &mut self.slants[..]);
        let (parts, rows) = window(&mut self.parts, rows, some);
        self.team.share(parts, rows, &|part, (factors, slants)| {
            let range = part.lanes();
            dispatch(
                path,
                Velocities {
                    velocity,
                    places,
                    flow,
                    diffusion,
                    diffused,
                    share,
                    slopes,
                    range,
                    factors,
                    slants,
                },
            );
        });
    }
}

/// P_xx, P_xy, P_yy, (P r)_x, (P r)_y, and nothing more.
#[inline(always)]
pub(super) fn pressure_factors<L: Lanes>([xx, xy, yy]: [L; 3], [x, y]: [L; 2]) -> [L; 8] {
    let nothing = L::splat(0.0);
    [xx, xy, yy, xx * x + xy * y, xy * x + yy * y, nothing, nothing, nothing]
}
