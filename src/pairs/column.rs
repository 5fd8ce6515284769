//! The water near an upright line.

use std::marker::PhantomData;

use crate::kernel::{Kernel, KernelChoice, shape_within};
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::with_kernel;

/// Memory reserved for this many blocks, so that runup needs none.
const ROOM: usize = 128;

/// Particles near an upright line, eight at a time: their distance from it and their height, over
/// R, and their volume.
#[derive(Debug, Clone, Default)]
pub struct Column {
    blocks: Vec<[[f64; LANES]; 3]>,
    len: usize,
}

impl Column {
    /// Forgets all particles.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.blocks.reserve(ROOM);
        self.len = 0;
    }

    /// Adds a particle: its distance from the line and its height, over R, and its volume, m².
    pub fn push(&mut self, x: f64, y: f64, volume: f64) {
        let lane = self.len % LANES;
        if lane == 0 {
            self.blocks.push([[0.0; LANES]; 3]);
        }
        if let Some([xs, ys, volumes]) = self.blocks.last_mut() {
            (xs[lane], ys[lane], volumes[lane]) = (x, y, volume);
        }
        self.len += 1;
    }

    /// Σ w V at a height on the line, over R.
    pub fn coverage(&self, path: SimdPath, kernel: KernelChoice, y: f64) -> f64 {
        let near = &*self.blocks;
        with_kernel!(kernel, K => dispatch(path, Coverage { near, y, kernel: PhantomData::<K> }))
    }
}

struct Coverage<'a, K> {
    near: &'a [[[f64; LANES]; 3]],
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
