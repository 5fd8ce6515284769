//! Averages over the water and its images, anywhere.

use std::marker::PhantomData;
use std::ops::Range;

use super::Near;
use crate::kernel::{Kernel, shape_within};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::with_kernel;

/// Σ w V over a row of points around a place, and the same with a field.
struct Around<'a, K, F> {
    near: &'a Near,
    row: Range<usize>,
    place: [f64; 2],
    field: &'a F,
    kernel: PhantomData<K>,
}

impl<K: Kernel, F: Fn(usize) -> f64> Task for Around<'_, K, F> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [f64; 2] {
        let Near { places: [xs, ys], volume: volumes, radius, .. } = self.near;
        let ([x, y], inverse) = (self.place, 1.0 / radius);
        let (mut coverage, mut mean) = (0.0, 0.0);
        for at in self.row.clone().step_by(LANES) {
            let (mut dx, mut dy, mut volume) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            let end = self.row.end.min(at + LANES);
            for (k, e) in (at..end).enumerate() {
                dx[k] = (xs[e] - x) * inverse;
                dy[k] = (ys[e] - y) * inverse;
                volume[k] = volumes[e];
            }
            let (dx, dy) = (L::load(&dx), L::load(&dy));
            let shape = shape_within::<K, L>(dx.mul_add(dx, dy * dy));
            let weights = (shape * L::load(&volume)).to_array();
            for (weight, e) in weights.into_iter().zip(at..end) {
                coverage += weight;
                if weight > 0.0 {
                    mean += weight * (self.field)(e);
                }
            }
        }
        [coverage, mean]
    }
}

impl Near {
    /// Σ W V of the water and its images at a place, and the same with a field of the points.
    pub fn average(&self, place: [f64; 2], field: impl Fn(usize) -> f64) -> [f64; 2] {
        let Near { kernel, radius, .. } = *self;
        let [x, y] = place.map(|at| [at - radius, at + radius]);
        let padded = self.water.next_multiple_of(LANES);
        let mut sums = [0.0; 2];
        for (strips, first) in [(&self.strips, 0), (&self.image_strips, padded)] {
            strips.visit_box(x, y, |row| {
                let (row, field) = (first + row.start..first + row.end, &field);
                let sum = with_kernel!(kernel, K => {
                    dispatch(self.path, Around { near: self, row, place, field, kernel: PhantomData::<K> })
                });
                sums = [sums[0] + sum[0], sums[1] + sum[1]];
            });
        }
        sums.map(|sum| sum * kernel.normalisation() / (radius * radius))
    }
}
