//! The pair pass: neighbour lists and every sum over neighbours that does not need the pressure.

use super::Isph;
use super::grid::Grid;
use super::images::Points;
use super::state::{Neighbour, Operators};
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::with_kernel;

/// The correction of gradients fades from the moment's inverse, above this eigenvalue, ...
const CORRECT_FULL: f64 = 0.30;
/// ... to the identity, below this one.
const CORRECT_FROM: f64 = 0.20;

struct Gather<'a, K> {
    points: &'a Points,
    grid: &'a Grid,
    places: &'a [super::images::Point],
    starts: &'a mut Vec<u32>,
    list: &'a mut Vec<Neighbour>,
    near: &'a mut Vec<u32>,
    pull: [&'a mut Vec<f64>; 2],
    operators: &'a mut Operators,
    inverse_radius: f64,
    /// Turns w'(q)/q into F over the volume.
    weight: f64,
    /// Turns w(q) into W.
    shape: f64,
    kernel: std::marker::PhantomData<K>,
}

/// Eight values of a field.
#[inline(always)]
fn lanes<L: Lanes>(field: &[f64], at: usize) -> L {
    L::load(field[at..at + LANES].first_chunk().unwrap())
}

impl<K: Kernel> Task for Gather<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Gather { points, operators, list, starts, near, pull, .. } = self;
        let [pull_x, pull_y] = pull;
        let lane = L::load(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        let mut end = 0;
        let zero = L::splat(0.0);
        for (i, point) in self.places.iter().enumerate() {
            let [px, py] = point.place;
            let (x, y) = (L::splat(px), L::splat(py));
            let mut sums = [zero; 7];
            for range in self.grid.near(point.place) {
                if list.len() < end + range.len() + LANES {
                    let length = 2 * list.len() + range.len() + LANES;
                    list.resize(length, Neighbour::default());
                    near.resize(length, 0);
                    pull_x.resize(length, 0.0);
                    pull_y.resize(length, 0.0);
                }
                let mut at = range.start;
                while at < range.end {
                    let dx = lanes::<L>(&points.x, at) - x;
                    let dy = lanes::<L>(&points.y, at) - y;
                    let scale = L::splat(self.inverse_radius * self.inverse_radius);
                    let s = dx.mul_add(dx, dy * dy) * scale;
                    let s = s.max(L::splat(1e-12));
                    let roots = s.roots();
                    let here = L::splat((range.end - at) as f64);
                    let volume = lane.select_less(here, lanes::<L>(&points.volume, at), zero);
                    let reach = s.select_less(L::splat(1.0), volume, zero);
                    let f = K::slope_over_q(s, roots) * reach * L::splat(self.weight);
                    let w = K::shape(s, roots[1]) * reach * L::splat(self.shape);
                    let (fx, fy) = (f * dx, f * dy);
                    sums[0] += w;
                    sums[1] += f;
                    sums[2] += fx;
                    sums[3] += fy;
                    sums[4] = fx.mul_add(dx, sums[4]);
                    sums[5] = fx.mul_add(dy, sums[5]);
                    sums[6] = fy.mul_add(dy, sums[6]);
                    // Every lane is written, only those in reach are kept.
                    let weights = f.to_array();
                    let (pulls_x, pulls_y) = (fx.to_array(), fy.to_array());
                    for (k, &weight) in weights.iter().enumerate() {
                        near[end] = (at + k) as u32;
                        pull_x[end] = pulls_x[k];
                        pull_y[end] = pulls_y[k];
                        list[end] = Neighbour { point: (at + k) as u32, weight };
                        end += usize::from(weight > 0.0);
                    }
                    at += LANES;
                }
            }
            starts.push(end as u32);
            let mut totals = [0.0; 7];
            for k in 0..7 {
                totals[k] = sums[k].sum();
            }
            let [w, f, sx, sy, xx, xy, yy] = totals;
            operators.coverage[i] = w;
            operators.weight[i] = f;
            operators.sway[i] = [sx, sy];
            operators.moment[i] = [xx, xy, yy];
            let (correction, completeness) = invert([xx, xy, yy]);
            operators.correction[i] = correction;
            operators.completeness[i] = completeness;
        }
    }
}

/// The inverse of a moment, faded to the identity, and the moment's smallest eigenvalue.
fn invert([xx, xy, yy]: [f64; 3]) -> ([f64; 3], f64) {
    let mean = 0.5 * (xx + yy);
    let spread = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let smallest = mean - spread;
    let keep = ((smallest - CORRECT_FROM) / (CORRECT_FULL - CORRECT_FROM)).clamp(0.0, 1.0);
    if keep == 0.0 {
        return ([1.0, 0.0, 1.0], smallest);
    }
    let scale = keep / (xx * yy - xy * xy);
    ([yy * scale + 1.0 - keep, -xy * scale, xx * scale + 1.0 - keep], smallest)
}

impl Isph {
    pub(super) fn gather(&mut self) {
        let n = self.fluid.len();
        let operators = &mut self.operators;
        for field in [
            &mut operators.coverage,
            &mut operators.weight,
            &mut operators.completeness,
            &mut operators.grip,
        ] {
            field.clear();
            field.resize(n, 0.0);
        }
        operators.sway.resize(n, [0.0; 2]);
        operators.moment.resize(n, [0.0; 3]);
        operators.correction.resize(n, [0.0; 3]);
        self.list_starts.clear();
        self.list_starts.push(0);
        let radius = self.options.support_radius;
        let kernel = self.options.kernel;
        let per_volume = kernel.normalisation() / (radius * radius);
        with_kernel!(kernel, K => dispatch(self.path, Gather::<K> {
            points: &self.points,
            grid: &self.grid,
            places: &self.loose[..n],
            starts: &mut self.list_starts,
            list: &mut self.list,
            near: &mut self.near,
            pull: [&mut self.pull_x, &mut self.pull_y],
            operators,
            inverse_radius: 1.0 / radius,
            weight: -per_volume * kernel.slope_factor() / (radius * radius),
            shape: per_volume,
            kernel: std::marker::PhantomData,
        }));
        self.pending.pair_evaluations += u64::from(*self.list_starts.last().unwrap_or(&0));
    }

    /// Neighbours of a particle, itself among them.
    #[inline(always)]
    pub(super) fn neighbours(&self, i: usize) -> &[Neighbour] {
        &self.list[self.list_starts[i] as usize..self.list_starts[i + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_moment_is_inverted_and_a_poor_one_left_alone() {
        let ([xx, xy, yy], least) = invert([1.1, 0.2, 0.7]);
        assert!((xx * 1.1 + xy * 0.2 - 1.0).abs() < 1e-12 && (xx * 0.2 + xy * 0.7).abs() < 1e-12);
        assert!((xy * 0.2 + yy * 0.7 - 1.0).abs() < 1e-12 && least > 0.5);
        assert_eq!(invert([1.0, 0.0, 0.1]).0, [1.0, 0.0, 1.0]);
    }
}
