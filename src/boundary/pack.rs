//! Ghosts as neighbours of the water: the numbers that passes over held pairs read of them.

use super::exchange::Exchange;
use super::image::Image;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
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
            let numbers = Factors::of_pressure(pressed, place);
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

impl Exchange {
    /// The pressures of the ghosts that count, as numbers of neighbours; `factors` are those of the ghosts
    /// alone.
    pub fn pack_pressures(&self, path: SimdPath, factors: &mut [Factors]) {
        let images = (&self.counting[..], &self.images[..]);
        dispatch(path, GhostPressures { images, factors });
    }

    /// Their velocities, likewise.
    pub fn pack_velocities(&self, path: SimdPath, flow: Flow, factors: &mut [Factors]) {
        let images = (&self.counting[..], &self.images[..]);
        dispatch(path, GhostVelocities { flow, images, factors });
    }
}
