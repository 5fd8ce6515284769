//! The pair pass: the weights of all pairs and every sum over neighbours that does not need the pressure.

use super::Isph;
use super::lists::{Near, Numbers, load};
use super::state::Operators;
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::PairList;
use crate::with_kernel;

/// The correction of gradients fades from the moment's inverse, above this eigenvalue, ...
const CORRECT_FULL: f64 = 0.30;
/// ... to the identity, below this one.
const CORRECT_FROM: f64 = 0.20;

struct Gather<'a, K> {
    pairs: &'a PairList,
    numbers: &'a [Numbers],
    /// Places of the particles, padded.
    places: [&'a [f64]; 2],
    weights: &'a mut [[f64; LANES]],
    operators: &'a mut Operators,
    count: usize,
    inverse_radius: f64,
    /// Turns w'(q)/q into F over the volume.
    weight: f64,
    /// Turns w(q) into W.
    shape: f64,
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel> Task for Gather<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Gather { pairs, numbers, weights, operators, .. } = self;
        let zero = L::splat(0.0);
        let scale = L::splat(self.inverse_radius * self.inverse_radius);
        for cluster in 0..pairs.clusters() {
            let [x, y] = [load::<L>(self.places[0], cluster), load(self.places[1], cluster)];
            let mut sums = [zero; 7];
            let range = pairs.range(cluster);
            let near = &pairs.entries()[range.clone()];
            for (&e, weights) in near.iter().zip(&mut weights[range]) {
                let at = &numbers[e as usize];
                let (dx, dy) = (L::splat(at.place[0]) - x, L::splat(at.place[1]) - y);
                let s = (dx.mul_add(dx, dy * dy) * scale).max(L::splat(1e-12));
                let roots = s.roots();
                let reach = s.select_less(L::splat(1.0), L::splat(at.volume), zero);
                let f = K::slope_over_q(s, roots) * reach * L::splat(self.weight);
                let w = K::shape(s, roots[1]) * reach * L::splat(self.shape);
                let (fx, fy) = (f * dx, f * dy);
                f.store(weights);
                sums[0] += w;
                sums[1] += f;
                sums[2] += fx;
                sums[3] += fy;
                sums[4] = fx.mul_add(dx, sums[4]);
                sums[5] = fx.mul_add(dy, sums[5]);
                sums[6] = fy.mul_add(dy, sums[6]);
            }
            let [w, f, sx, sy, xx, xy, yy] = L::to_arrays(sums);
            for lane in 0..LANES.min(self.count - cluster * LANES) {
                let i = cluster * LANES + lane;
                operators.coverage[i] = w[lane];
                operators.weight[i] = f[lane];
                operators.sway[i] = [sx[lane], sy[lane]];
                let moment = [xx[lane], xy[lane], yy[lane]];
                operators.moment[i] = moment;
                (operators.correction[i], operators.completeness[i]) = invert(moment);
            }
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
        operators.coverage.resize(n, 0.0);
        operators.weight.resize(n, 0.0);
        operators.completeness.resize(n, 0.0);
        operators.sway.resize(n, [0.0; 2]);
        operators.moment.resize(n, [0.0; 3]);
        operators.correction.resize(n, [0.0; 3]);
        operators.grip.clear();
        operators.grip.resize(n, 0.0);
        let Near { points, pairs, weights, .. } = &mut self.near;
        weights.resize(pairs.len(), [0.0; LANES]);
        let (kernel, radius) = (self.options.kernel, self.options.support_radius);
        let per_volume = kernel.normalisation() / (radius * radius);
        with_kernel!(kernel, K => dispatch(self.path, Gather::<K> {
            pairs,
            numbers: &self.numbers,
            places: [&points.x, &points.y],
            weights,
            operators,
            count: n,
            inverse_radius: 1.0 / radius,
            weight: -per_volume * kernel.slope_factor() / (radius * radius),
            shape: per_volume,
            kernel: std::marker::PhantomData,
        }));
        self.pending.pair_evaluations += (LANES * pairs.len()) as u64;
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
