//! Ghosts as images of the water around their mirror points.

use super::ghosts::Ghosts;
use super::rules::ExchangeRules;
use super::sums::Means;
use crate::body::BodyMotion;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::{Factors, Flow};

/// The coefficients that turn the water's means into eight ghosts, from one filling to the next,
/// and the last results. Both laws are linear, with factors that depend only on places.
#[derive(Debug, Clone, Copy, Default)]
pub struct Image {
    /// x and y over the support radius.
    pub place: [[f64; LANES]; 2],
    /// Mirrored correction of the kernel gradient: xx, xy, yy.
    pub correction: [[f64; LANES]; 3],
    /// Pressures, Pa.
    pub pressure: [f64; LANES],
    /// Velocities, m/s.
    pub velocity: [[f64; LANES]; 2],
    /// Turns a velocity relative to the wall into the image's: xx, xy, yy.
    pub(super) mirror: [[f64; LANES]; 3],
    /// The same for smooth walls.
    pub(super) smooth: [[f64; LANES]; 3],
    /// Vector from the place at which the water's mean pressure holds to the ghost, metres. Its x
    /// is zero where the wall's acceleration does not count.
    pub(super) lever: [[f64; LANES]; 2],
    /// The head that the water's own acceleration along the face adds, m²/s².
    pub(super) falling: [f64; LANES],
    /// Lower bound of the pressure, Pa.
    pub(super) lowest: [f64; LANES],
}

/// New pressures of the ghosts in some blocks, and their numbers as neighbours of the water.
pub(super) struct Press<'a> {
    pub blocks: &'a [u32],
    /// The block that images and means begin with.
    pub first: usize,
    pub images: &'a mut [Image],
    pub means: &'a [Means],
    pub ghosts: &'a Ghosts,
    pub bodies: &'a [BodyMotion],
    pub rules: ExchangeRules,
    /// Numbers are only needed for passes over held pairs.
    pub factors: Option<&'a mut [Factors]>,
}

impl Task for Press<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let ExchangeRules { gravity, surface_density, sound_speed, .. } = self.rules;
        let (gravity, zero) = (L::splat(gravity), L::splat(0.0));
        // Density at zero pressure, kg/m³, and 1/c0², s²/m².
        let surface = L::splat(surface_density);
        let per_pressure = L::splat(1.0 / (sound_speed * sound_speed));
        let mut factors = self.factors.map(|factors| factors.as_chunks_mut::<LANES>().0);
        for &block in self.blocks {
            let (block, row) = (block as usize, block as usize - self.first);
            let image = &mut self.images[row];
            let body = &self.bodies[self.ghosts.target_body[block] as usize];
            let mean = L::load(&self.means[row].pressure);
            let density = mean.mul_add(per_pressure, surface);
            let (x, y) = (L::load(&image.lever[0]), L::load(&image.lever[1]));
            let falling = L::load(&image.falling);
            let head = L::splat(body.acceleration).mul_add(x, gravity * y) + falling;
            let pressure = mean + (zero - density) * head;
            let pressure = pressure.max(L::load(&image.lowest));
            pressure.store(&mut image.pressure);
            if let Some(factors) = &mut factors {
                let pressed = image.correction.each_ref().map(|part| pressure * L::load(part));
                let place = image.place.each_ref().map(L::load);
                L::store_records(Factors::of_pressure(pressed, place), &mut factors[row]);
            }
        }
    }
}

/// New velocities of the ghosts in some blocks, and their numbers.
pub(super) struct Mirror<'a> {
    pub blocks: &'a [u32],
    /// The block that images and means begin with.
    pub first: usize,
    pub images: &'a mut [Image],
    pub means: &'a [Means],
    pub ghosts: &'a Ghosts,
    pub bodies: &'a [BodyMotion],
    pub factors: Option<(Flow, &'a mut [Factors])>,
}

impl Task for Mirror<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let factors = self.factors;
        let mut factors = factors.map(|(flow, all)| (flow, all.as_chunks_mut::<LANES>().0));
        let zero = L::splat(0.0);
        for &block in self.blocks {
            let (block, row) = (block as usize, block as usize - self.first);
            let (image, means) = (&mut self.images[row], &self.means[row]);
            let wall = L::splat(self.bodies[self.ghosts.target_body[block] as usize].velocity);
            let [xx, xy, yy] = &image.mirror;
            let (xx, xy, yy) = (L::load(xx), L::load(xy), L::load(yy));
            let (u, v) = (L::load(&means.vx) - wall, L::load(&means.vy));
            let velocity = [xx.mul_add(u, xy * v) + wall, xy.mul_add(u, yy * v)];
            let [vx, vy] = &mut image.velocity;
            velocity[0].store(vx);
            velocity[1].store(vy);
            if let Some((flow, factors)) = &mut factors {
                let place = image.place.each_ref().map(L::load);
                let numbers = flow.numbers(velocity, place, [zero, zero]);
                L::store_records(numbers, &mut factors[row]);
            }
        }
    }
}
