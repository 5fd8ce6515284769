//! Velocities and places: kick and drift, between walls that move.

use super::diffusion::{Diffusion, with_diffusion};
use super::pressing::Pressing;
use super::tension::Settling;
use super::{Wcsph, WcsphOptions, Workspace};
use crate::body::{BodyMotion, Place};
use crate::boundary::Plane;
use crate::pairs::{Double, Each, Factors, Flow, Fluid, Here, Summed};
use crate::water::HoldInside;

/// New velocities, and the neighbours' numbers for the continuity pass: see [`Flow`].
struct Velocities<'a, F> {
    accelerations: [&'a [f64]; 2],
    /// Length of the step, seconds.
    dt: f64,
    /// How many particles there are.
    all: usize,
    /// Places over R.
    places: [&'a [f64]; 2],
    flow: Flow,
    formulation: F,
    diffused: &'a [f64],
}

/// Rows of the velocities; then the numbers.
type VelocityRows<'r> = ([&'r mut [f64]; 2], &'r mut [Factors]);

impl<F: Diffusion> Each<VelocityRows<'_>> for Velocities<'_, F> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, ([vx, vy], factors): &mut VelocityRows<'_>) {
        let ([along, up], dt) = (here.all::<D, 2>(self.accelerations), D::splat(self.dt));
        here.put_within(self.all, vx, here.in_rows::<D>(vx) + dt * along);
        here.put_within(self.all, vy, here.in_rows::<D>(vy) + dt * up);
        let velocity = [here.in_rows::<D>(vx), here.in_rows(vy)];
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

/// New densities and places. If an acoustic step is next, the water is also held inside and gets
/// new pressures.
struct Drift<'a> {
    /// How many particles there are.
    all: usize,
    /// Length of the step, seconds.
    dt: f64,
    rate: &'a [f64],
    settling: Option<Settling<'a>>,
    next: Option<Next<'a>>,
}

/// The work for an acoustic step. For a neighbour's numbers see [`super::acoustic::Acoustic`].
struct Next<'a> {
    inside: HoldInside<'a>,
    pressing: Pressing<'a>,
    /// Places over R.
    places: [&'a [f64]; 2],
    /// The kernel gradient's correction: xx, xy, yy.
    correction: [&'a [f64]; 3],
}

/// Rows of places, velocities and densities; of pressures and the field that diffusion smooths; of
/// the neighbours' numbers.
type DriftRows<'r> = (([&'r mut [f64]; 5], [&'r mut [f64]; 2]), &'r mut [Factors]);

impl Summed<DriftRows<'_>> for Drift<'_> {
    /// Adds up the energy gained as water settles and is held inside, J/m.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, factors): &mut DriftRows<'_>) -> D {
        let ([x, y, vx, vy, density], [pressures, diffused]) = fields;
        let (all, dt) = (self.all, D::splat(self.dt));
        here.put_within(all, density, here.in_rows::<D>(density) + dt * here.of(self.rate));
        here.put_within(all, x, here.in_rows::<D>(x) + dt * here.in_rows(vx));
        here.put_within(all, y, here.in_rows::<D>(y) + dt * here.in_rows(vy));
        let mut gained = D::splat(0.0);
        if let Some(settling) = &self.settling {
            gained += settling.at::<D>(here, all, density);
        }
        if let Some(Next { inside, pressing, places, correction }) = &self.next {
            gained += inside.at::<D>(here, &mut [[x, y], [vx, vy]]);
            let (density, y) = (here.eight_in_rows(density), here.eight_in_rows(y));
            let [p, smoothed] = pressing.find::<D>(here, density, y);
            here.put(pressures, p);
            here.put(diffused, smoothed);
            let [xx, xy, yy] = here.all::<D, 3>(*correction);
            let numbers = Factors::of_pressure([p * xx, p * xy, p * yy], here.all(*places));
            here.put_numbers(factors, numbers);
        }
        gained
    }
}

impl Wcsph {
    /// Adds to the accelerations the effect of the wall's own acceleration, and the field.
    pub(super) fn complete_accelerations(&mut self, wall_acceleration: f64) {
        let (fluid, work) = (&self.fluid, &mut self.work);
        if wall_acceleration != 0.0 {
            for tally in self.pairs.tallies() {
                let accelerations = [&mut *work.acceleration_x, &mut *work.acceleration_y];
                tally.add_responses(wall_acceleration, accelerations);
            }
        }
        if let Some(field) = self.options.field {
            for k in 0..fluid.len() {
                let [x, y] = field.acceleration([fluid.x[k], fluid.y[k]]);
                work.acceleration_x[k] += x;
                work.acceleration_y[k] += y;
            }
        }
    }

