//! Readings of the water: levels, and the pressure along a face.

use std::ops::Range;

use super::Isph;
use super::images::Points;
use crate::body::BodyMotion;
use crate::kernel::{Kernel, shape_within};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::water::first_level;
use crate::with_kernel;

/// Σ W V over a row of points around a place, and the same with a field.
struct Around<'a, K, F> {
    points: &'a Points,
    row: Range<usize>,
    place: [f64; 2],
    /// 1/R.
    inverse_radius: f64,
    field: &'a F,
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, F: Fn(usize) -> f64> Task for Around<'_, K, F> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [f64; 2] {
        let (points, [x, y], inverse) = (self.points, self.place, self.inverse_radius);
        let (mut coverage, mut mean) = (0.0, 0.0);
        for at in self.row.clone().step_by(LANES) {
            let (mut dx, mut dy, mut volume) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            let end = self.row.end.min(at + LANES);
            for (k, e) in (at..end).enumerate() {
                dx[k] = (points.x[e] - x) * inverse;
                dy[k] = (points.y[e] - y) * inverse;
                volume[k] = points.volume[e];
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

impl Isph {
    /// Σ W V of the water and its images at a place, and the same with a field.
    fn average(&self, place: [f64; 2], field: impl Fn(usize) -> f64) -> [f64; 2] {
        let radius = self.options.support_radius;
        let kernel = self.options.kernel;
        let near = &self.near;
        let [x, y] = place.map(|at| [at - radius, at + radius]);
        let mut sums = [0.0; 2];
        for (strips, first) in [(&near.strips, 0), (&near.image_strips, self.fluid.padded_len())] {
            strips.visit_box(x, y, |row| {
                let sum = with_kernel!(kernel, K => dispatch(self.path, Around::<K, _> {
                    points: &near.points,
                    row: first + row.start..first + row.end,
                    place,
                    inverse_radius: 1.0 / radius,
                    field: &field,
                    kernel: std::marker::PhantomData,
                }));
                sums = [sums[0] + sum[0], sums[1] + sum[1]];
            });
        }
        sums.map(|sum| sum * kernel.normalisation() / (radius * radius))
    }

    /// The first height above `from` at which coverage falls to 1/2 along a line.
    pub(super) fn level_along(&self, line: impl Fn(f64) -> [f64; 2], from: f64) -> f64 {
        first_level(|y| self.average(line(y), |_| 0.0)[0], from, self.options.spacing)
    }

    /// Points of a body's face at r*: along its plane, by height.
    pub(super) fn face_line(&self, body: usize) -> Option<impl Fn(f64) -> [f64; 2] + use<>> {
        let plane = self.ghosts.bodies.get(body)?.plane.moved(self.face_offsets[body]);
        let [nx, ny] = plane.normal;
        (nx != 0.0).then_some(move |y: f64| [plane.point[0] - (y - plane.point[1]) * ny / nx, y])
    }

    /// ∫ p dy over a face, from the mean pressure of the water and its images there.
    pub(super) fn pressure_on(&self, body: usize, motion: &BodyMotion) -> f64 {
        let Some(line) = self.face_line(body) else { return 0.0 };
        let options = &self.options;
        let gravity = options.density * options.gravity;
        let responds =
            if self.responded && body == self.responds { motion.acceleration } else { 0.0 };
        let step = 0.5 * options.spacing;
        let top = self.level_along(&line, 0.0);
        let cells = (top / step).ceil().max(1.0);
        let height = top / cells;
        let mut force = 0.0;
        for cell in 0..cells as usize {
            let place = line((cell as f64 + 0.5) * height);
            let [coverage, mean] = self.average(place, |k| {
                let j = self.near.points.original[k] as usize;
                let response = self.carried.response.get(j).copied().unwrap_or(0.0);
                self.pressure[j]
                    + self.near.points.walls[k].pressure
                    + responds * (response + self.near.points.walls[k].pressure_response)
            });
            let dynamic = mean / coverage.max(1e-3);
            let pressure = dynamic + gravity * (options.still_level - place[1]);
            force += pressure.max(0.0) * height;
        }
        force
    }
}
