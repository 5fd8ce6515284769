//! Readings of the water: loads on bodies, levels.

use std::marker::PhantomData;

use super::Wcsph;
use crate::body::BodyMotion;
use crate::kernel::{Kernel, shape_within};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::GHOST_MARGIN;
use crate::scheme::Load;
use crate::water::first_level;
use crate::with_kernel;

impl Wcsph {
    /// Force on a body and its added mass, from the last [`Wcsph::prepare`].
    pub fn load(&self, body: usize) -> Load {
        let [force, added_mass] = self.work.loads[body];
        Load { force, added_mass }
    }

    /// Σ m ∫ p/ρ² dρ. Tension counts as far as it acts: what the surface does not feel does no work,
    /// as it grows or as it goes.
    pub fn elastic_energy(&self) -> f64 {
        let (fluid, state) = (&self.fluid, &self.options.state);
        let one = |k: usize| {
            let density = fluid.density[k];
            let acting = if density < state.surface_density { self.work.tension[k] } else { 1.0 };
            fluid.mass[k] * state.elastic_energy(density) * acting
        };
        (0..fluid.len()).map(one).sum()
    }

    /// Level of the water at an upright body, metres above the bed.
    pub fn level_at(&self, body: usize) -> f64 {
        self.exchange.level(&self.ghosts, body)
    }

    /// Force on a body by integrating the interpolated pressure over its face, N per metre.
    pub fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        let fluid = self.work.water(&self.records[..self.fluid.padded_len()], false);
        let motion = BodyMotion { offset: self.held_bodies[body].offset, ..*motion };
        self.exchange.face_force(self.pairs.path, &self.ghosts, body, &motion, fluid)
    }

    /// Level of the free surface at x, metres above the bed: upwards from `from`, the first
    /// height at which the kernel's coverage Σ W V falls to 1/2.
    pub fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
        let radius = self.options.support_radius;
        let margin = GHOST_MARGIN * self.options.spacing;
        let factor = self.options.kernel.normalisation() / (radius * radius);
        let near = &mut self.column;
        near.clear();
        let reach = radius + margin;
        self.pairs.sorted().0.visit_box([x - reach, x + reach], [f64::MIN, f64::MAX], |range| {
            for k in range.filter(|&k| (self.fluid.x[k] - x).abs() < radius) {
                let volume = self.fluid.mass[k] / self.fluid.density[k];
                near.push((self.fluid.x[k] - x) / radius, self.fluid.y[k] / radius, volume);
            }
        });
        let near = &*near.blocks;
        let coverage = |y: f64| -> f64 {
            let y = y / radius;
            factor
                * with_kernel!(self.options.kernel, K => {
                    dispatch(self.pairs.path, Coverage { near, y, kernel: PhantomData::<K> })
                })
        };
        first_level(coverage, from, self.options.spacing)
    }
}

/// Room from the start for so many blocks of a column, so that runup needs none.
const COLUMN_ROOM: usize = 128;

/// Particles near an upright line, eight at a time: their distance from it and their height, over
/// R, and their volume.
#[derive(Debug, Clone, Default)]
pub(super) struct Column {
    blocks: Vec<[[f64; LANES]; 3]>,
    len: usize,
}

impl Column {
    fn clear(&mut self) {
        self.blocks.clear();
        self.blocks.reserve(COLUMN_ROOM);
        self.len = 0;
    }

    fn push(&mut self, x: f64, y: f64, volume: f64) {
        let lane = self.len % LANES;
        if lane == 0 {
            self.blocks.push([[0.0; LANES]; 3]);
        }
        if let Some([xs, ys, volumes]) = self.blocks.last_mut() {
            (xs[lane], ys[lane], volumes[lane]) = (x, y, volume);
        }
        self.len += 1;
    }
}

/// Σ w V of a column's particles at a height on its line.
struct Coverage<'a, K> {
    near: &'a [[[f64; LANES]; 3]],
    /// Over R.
    y: f64,
    kernel: PhantomData<K>,
}

impl<K: Kernel> Task for Coverage<'_, K> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut sum = L::splat(0.0);
        for [x, y, volume] in self.near {
            let (x, y) = (L::load(x), L::load(y) - L::splat(self.y));
            let shape = shape_within::<K, L>(x.mul_add(x, y * y));
            sum = shape.mul_add(L::load(volume), sum);
        }
        sum.sum()
    }
}
