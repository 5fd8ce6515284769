//! Pressures from densities, and the field that density diffusion smooths.

use super::WcsphOptions;
use crate::pairs::{Double, Eight, Here};
use crate::scheme::StateEquation;

/// From densities to pressures.
#[derive(Clone, Copy)]
pub(super) struct Pressing<'a> {
    state: StateEquation,
    /// Pressures are ahead of the densities by this time, seconds.
    bulk_time: f64,
    /// g ρ_s/c0² if diffusion is to leave still water alone, else 0.
    hydrostatic: f64,
    rate: &'a [f64],
    tension: &'a [f64],
}

impl<'a> Pressing<'a> {
    /// With the rates of change of density, and the shares of tension that the water bears.
    pub fn of(
        options: &WcsphOptions,
        bulk_time: f64,
        [rate, tension]: [&'a [f64]; 2],
    ) -> Pressing<'a> {
        Pressing {
            state: options.state,
            bulk_time,
            hydrostatic: options.hydrostatic_slope(),
            rate,
            tension,
        }
    }

    /// Pressures at densities and heights, with less tension near the free surface; and the field
    /// that density diffusion smooths: ρ, or ρ less its value in still water.
    #[inline(always)]
    pub fn find<D: Double>(self, here: Here, density: &Eight, y: &Eight) -> [D; 2] {
        let Pressing { state, bulk_time, hydrostatic, .. } = self;
        let (rate, tension) = (here.eight(self.rate), here.eight(self.tension));
        let (mut pressures, mut diffused) = (*density, *density);
        for k in 0..density.len() {
            let pressure = state.pressure(density[k] + bulk_time * rate[k]);
            pressures[k] = if pressure < 0.0 { pressure * tension[k] } else { pressure };
        }
        if hydrostatic > 0.0 {
            for k in 0..density.len() {
                diffused[k] = state.raised(density[k]) + hydrostatic * y[k];
            }
        }
        [D::load(&pressures), D::load(&diffused)]
    }
}
