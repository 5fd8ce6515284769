//! The steps of a bed that gives back what work it does: see `giving.rs`.

use super::exchange::Exchange;
use super::giving::Giving;
use crate::math::simd::{Lanes, SimdPath, Task, dispatch};
use crate::pairs::Record;

/// Gives back what ran into the ghosts of some blocks.
struct GiveBack<'a> {
    exchange: &'a Exchange,
    giving: &'a Giving,
    velocities: [&'a [f64]; 2],
    given: &'a mut [f64],
}

impl Task for GiveBack<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let GiveBack { exchange, giving, velocities: [u, v], given } = self;
        let [along, up] = &giving.fluxes;
        for part in &exchange.parts {
            for &block in part.among(giving.blocks(&exchange.counting)) {
                let (row, image) = (block as usize, &exchange.images[block as usize]);
                let ([along], [up]) = (along.sums::<L, 1>(row, [u]), up.sums::<L, 1>(row, [v]));
                // A pressure that is held at its lowest is not the water's.
                let (zero, pressure) = (L::splat(0.0), L::load(&image.pressure));
                let flux = L::load(&image.lowest).select_less(pressure, along + up, zero);
                let flux = flux * L::load(&exchange.scale[row]);
                let (entries, weights) = part.held.of(row - part.blocks.start);
                for (&k, weight) in entries.iter().zip(weights) {
                    given[k as usize] += (L::load(weight) * flux).sum();
                }
            }
        }
    }
}

impl Exchange {
    /// Whether the bed gives back what it does.
    pub fn gives_back(&self) -> bool {
        self.giving.is_some()
    }

    /// Finds how water runs into the ghosts of the bed, for the steps until the next full one. The records are those of
    /// the water, and of the ghosts alone.
    pub fn find_fluxes(&mut self, path: SimdPath, records: [&[Record]; 2]) {
        let Some(mut giving) = self.giving.take() else { return };
        giving.find(path, &self.rules, (&self.counting, &self.images), records);
        self.giving = Some(giving);
    }

    /// Finds the volume per second that each particle gives to the bed's ghosts, m²/s, from velocities along x and y.
    pub fn give_back(&self, path: SimdPath, velocities: [&[f64]; 2], given: &mut [f64]) {
        let Some(giving) = &self.giving else { return };
        given.fill(0.0);
        dispatch(path, GiveBack { exchange: self, giving, velocities, given });
    }
}