    /// New velocities.
    pub(super) fn kick(&mut self, dt: f64) {
        let (n, all) = (self.fluid.padded_len(), self.fluid.len());
        let (flow, work, diffused) = (self.flow(), &self.work, &*self.diffused);
        let accelerations = [&*work.acceleration_x, &*work.acceleration_y];
        let places = [&*work.scaled_x, &*work.scaled_y];
        if self.options.density_diffusion.reads().slants {
            let gradient = [&*work.gradient_x, &*work.gradient_y];
            self.pairs.each(&mut self.slants[..n], &Slants { gradient, places });
        }
        let velocities = [&mut self.fluid.vx[..n], &mut self.fluid.vy[..n]];
        let rows = (velocities, &mut self.numbers[..n]);
        with_diffusion!(self.options.density_diffusion, work, &[], formulation => {
            let velocities =
                Velocities { accelerations, dt, all, places, flow, formulation, diffused };
            self.pairs.each(rows, &velocities);
        });
    }

    /// New densities and places in a step between bodies. If an acoustic step is next, also its
    /// pressures. Returns the energy that is lost.
    pub(super) fn drift(&mut self, dt: f64, bodies: &[BodyMotion], acoustic_is_next: bool) -> f64 {
        let (all, n, options) = (self.fluid.len(), self.fluid.padded_len(), &self.options);
        let Workspace { carried, pressure, completeness, scaled_x, scaled_y, .. } = &mut self.work;
        let Fluid { x, y, vx, vy, density, mass, .. } = &mut self.fluid;
        let (rate, tension) = (&*carried.density_rate, &*carried.tension);
        let settling = options.corrected_gradients.then(|| Settling {
            state: options.state,
            rate: (dt * options.state.sound_speed / options.smoothing_length()).min(1.0),
            most: options.most_at_surface(),
            completeness,
            tension,
            mass,
        });
        let next = acoustic_is_next.then(|| Next {
            inside: HoldInside::of(
                (all, mass),
                [options.spacing, options.gravity],
                (&self.ghosts, &self.planes, bodies),
            ),
            pressing: Pressing::of(options, self.bulk_time, [rate, tension]),
            places: [scaled_x, scaled_y],
            correction: carried.correction(),
        });
        let drift = Drift { all, dt, rate, settling, next };
        let water = [x, y, vx, vy, density].map(|field| &mut field[..n]);
        let found = [pressure, &mut self.diffused].map(|field| &mut field[..n]);
        -self.pairs.sum_each(((water, found), &mut self.numbers[..n]), &drift)
    }

    /// The walls' faces at the end of a step.
    pub(super) fn move_planes(&mut self, dt: f64, bodies: &[BodyMotion]) {
        self.planes.clear();
        self.planes.extend(
            self.ghosts
                .bodies
                .iter()
                .zip(bodies)
                .map(|(body, motion)| body.plane.moved(motion.offset).moved(dt * motion.velocity)),
        );
        if self.ghosts.crest.is_some() {
            // Here the outline is the wall: water may go over it.
            let wall = &mut self.planes[Place::Right.number()];
            *wall = Plane::nowhere(wall.normal);
        }
        if self.ghosts.keeps_behind() {
            // The floor behind the wall may lie lower.
            let bed = &mut self.planes[Place::Bed.number()];
            *bed = Plane::nowhere(bed.normal);
        }
    }

    /// Holds the particles in front of the walls. Returns the energy that is lost.
    pub(super) fn hold_inside(&mut self, bodies: &[BodyMotion]) -> f64 {
        let (n, all) = (self.fluid.padded_len(), self.fluid.len());
        let WcsphOptions { spacing, gravity, .. } = self.options;
        let Fluid { x, y, vx, vy, mass, .. } = &mut self.fluid;
        let walls = (&self.ghosts, &*self.planes, bodies);
        let hold = HoldInside::of((all, mass), [spacing, gravity], walls);
        let rows = [[x, y], [vx, vy]].map(|pair| pair.map(|field| &mut field[..n]));
        -self.pairs.sum_each(rows, &hold)
    }
}
