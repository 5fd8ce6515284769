//! New places, and all that comes of them particle by particle.

use super::passes::{TENSION_FROM, TENSION_FULL};
use super::pressing::Pressing;
use super::{Wcsph, Workspace};
use crate::body::BodyMotion;
use crate::pairs::{Double, Each, Factors, Fluid, Here};
use crate::scheme::StateEquation;
use crate::water::{HoldInside, Slack};

/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.45, 0.25], tension: [TENSION_FULL, TENSION_FROM] };

/// New densities and places. Where an acoustic step is next, the water is held inside, and has new
/// pressures.
struct Drift<'a> {
    /// How many particles there are.
    all: usize,
    /// Length of the step, seconds.
    dt: f64,
    rate: &'a [f64],
    settling: Option<Settling<'a>>,
    next: Option<Next<'a>>,
}

/// What is done for an acoustic step: see [`super::acoustic::Acoustic`] for what a neighbour's pressures
/// are.
struct Next<'a> {
    inside: HoldInside<'a>,
    pressing: Pressing<'a>,
    /// Places over R.
    places: [&'a [f64]; 2],
    /// The kernel gradient's: xx, xy, yy.
    correction: [&'a [f64]; 3],
}

/// Rows of places, velocities and densities; of the elastic energy that goes, pressures and what
/// diffusion smooths; then the numbers.
type Rows<'r> = (([&'r mut [f64]; 5], [&'r mut [f64]; 3]), &'r mut [Factors]);

impl Each<Rows<'_>> for Drift<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, factors): &mut Rows<'_>) {
        let ([x, y, vx, vy, density], [lost, pressures, diffused]) = fields;
        let (all, dt) = (self.all, D::splat(self.dt));
        here.put_within(all, density, here.in_rows::<D>(density) + dt * here.of(self.rate));
        here.put_within(all, x, here.in_rows::<D>(x) + dt * here.in_rows(vx));
        here.put_within(all, y, here.in_rows::<D>(y) + dt * here.in_rows(vy));
        if let Some(settling) = &self.settling {
            settling.at::<D>(here, all, density, lost);
        }
        if let Some(Next { inside, pressing, places, correction }) = &self.next {
            inside.at::<D>(here, &mut [[x, y], [vx, vy]]);
            let (density, y) = (here.eight_in_rows(density), here.eight_in_rows(y));
            let [p, smoothed] = pressing.find::<D>(here, density, y);
            here.put(pressures, p);
            here.put(diffused, smoothed);
            let [xx, xy, yy] = here.all::<D, 3>(*correction);
            let numbers = Factors::of_pressure([p * xx, p * xy, p * yy], here.all(*places));
            here.put_numbers(factors, numbers);
        }
    }
}

/// Relaxes the density of particles that feel no pressure: spray with too few neighbours, and water near
/// the surface that would be under tension. Both are at the pressure of the air.
struct Settling<'a> {
    state: StateEquation,
    /// How much of a difference goes in the step.
    rate: f64,
    completeness: &'a [f64],
    tension: &'a [f64],
    mass: &'a [f64],
}

impl Settling<'_> {
    /// Relaxes densities; tells the elastic energy that each particle without a complete support loses.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, all: usize, density: &mut [f64], lost: &mut [f64]) {
        if !here.of::<D>(self.completeness).any_less(D::splat(TENSION_FULL)) {
            return;
        }
        let rows = here.eight_in_rows(density).iter_mut().zip(here.eight_in_rows(lost));
        for (k, (density, lost)) in here.numbers().zip(rows) {
            if k < all && self.completeness[k] < TENSION_FULL {
                *lost = self.settle(k, density);
            }
        }
    }

    fn settle(&self, k: usize, density: &mut f64) -> f64 {
        let (state, now) = (&self.state, *density);
        let share = SLACK.share(self.completeness[k], now < state.surface_density).min(1.0);
        if share <= 0.0 {
            return 0.0;
        }
        let rise = self.rate * share * (state.surface_density - now);
        // Tension that did no work as it grew takes none away.
        let acting = if rise > 0.0 { self.tension[k] } else { 1.0 };
        let pressure = state.pressure(now) * acting;
        *density += rise;
        self.mass[k] * pressure / (now * now) * rise
    }
}

impl Wcsph {
    /// New densities and places, in a step between bodies; and, where an acoustic one is next, pressures
    /// for it. Returns the elastic energy that goes.
    pub(super) fn drift(&mut self, dt: f64, bodies: &[BodyMotion], acoustic_is_next: bool) -> f64 {
        let (all, n, options) = (self.fluid.len(), self.fluid.padded_len(), &self.options);
        let Workspace { carried, pressure, lost, completeness, scaled_x, scaled_y, .. } =
            &mut self.work;
        let Fluid { x, y, vx, vy, density, mass, .. } = &mut self.fluid;
        let (rate, tension) = (&*carried.density_rate, &*carried.tension);
        let settling = options.corrected_gradients.then(|| Settling {
            state: options.state,
            rate: (dt * options.state.sound_speed / options.smoothing_length()).min(1.0),
            completeness,
            tension,
            mass,
        });
        let next = acoustic_is_next.then(|| Next {
            inside: HoldInside {
                all,
                planes: &self.planes,
                bed: self.ghosts.outline(),
                bodies,
                spacing: options.spacing,
            },
            pressing: Pressing::of(options, self.bulk_time, [rate, tension]),
            places: [scaled_x, scaled_y],
            correction: carried.correction(),
        });
        let drift = Drift { all, dt, rate, settling, next };
        let water = [x, y, vx, vy, density].map(|field| &mut field[..n]);
        let found = [lost, pressure, &mut self.diffused].map(|field| &mut field[..n]);
        self.pairs.each(((water, found), &mut self.numbers[..n]), &drift);
        self.near_surface.iter().fold(0.0, |loss, &k| loss - self.work.lost[k as usize])
    }
}
