//! Pair loops of the exchange: weights at targets, and weighted means of the water there.

use std::ops::Range;

use super::Interpolator;
use super::ghosts::Ghosts;
use super::weighing::{Stencil, Weighing, weighted};
use crate::body::BodyMotion;
use crate::kernel::{Kernel, KernelChoice};
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::{HeldWeights, PairList, Record, Scaling};

/// Weighted means of the water at one vector of targets.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Means {
    pub pressure: [f64; LANES],
    pub x: [f64; LANES],
    pub y: [f64; LANES],
    pub vx: [f64; LANES],
    pub vy: [f64; LANES],
    /// Along x and up, m/s²; zero where ghosts do not need it.
    pub acceleration: [[f64; LANES]; 2],
    /// Of the kernel gradient's correction: xx, xy, yy.
    pub correction: [[f64; LANES]; 3],
}

/// The data of the fluid that the exchange reads.
#[derive(Debug, Clone, Copy)]
pub struct Water<'a> {
    /// Places, velocities and weights, padding included.
    pub records: &'a [Record],
    /// Pressures, Pa.
    pub pressure: &'a [f64],
    /// Corrections of the kernel gradient (xx, xy, yy), where the scheme has them.
    pub correction: Option<[&'a [f64]; 3]>,
    /// Accelerations of the step before, along x and up, m/s².
    pub acceleration: [&'a [f64]; 2],
}

/// Some blocks of targets with their surroundings.
#[derive(Clone)]
pub(super) struct Targets<'a> {
    pub kernel: KernelChoice,
    pub scaling: Scaling,
    pub ghosts: &'a Ghosts,
    pub bodies: &'a [BodyMotion],
    pub water: Water<'a>,
    pub list: &'a PairList,
    /// The block that the list begins with.
    pub first: usize,
    pub blocks: Range<usize>,
    /// Whether targets are the ghosts themselves, not their mirror points.
    pub at_ghost: bool,
    /// Whether the mean of the water's acceleration is also needed.
    pub falling: bool,
}

impl<'a> Targets<'a> {
    /// The targets of a block, over R.
    #[inline(always)]
    fn places<L: Lanes>(&self, block: usize) -> [L; 2] {
        let ghosts = self.ghosts;
        let (xs, ys) = if self.at_ghost && block < ghosts.len() / LANES {
            (&ghosts.x, &ghosts.y)
        } else {
            (&ghosts.target_x, &ghosts.target_y)
        };
        let offset = self.bodies[ghosts.target_body[block] as usize].offset;
        let inverse = L::splat(self.scaling.inverse_radius);
        let x = (L::load(&xs.as_chunks::<LANES>().0[block]) + L::splat(offset)) * inverse;
        [x, L::load(&ys.as_chunks::<LANES>().0[block]) * inverse]
    }

    /// The targets of a block and such neighbours.
    #[inline(always)]
    pub fn stencil<'b, L: Lanes>(&self, block: usize, neighbours: &'b [u32]) -> Stencil<'b, L>
    where
        'a: 'b,
    {
        let [x, y] = self.places(block);
        Stencil { x, y, neighbours, records: self.water.records, kernel: self.kernel }
    }
}

/// Finds the listed particles that are in reach of targets.
pub(super) struct Near<'a> {
    pub targets: Targets<'a>,
    pub held: &'a mut HeldWeights,
}

impl Task for Near<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Near { targets, held } = self;
        if targets.blocks.is_empty() {
            return;
        }
        let Targets { first, list, water, .. } = targets;
        let mut end = held.end_before(targets.blocks.start - first);
        for block in targets.blocks.clone() {
            let (row, places) = (block - first, targets.places::<L>(block));
            end = held.take(row, list.group(row, 0), places, water.records, end);
        }
    }
}

/// Kernel weights of the water at targets.
pub(super) struct KernelWeights<'a, K> {
    pub targets: Targets<'a>,
    pub held: &'a mut HeldWeights,
    pub kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel> Task for KernelWeights<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for block in self.targets.blocks.clone() {
            let (neighbours, weights) = self.held.room(block - self.targets.first);
            self.targets.stencil::<L>(block, neighbours).kernel_weights::<K>(weights);
        }
    }
}

