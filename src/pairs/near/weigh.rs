//! The geometry of all pairs: their slopes, and the moments of every support.

use std::marker::PhantomData;

use super::part::Part;
use super::{Near, Values};
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::fields::Here;
use crate::pairs::record::Record;
use crate::with_kernel;

/// Smaller squared distances, in support radii, are replaced by this.
const COINCIDENT: f64 = 1e-12;

/// The sums over the support of a particle, with F = -g.
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

struct Weigh<'a, K, R, F> {
    part: &'a mut Part,
    places: [&'a [f64]; 2],
    records: &'a [Record],
    /// How many particles the water has.
    water: usize,
    /// 1/R, 1/m.
    inverse: f64,
    /// Turns w'(q)/q into g over the volume.
    slope: f64,
    /// Turns w(q) into W.
    shape: f64,
    values: R,
    close: &'a F,
    kernel: PhantomData<K>,
}

impl<K: Kernel, R: Values, F: Fn(Moments) -> R::Value> Task for Weigh<'_, K, R, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Weigh { records, inverse, .. } = self;
        let Part { clusters, list, slopes, .. } = self.part;
        let zero = L::splat(0.0);
        let scale = L::splat(inverse * inverse);
        for (place, cluster) in clusters.clone().enumerate() {
            let here = Here::new(cluster, place);
            let [x, y] = here.all::<L, 2>(self.places);
            let mut sums = [zero; 7];
            let range = list.range(place);
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
            for lane in 0..LANES.min(self.water - cluster * LANES) {
                let moments = Moments {
                    coverage: w[lane],
                    weight: -g[lane],
                    sway: [sx[lane], sy[lane]],
                    moment: [-xx[lane], -xy[lane], -yy[lane]],
                };
                self.values.put(place * LANES + lane, (self.close)(moments));
            }
        }
    }
}

impl Near {
    /// Finds the slopes of all pairs, and writes what `close` makes of every particle's moments.
    pub fn weigh<R: Values>(&mut self, values: R, close: impl Fn(Moments) -> R::Value + Sync) {
        let (path, kernel, inverse) = (self.path, self.kernel, 1.0 / self.radius);
        let shape = kernel.normalisation() / (self.radius * self.radius);
        let slope = shape * kernel.slope_factor() / (self.radius * self.radius);
        let Near { team, parts, places: [x, y], records, water, .. } = self;
        let (places, records, water, close) = ([&x[..], &y[..]], &records[..], *water, &close);
        team.share(parts, values, &|part, values| {
            part.slopes.resize(part.list.len(), [0.0; LANES]);
            with_kernel!(kernel, K => {
                let kernel = PhantomData::<K>;
                dispatch(path, Weigh {
                    part, places, records, water, inverse, slope, shape, values, close, kernel,
                });
            });
        });
    }
}
