//! New places, and all that follows from them particle by particle.

use super::passes::{TENSION_FROM, TENSION_FULL};
use super::pressing::Pressing;
use super::{Wcsph, Workspace};
use crate::body::BodyMotion;
use crate::pairs::{Double, Eight, Factors, Fluid, Here, Summed};
use crate::scheme::StateEquation;
use crate::water::{HoldInside, Slack};

/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.45, 0.25], tension: [TENSION_FULL, TENSION_FROM] };

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
type Rows<'r> = (([&'r mut [f64]; 5], [&'r mut [f64]; 2]), &'r mut [Factors]);

impl Summed<Rows<'_>> for Drift<'_> {
    /// Adds up the energy gained as water settles and is held inside, J/m.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, (fields, factors): &mut Rows<'_>) -> D {
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

/// Relaxes the density of particles that are at the pressure of the air. These are spray with too
/// few neighbours, and water near the surface that would be under tension. It also relaxes water
/// near the surface that is pressed harder than is possible: see
/// [`super::WcsphOptions::most_at_surface`].
struct Settling<'a> {
    state: StateEquation,
    /// Share of a difference that is removed in the step.
    rate: f64,
    /// The largest density that water near the surface can keep, kg/m³.
    most: f64,
    completeness: &'a [f64],
    tension: &'a [f64],
    mass: &'a [f64],
}

impl Settling<'_> {
    /// Relaxes densities; returns the elastic energy that each particle with an incomplete support
    /// gains.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, all: usize, density: &mut [f64]) -> D {
        if !here.of::<D>(self.completeness).any_less(D::splat(TENSION_FULL)) {
            return D::splat(0.0);
        }
        let mut gained: Eight = Default::default();
        let rows = here.eight_in_rows(density).iter_mut().zip(&mut gained);
        for (k, (density, gained)) in here.numbers().zip(rows) {
            if k < all && self.completeness[k] < TENSION_FULL {
                *gained = self.settle(k, density);
            }
        }
        D::load(&gained)
    }

    fn settle(&self, k: usize, density: &mut f64) -> f64 {
        let (state, now) = (&self.state, *density);
        let share = SLACK.share(self.completeness[k], now < state.surface_density).min(1.0);
        let mut rise = self.rate * share.max(0.0) * (state.surface_density - now);
        if now > self.most {
            let relieved = SLACK.share(self.completeness[k], true).clamp(0.0, 1.0);
            rise = rise.min(self.rate * relieved * (self.most - now));
        }
        if rise == 0.0 {
            return 0.0;
        }
        // Tension that did no work as it grew takes no energy away.
        let acting = if rise > 0.0 { self.tension[k] } else { 1.0 };
        *density += rise;
        self.mass[k] * acting * (state.elastic_energy(*density) - state.elastic_energy(now))
    }
}

impl Wcsph {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::StateEquationChoice;

    #[test]
    fn water_near_the_surface_gives_up_what_it_cannot_press() {
        let choice = StateEquationChoice::Linear;
        let state = StateEquation { choice, surface_density: 1000.0, sound_speed: 11.2 };
        let completeness = [1.0, 0.95, 0.75, 0.6, 0.2];
        let settling = Settling {
            state,
            rate: 0.5,
            most: 1080.0,
            completeness: &completeness,
            tension: &[1.0; 5],
            mass: &[0.1; 5],
        };
        let settled = |start: f64| {
            let mut densities = [start; 5];
            let gained: f64 = densities
                .iter_mut()
                .enumerate()
                .map(|(k, density)| settling.settle(k, density))
                .sum();
            (densities, gained)
        };
        // At pressures that sound can have, only spray changes.
        let (sound, _) = settled(1079.0);
        assert_eq!(sound[..4], [1079.0; 4]);
        assert!((sound[4] - 1039.5).abs() < 1e-9, "{sound:?}");
        let (pressed, gained) = settled(1180.0);
        let expected = [1180.0, 1180.0, 1155.0, 1130.0, 1090.0];
        assert!(pressed.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{pressed:?}");
        let energies = pressed.map(|density| 0.1 * state.elastic_energy(density));
        let lost = 5.0 * 0.1 * state.elastic_energy(1180.0) - energies.iter().sum::<f64>();
        assert!(lost > 0.0 && (gained + lost).abs() < 1e-12 * lost, "{gained} for {lost} J/m");
    }
}
