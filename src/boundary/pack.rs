//! Ghosts as neighbours of the water: the numbers that passes over held pairs read of them.

use super::image::Image;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::{Factors, Flow};

/// New pressures of the ghosts in some blocks, like those of the water.
pub(super) struct GhostPressures<'a> {
    pub blocks: &'a [u32],
    /// The block that images and numbers begin with.
    pub first: usize,
    pub images: &'a [Image],
    pub factors: &'a mut [Factors],
}

impl Task for GhostPressures<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (factors, _) = self.factors.as_chunks_mut::<LANES>();
        for &block in self.blocks {
            let row = block as usize - self.first;
            let image = &self.images[row];
            let p = L::load(&image.pressure);
            let place = [L::load(&image.place[0]), L::load(&image.place[1])];
            let [xx, xy, yy] = &image.correction;
            let pressed = [p * L::load(xx), p * L::load(xy), p * L::load(yy)];
            let numbers = Factors::of_pressure(pressed, place);
            L::store_records(numbers, &mut factors[row]);
        }
    }
}

/// Their new velocities.
pub(super) struct GhostVelocities<'a> {
    pub flow: Flow,
    pub blocks: &'a [u32],
    /// The block that images and numbers begin with.
    pub first: usize,
    pub images: &'a [Image],
    pub factors: &'a mut [Factors],
}

impl Task for GhostVelocities<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (factors, _) = self.factors.as_chunks_mut::<LANES>();
        let zero = L::splat(0.0);
        for &block in self.blocks {
            let row = block as usize - self.first;
            let image = &self.images[row];
            let velocity = [L::load(&image.velocity[0]), L::load(&image.velocity[1])];
            let place = [L::load(&image.place[0]), L::load(&image.place[1])];
            let numbers = self.flow.numbers(velocity, place, [zero, zero]);
            L::store_records(numbers, &mut factors[row]);
        }
    }
}