/// Weights and means at targets. Rows and held weights begin with the list.
pub(super) struct Weigh<'a, I> {
    pub interpolator: I,
    pub targets: Targets<'a>,
    pub held: &'a mut HeldWeights,
    pub scale: &'a mut [[f64; LANES]],
    pub fallen: &'a mut [[f64; LANES]],
    pub means: &'a mut [Means],
}

impl<I: Interpolator> Task for Weigh<'_, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Targets { water, scaling, first, falling, .. } = self.targets;
        for block in self.targets.blocks.clone() {
            let row = block - first;
            let (neighbours, weights) = self.held.room(row);
            if neighbours.is_empty() {
                self.scale[row] = [0.0; LANES];
                continue;
            }
            let stencil = self.targets.stencil::<L>(block, neighbours);
            let Weighing { scale, fallback } = self.interpolator.weigh::<L>(&stencil, weights);
            scale.store(&mut self.scale[row]);
            if I::SIGNED {
                fallback.store(&mut self.fallen[row]);
            }
            let held = self.held.of(row);
            self.means[row] = gather::<L, I>(held, water, scale, scaling);
            if falling {
                let mean = |all| (weighted::<L>(held, all) * scale).to_array();
                self.means[row].acceleration = water.acceleration.map(mean);
            }
        }
    }
}

/// Σ W V of the water at face points. Coverage begins with the first point of the part.
pub(super) struct Cover<'a, K> {
    pub targets: Targets<'a>,
    pub coverage: &'a mut [f64],
    pub kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel> Task for Cover<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Targets { first, list, water, scaling, .. } = self.targets;
        let (coverage, _) = self.coverage.as_chunks_mut::<LANES>();
        for block in self.targets.blocks.clone() {
            let [x, y] = self.targets.places::<L>(block);
            let mut sum = L::splat(0.0);
            for &j in list.group(block - first, 0) {
                let record = &water.records[j as usize].0;
                let dx = x - L::splat(record[Record::X]);
                let dy = y - L::splat(record[Record::Y]);
                let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                sum = K::shape(s, s.rsqrt()).mul_add(L::splat(record[Record::WEIGHT]), sum);
            }
            (sum * L::splat(scaling.shape_per_weight)).store(&mut coverage[block - first]);
        }
    }
}

#[inline(always)]
fn gather<L: Lanes, I: Interpolator>(
    (neighbours, weights): (&[u32], &[[f64; LANES]]),
    water: Water<'_>,
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
        let mut nearest = zero;
        for (&j, weight) in neighbours.iter().zip(weights) {
            let mut weight = L::load(weight);
            if !I::PEAKED {
                // Under the surface corrections differ from row to row. So that of the nearest
                // water counts. A mean over the support would push where the water's own correction
                // does not. Only positive shares count, so that the result stays between the
                // water's corrections.
                let share = weight.max(zero) * scale;
                let square = share * share;
                weight = square * square;
                weight = weight * weight;
                nearest += weight;
            }
            xx = weight.mul_add(L::splat(all_xx[j as usize]), xx);
            xy = weight.mul_add(L::splat(all_xy[j as usize]), xy);
            yy = weight.mul_add(L::splat(all_yy[j as usize]), yy);
        }
        let scale = if I::PEAKED { scale } else { Weighing::of_sum(nearest, zero).scale };
        correction = [(xx * scale).to_array(), (xy * scale).to_array(), (yy * scale).to_array()];
    }
    let to_metres = scale * L::splat(scaling.support_radius);
    Means {
        pressure: (pressure * scale).to_array(),
        x: (x * to_metres).to_array(),
        y: (y * to_metres).to_array(),
        vx: (vx * scale).to_array(),
        vy: (vy * scale).to_array(),
        acceleration: Default::default(),
        correction,
    }
}
