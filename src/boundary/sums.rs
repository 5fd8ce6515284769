//! Pair loops of the exchange: weights at targets, and weighted means of the water there.

use super::Interpolator;
use super::ghosts::Ghosts;
use crate::body::BodyMotion;
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::{Record, Scaling};

/// Weighted means of the water at one vector of targets.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Means {
    pub pressure: [f64; LANES],
    pub x: [f64; LANES],
    pub y: [f64; LANES],
    pub vx: [f64; LANES],
    pub vy: [f64; LANES],
    /// Of the kernel gradient's correction: xx, xy, yy.
    pub correction: [[f64; LANES]; 3],
}

/// What the exchange reads of the fluid.
#[derive(Debug, Clone, Copy)]
pub struct Water<'a> {
    /// Places, velocities and weights, padding included.
    pub records: &'a [Record],
    /// Pressures, Pa.
    pub pressure: &'a [f64],
    /// Corrections of the kernel gradient (xx, xy, yy), where the scheme has them.
    pub correction: Option<[&'a [f64]; 3]>,
}

pub(super) struct Weigh<'a, K, I> {
    pub interpolator: I,
    pub scaling: Scaling,
    pub ghosts: &'a Ghosts,
    pub bodies: &'a [BodyMotion],
    pub water: Water<'a>,
    pub list: &'a PairList,
    pub weights: &'a mut [[f64; LANES]],
    pub scale: &'a mut [[f64; LANES]],
    pub means: &'a mut [Means],
    pub coverage: &'a mut [f64],
    pub kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, I: Interpolator> Task for Weigh<'_, K, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (xs, _) = self.ghosts.target_x.as_chunks::<LANES>();
        let (ys, _) = self.ghosts.target_y.as_chunks::<LANES>();
        let (coverage, _) = self.coverage.as_chunks_mut::<LANES>();
        let ghost_blocks = self.ghosts.len() / LANES;
        let inverse = L::splat(self.scaling.inverse_radius);
        for block in 0..xs.len() {
            let offset = self.bodies[self.ghosts.target_body[block] as usize].offset;
            let x = (L::load(&xs[block]) + L::splat(offset)) * inverse;
            let y = L::load(&ys[block]) * inverse;
            let neighbours = self.list.group(block, 0);
            if block < ghost_blocks {
                let start = self.list.start(block, 0);
                let weights = &mut self.weights[start..start + neighbours.len()];
                let scale =
                    self.interpolator.weigh::<K, L>(x, y, neighbours, self.water.records, weights);
                scale.store(&mut self.scale[block]);
                self.means[block] =
                    gather::<L>(neighbours, self.water, weights, scale, self.scaling);
            } else {
                let mut sum = L::splat(0.0);
                for &j in neighbours {
                    let record = &self.water.records[j as usize].0;
                    let dx = x - L::splat(record[Record::X]);
                    let dy = y - L::splat(record[Record::Y]);
                    let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                    sum = K::shape(s, s.rsqrt()).mul_add(L::splat(record[Record::WEIGHT]), sum);
                }
                (sum * L::splat(self.scaling.shape_per_weight)).store(&mut coverage[block]);
            }
        }
    }
}

pub(super) struct Interpolate<'a, K, I> {
    pub interpolator: I,
    pub scaling: Scaling,
    pub ghosts: &'a Ghosts,
    pub offset: f64,
    pub water: Water<'a>,
    pub list: &'a PairList,
    pub weights: &'a mut [[f64; LANES]],
    pub scale: &'a mut [[f64; LANES]],
    pub means: &'a mut [Means],
    pub blocks: std::ops::Range<usize>,
    pub kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, I: Interpolator> Task for Interpolate<'_, K, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (xs, _) = self.ghosts.target_x.as_chunks::<LANES>();
        let (ys, _) = self.ghosts.target_y.as_chunks::<LANES>();
        let inverse = L::splat(self.scaling.inverse_radius);
        for block in self.blocks {
            let x = (L::load(&xs[block]) + L::splat(self.offset)) * inverse;
            let y = L::load(&ys[block]) * inverse;
            let neighbours = self.list.group(block, 0);
            let start = self.list.start(block, 0);
            let weights = &mut self.weights[start..start + neighbours.len()];
            let scale =
                self.interpolator.weigh::<K, L>(x, y, neighbours, self.water.records, weights);
            scale.store(&mut self.scale[block]);
            self.means[block] = gather::<L>(neighbours, self.water, weights, scale, self.scaling);
        }
    }
}

#[inline(always)]
fn gather<L: Lanes>(
    neighbours: &[u32],
    water: Water<'_>,
    weights: &[[f64; LANES]],
    scale: L,
    scaling: Scaling,
) -> Means {
    let zero = L::splat(0.0);
    let (mut pressure, mut x, mut y, mut vx, mut vy) = (zero, zero, zero, zero, zero);
    for (&j, weight) in neighbours.iter().zip(weights) {
        let record = &water.records[j as usize].0;
        let weight = L::load(weight);
        pressure = weight.mul_add(L::splat(water.pressure[j as usize]), pressure);
        x = weight.mul_add(L::splat(record[Record::X]), x);
        y = weight.mul_add(L::splat(record[Record::Y]), y);
        vx = weight.mul_add(L::splat(record[Record::VX]), vx);
        vy = weight.mul_add(L::splat(record[Record::VY]), vy);
    }
    let mut correction = [[1.0; LANES], [0.0; LANES], [1.0; LANES]];
    if let Some([all_xx, all_xy, all_yy]) = water.correction {
        let (mut xx, mut xy, mut yy) = (zero, zero, zero);
        for (&j, weight) in neighbours.iter().zip(weights) {
            let weight = L::load(weight);
            xx = weight.mul_add(L::splat(all_xx[j as usize]), xx);
            xy = weight.mul_add(L::splat(all_xy[j as usize]), xy);
            yy = weight.mul_add(L::splat(all_yy[j as usize]), yy);
        }
        correction = [(xx * scale).to_array(), (xy * scale).to_array(), (yy * scale).to_array()];
    }
    let to_metres = scale * L::splat(scaling.support_radius);
    Means {
        pressure: (pressure * scale).to_array(),
        x: (x * to_metres).to_array(),
        y: (y * to_metres).to_array(),
        vx: (vx * scale).to_array(),
        vy: (vy * scale).to_array(),
        correction,
    }
}

pub(super) struct GatherVelocity<'a> {
    pub list: &'a PairList,
    pub weights: &'a [[f64; LANES]],
    pub scale: &'a [[f64; LANES]],
    pub means: &'a mut [Means],
    pub blocks: usize,
    pub records: &'a [Record],
}

impl Task for GatherVelocity<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for block in 0..self.blocks {
            let neighbours = self.list.group(block, 0);
            let start = self.list.start(block, 0);
            let (mut vx, mut vy) = (L::splat(0.0), L::splat(0.0));
            for (&j, weight) in neighbours.iter().zip(&self.weights[start..]) {
                let record = &self.records[j as usize].0;
                let weight = L::load(weight);
                vx = weight.mul_add(L::splat(record[Record::VX]), vx);
                vy = weight.mul_add(L::splat(record[Record::VY]), vy);
            }
            let scale = L::load(&self.scale[block]);
            (vx * scale).store(&mut self.means[block].vx);
            (vy * scale).store(&mut self.means[block].vy);
        }
    }
}
