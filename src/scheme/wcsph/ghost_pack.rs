//! What the held passes read of each ghost.

use super::Wcsph;
use super::pack::pressure_factors;
use crate::boundary::Image;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::{Factors, Flow};

/// New pressures of the ghosts that have water in reach, like those of the water.
struct GhostPressures<'a> {
    images: (&'a [u32], &'a [Image]),
    /// Of the ghosts alone.
    factors: &'a mut [Factors],
}

impl Task for GhostPressures<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let ((blocks, images), (factors, _)) = (self.images, self.factors.as_chunks_mut::<LANES>());
        for &block in blocks {
            let image = &images[block as usize];
            let p = L::load(&image.pressure);
            let place = [L::load(&image.place[0]), L::load(&image.place[1])];
            let [xx, xy, yy] = &image.correction;
            let pressed = [p * L::load(xx), p * L::load(xy), p * L::load(yy)];
            let numbers = pressure_factors(pressed, place);
            L::store_records(numbers, &mut factors[block as usize]);
        }
    }
}

/// Their new velocities.
struct GhostVelocities<'a> {
    flow: Flow,
    images: (&'a [u32], &'a [Image]),
    /// Of the ghosts alone.
    factors: &'a mut [Factors],
}

impl Task for GhostVelocities<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let ((blocks, images), (factors, _)) = (self.images, self.factors.as_chunks_mut::<LANES>());
        let zero = L::splat(0.0);
        for &block in blocks {
            let image = &images[block as usize];
            let velocity = [L::load(&image.velocity[0]), L::load(&image.velocity[1])];
            let place = [L::load(&image.place[0]), L::load(&image.place[1])];
            let numbers = self.flow.numbers(velocity, place, [zero, zero]);
            L::store_records(numbers, &mut factors[block as usize]);
        }
    }
}

impl Wcsph {
    /// New pressures of the ghosts that count.
    pub(super) fn press_ghosts(&mut self) {
        let (bodies, pressure) = (&self.held_bodies, &self.work.pressure);
        self.exchange.refresh_pressures(self.pairs.path, &self.ghosts, bodies, pressure);
        let factors = &mut self.numbers[self.fluid.padded_len()..];
        let images = (self.exchange.counting(), self.exchange.images());
        dispatch(self.pairs.path, GhostPressures { images, factors });
    }

    /// New velocities of the ghosts that count.
    pub(super) fn mirror_ghosts(&mut self) {
        let (bodies, water) = (&self.held_bodies, [&*self.fluid.vx, &*self.fluid.vy]);
        self.exchange.refresh_velocities(self.pairs.path, &self.ghosts, bodies, water);
        let flow = self.flow();
        let images = (self.exchange.counting(), self.exchange.images());
        let factors = &mut self.numbers[self.fluid.padded_len()..];
        dispatch(self.pairs.path, GhostVelocities { flow, images, factors });
    }
}
