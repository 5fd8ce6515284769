//! Readings of the water: levels, and the pressure along a face.

use super::Isph;
use super::images::Points;
use crate::body::BodyMotion;
use crate::kernel::{Kernel, shape_within};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::neighbours::Strips;
use crate::with_kernel;

/// W V of points around a place.
struct Around<'a, K> {
    points: &'a Points,
    strips: [&'a Strips; 2],
    /// Number of each set's first point.
    first: [usize; 2],
    place: [f64; 2],
    radius: f64,
    /// Turns w(q) into W.
    factor: f64,
    /// Takes points, eight at a time, and their W V.
    take: &'a mut dyn FnMut(usize, [f64; LANES]),
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel> Task for Around<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Around { points, place: [x, y], radius, take, .. } = self;
        let inverse = 1.0 / radius;
        let mut eight = |at: usize, end: usize| {
            let mut numbers = [[0.0; LANES]; 3];
            for (k, e) in (at..end.min(at + LANES)).enumerate() {
                numbers[0][k] = (points.x[e] - x) * inverse;
                numbers[1][k] = (points.y[e] - y) * inverse;
                numbers[2][k] = points.volume[e];
            }
            let [dx, dy, volume] = numbers.map(|numbers| L::load(&numbers));
            let shape = shape_within::<K, L>(dx.mul_add(dx, dy * dy));
            take(at, (shape * volume * L::splat(self.factor)).to_array());
        };
        for (strips, first) in self.strips.into_iter().zip(self.first) {
            strips.visit_box([x - radius, x + radius], [y - radius, y + radius], |range| {
                for at in (first + range.start..first + range.end).step_by(LANES) {
                    eight(at, first + range.end);
                }
            });
        }
    }
}

impl Isph {
    /// Σ W V of the water and its images at a place, and the weighted mean of a field there.
    fn average(&self, place: [f64; 2], field: impl Fn(usize) -> f64) -> [f64; 2] {
        let radius = self.options.support_radius;
        let kernel = self.options.kernel;
        let (mut coverage, mut mean) = (0.0, 0.0);
        let mut take = |at: usize, weights: [f64; LANES]| {
            for (k, weight) in weights.into_iter().enumerate() {
                coverage += weight;
                if weight > 0.0 {
                    mean += weight * field(at + k);
                }
            }
        };
        with_kernel!(kernel, K => dispatch(self.path, Around::<K> {
            points: &self.points,
            strips: [&self.strips, &self.image_strips],
            first: [0, self.fluid.padded_len()],
            place,
            radius,
            factor: kernel.normalisation() / (radius * radius),
            take: &mut take,
            kernel: std::marker::PhantomData,
        }));
        [coverage, mean]
    }

    /// The first height above `from` at which coverage falls to 1/2 along a line.
    pub(super) fn level_along(&self, line: impl Fn(f64) -> [f64; 2], from: f64) -> f64 {
        let coverage = |y: f64| self.average(line(y), |_| 0.0)[0];
        let step = 0.5 * self.options.spacing;
        let (mut y, mut below) = (from, coverage(from));
        if below < 0.5 {
            return from;
        }
        loop {
            let above = coverage(y + step);
            if above < 0.5 {
                return y + step * (below - 0.5) / (below - above);
            }
            (y, below) = (y + step, above);
        }
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
                let j = self.points.original[k] as usize;
                let response = self.carried.response.get(j).copied().unwrap_or(0.0);
                self.pressure[j]
                    + self.points.walls[k].pressure
                    + responds * (response + self.points.walls[k].pressure_response)
            });
            let dynamic = mean / coverage.max(1e-3);
            let pressure = dynamic + gravity * (options.still_level - place[1]);
            force += pressure.max(0.0) * height;
        }
        force
    }
}
