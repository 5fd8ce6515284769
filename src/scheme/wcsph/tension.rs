//! Tension: the share that water bears near its surface, and how water settles where it takes no
//! pressure.

use super::Wcsph;
use super::correction::surface_share;
use crate::pairs::{Double, Each, Eight, Here};
use crate::scheme::StateEquation;
use crate::water::Slack;

/// Water bears no tension below this completeness, at the surface ...
const TENSION_FROM: f64 = 0.6;
/// ... and all of it above this.
const TENSION_FULL: f64 = 0.9;
/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.45, 0.25], tension: [TENSION_FULL, TENSION_FROM] };

/// The share of tension that water bears under the surface. The correction there is reduced for the
/// balance under gravity, but the tension is not.
struct Bearing<'a> {
    completeness: &'a [f64],
    first_row: f64,
}

impl Each<&mut [f64]> for Bearing<'_> {
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, tension: &mut &mut [f64]) {
        let completeness = here.of::<D>(self.completeness);
        let inside =
            (completeness - D::splat(TENSION_FROM)) * D::splat(1.0 / (TENSION_FULL - TENSION_FROM));
        let share = inside.max(D::splat(0.0)).div(surface_share(completeness, self.first_row));
        here.put(tension, share.min(D::splat(1.0)));
    }
}

/// Relaxes the density of particles that are at the pressure of the air. These are spray with too
/// few neighbours, and water near the surface that would be under tension. It also relaxes water
/// near the surface that is pressed harder than is possible: see
/// [`super::WcsphOptions::most_at_surface`].
pub(super) struct Settling<'a> {
    pub state: StateEquation,
    /// Share of a difference that is removed in the step.
    pub rate: f64,
    /// The largest density that water near the surface can keep, kg/m³.
    pub most: f64,
    pub completeness: &'a [f64],
    pub tension: &'a [f64],
    pub mass: &'a [f64],
}

impl Settling<'_> {
    /// Relaxes densities; returns the elastic energy that each particle with an incomplete support
    /// gains.
    #[inline(always)]
    pub(super) fn at<D: Double>(&self, here: Here, all: usize, density: &mut [f64]) -> D {
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
    /// Sets the share of tension that the water bears in the coming steps.
    pub(super) fn set_tension(&mut self) {
        if self.options.corrected_gradients {
            let (tension, completeness) =
                (&mut *self.work.carried.tension, &*self.work.completeness);
            let first_row = self.options.first_row_share();
            self.pairs.each(tension, &Bearing { completeness, first_row });
        }
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
