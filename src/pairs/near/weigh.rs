//! The geometry of all pairs: their slopes, and the moments of every support.

use std::marker::PhantomData;

use super::Near;
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::fields::Here;
use crate::pairs::record::Record;
use crate::with_kernel;

/// Squares of distances below this, in support radii, count as this.
const COINCIDENT: f64 = 1e-12;

/// What the support of a particle comes to, F being -g.
#[derive(Debug, Clone, Copy)]
pub struct Moments {
    /// Σ V W, itself included.
    pub coverage: f64,
    /// Σ F, 1/m².
    pub weight: f64,
    /// Σ F (r_j - r_i), 1/m.
    pub sway: [f64; 2],
    /// Σ F ΔΔᵀ: xx, xy, yy.
    pub moment: [f64; 3],
}

struct Weigh<'a, K, F> {
    near: &'a mut Near,
    /// Turns w'(q)/q into g over the volume.
    slope: f64,
    /// Turns w(q) into W.
    shape: f64,
    close: F,
    kernel: PhantomData<K>,
}

impl<K: Kernel, F: FnMut(usize, Moments)> Task for Weigh<'_, K, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Near { list, slopes, places: [all_x, all_y], records, radius, water, .. } = self.near;
        let (zero, inverse) = (L::splat(0.0), 1.0 / *radius);
        let scale = L::splat(inverse * inverse);
        for cluster in 0..list.clusters() {
            let here = Here::new(cluster, cluster);
            let [x, y] = here.all::<L, 2>([all_x, all_y]);
            let mut sums = [zero; 7];
            let range = list.range(cluster);
            for (&e, slope) in list.entries()[range.clone()].iter().zip(&mut slopes[range]) {
                let at = &records[e as usize].0;
                let (dx, dy) = (x - L::splat(at[Record::X]), y - L::splat(at[Record::Y]));
                let s = (dx.mul_add(dx, dy * dy) * scale).max(L::splat(COINCIDENT));
                let roots = s.roots();
                let reach = s.select_less(L::splat(1.0), L::splat(at[Record::WEIGHT]), zero);
                let g = K::slope_over_q(s, roots) * reach * L::splat(self.slope);
                let w = K::shape(s, roots[1]) * reach * L::splat(self.shape);
                let (gx, gy) = (g * dx, g * dy);
                g.store(slope);
                sums[0] += w;
                sums[1] += g;
                sums[2] += gx;
                sums[3] += gy;
                sums[4] = gx.mul_add(dx, sums[4]);
                sums[5] = gx.mul_add(dy, sums[5]);
                sums[6] = gy.mul_add(dy, sums[6]);
            }
            let [w, g, sx, sy, xx, xy, yy] = L::to_arrays(sums);
            for lane in 0..LANES.min(*water - cluster * LANES) {
                let moments = Moments {
                    coverage: w[lane],
                    weight: -g[lane],
                    sway: [sx[lane], sy[lane]],
                    moment: [-xx[lane], -xy[lane], -yy[lane]],
                };
                (self.close)(cluster * LANES + lane, moments);
            }
        }
    }
}

impl Near {
    /// Finds the slopes of all pairs, and hands every particle's moments to `close`.
    pub fn weigh(&mut self, close: impl FnMut(usize, Moments)) {
        let (path, kernel, radius) = (self.path, self.kernel, self.radius);
        self.slopes.resize(self.list.len(), [0.0; LANES]);
        let shape = kernel.normalisation() / (radius * radius);
        let slope = shape * kernel.slope_factor() / (radius * radius);
        with_kernel!(kernel, K => {
            dispatch(path, Weigh { near: self, slope, shape, close, kernel: PhantomData::<K> })
        });
    }
}
