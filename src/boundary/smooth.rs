//! A bed that gives back, at the edge of the water.
//!
//! A smooth face pushes only along its normal. But at the edge of the water, as at the tip of a
//! tongue on a beach, a ghost also pushes the water along the face (t). The push is -p_g S_g:
//!
//! ```text
//! S_g = t t·V_g (Σ_i V_i L_g ∇W_ig + Σ_g' V_g' ∇W_g'g)
//! ```
//! As the tongue runs up, it covers ghosts ahead of it. This counts as a flow of water into them,
//! S_g·u per second. The tongue gives it back, which raises its pressure. So two things are
//! changed:
//! - A ghost takes velocities relative to ū, the mean of the water around its mirror point. So it
//!   takes S_g·ū less.
//! - That water gets back the ghost's push along the face, w_k p_g S_g for each particle.
//!
//! Both do the same work, so no energy is made.
//!
//! The second sum is over other ghosts of the bed (L_g is one on beds that are not level). At bends
//! of the bed they take the place of missing water.

use std::marker::PhantomData;

use super::ghosts::{Ghosts, Reflection};
use super::plane::Plane;
use super::rules::ExchangeRules;
use super::sums::Means;
use crate::body::Place;
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::pairs::{PairList, PointSet, build_pair_list};
use crate::with_kernel;

/// Sums of V_j ∇W_gj around eight ghosts, along x and up, 1/m.
type Around = [[f64; LANES]; 2];

/// The whole push is handed back where the water on the bed is no thicker than this, over the
/// support radius R. Where it is as thick as R, no ghost has the edge in reach and nothing is
/// handed back.
const THIN: f64 = 0.7;

/// Cosine of the steepest slope whose ghosts hand back, 1:2. On steeper shores water at rest does
/// not need it.
const GENTLE: f64 = 0.894;

/// The push of the bed's ghosts along its face.
#[derive(Debug, Clone, Default)]
pub(super) struct Smooth {
    /// The sums over the bed's own ghosts.
    own: Vec<Around>,
    /// S_g, m.
    slants: Vec<[[f64; LANES]; 2]>,
}

impl Smooth {
    /// Finds the sums over the bed's own ghosts, once.
    pub fn prepare(&mut self, path: SimdPath, rules: &ExchangeRules, ghosts: &Ghosts) {
        let body = &ghosts.bodies[Place::Bed.number()];
        let range = body.ghosts.clone();
        if ghosts.shore.is_none() || self.own.len() == range.len() / LANES {
            return;
        }
        let (x, y) = (&ghosts.x[range.clone()], &ghosts.y[range.clone()]);
        let (reach, bounds) = (rules.scaling.support_radius, PointSet::EVERYWHERE);
        let set = PointSet { strips: &body.strips, x, y, offset: 0.0, first: 0, reach, bounds };
        let mut list = PairList::default();
        build_pair_list(path, x, y, &[set], &mut list);
        let volume = &ghosts.volume[range];
        let inverse_radius = rules.scaling.inverse_radius;
        let per_volume = rules.scaling.weight_per_volume;
        self.own = with_kernel!(rules.kernel, K => dispatch(path, Own::<K> {
            list: &list,
            x,
            y,
            volume,
            inverse_radius,
            per_volume,
            kernel: PhantomData,
        }));
        self.slants = vec![Default::default(); self.own.len()];
    }

    /// Finds S_g at a block. Inputs are V_g V_i L_g ∇W_ig of the water around each ghost along x
    /// and up, the ghosts' volumes, and their pressures as heads in metres. S_g is zero before the
    /// shore, on steep slopes, and within two support radii of walls (see `alongside.rs`). It is
    /// also zero where the water is thick: there it would be noise under a high pressure.
    pub fn find(
        &mut self,
        block: usize,
        (ghosts, walls, radius): (&Ghosts, &[Plane], f64),
        (fluxes, [volume, head]): ([&[[f64; LANES]]; 2], [&[f64; LANES]; 2]),
    ) {
        let slants = &mut self.slants[block];
        *slants = Default::default();
        for lane in 0..LANES {
            let g = block * LANES + lane;
            let place = [ghosts.x[g], ghosts.y[g]];
            let Reflection::Plane { normal: [nx, ny] } = ghosts.reflection[g] else { continue };
            let on_shore = ghosts.shore.is_some_and(|from| place[0] > from) && -ny > GENTLE;
            if !on_shore || walls.iter().any(|wall| wall.beyond(place) > -2.0 * radius) {
                continue;
            }
            let thickness = (head[lane] - ghosts.distance[g]) / radius;
            let thin = ((1.0 - thickness) / (1.0 - THIN)).clamp(0.0, 1.0);
            let [x, y] = [0, 1].map(|axis: usize| {
                let water: f64 = fluxes[axis].iter().map(|flux| flux[lane]).sum();
                volume[lane].mul_add(self.own[block][axis][lane], water)
            });
            let along = thin * (nx * y - ny * x);
            (slants[0][lane], slants[1][lane]) = (-ny * along, nx * along);
        }
    }

    /// Whether the bed has a shore.
    pub fn is_on(&self) -> bool {
        !self.slants.is_empty()
    }

    /// S_g·ū at a block, m²/s: the rate at which water covers the ghosts.
    #[inline(always)]
    pub fn covered<L: Lanes>(&self, block: usize, means: &Means) -> L {
        let [along, up] = self.slants::<L>(block);
        along.mul_add(L::load(&means.vx), up * L::load(&means.vy))
    }

    /// S_g at a block, m.
    #[inline(always)]
    pub fn slants<L: Lanes>(&self, block: usize) -> [L; 2] {
        let [along, up] = &self.slants[block];
        [L::load(along), L::load(up)]
    }
}

/// Sums over the ghosts around each ghost. Ghosts that pad blocks have no volume.
struct Own<'a, K> {
    list: &'a PairList,
    x: &'a [f64],
    y: &'a [f64],
    volume: &'a [f64],
    inverse_radius: f64,
    per_volume: f64,
    kernel: PhantomData<K>,
}

impl<K: Kernel> Task for Own<'_, K> {
    type Output = Vec<Around>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Vec<Around> {
        let Own { list, x, y, volume, inverse_radius, per_volume, .. } = self;
        let ((own_x, _), (own_y, _)) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
        let scale = L::splat(inverse_radius);
        let of_block = |(block, (at_x, at_y)): (usize, (&[f64; LANES], &[f64; LANES]))| {
            let (at_x, at_y) = (L::load(at_x), L::load(at_y));
            let [mut along, mut up] = [L::splat(0.0); 2];
            for &other in list.group(block, 0) {
                let other = other as usize;
                let dx = (L::splat(x[other]) - at_x) * scale;
                let dy = (L::splat(y[other]) - at_y) * scale;
                let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                let inverse = s.rsqrt();
                let weight = L::splat(volume[other] * per_volume);
                let slope = K::slope_over_q(s, [s * inverse, inverse]) * weight;
                along = slope.mul_add(dx, along);
                up = slope.mul_add(dy, up);
            }
            let mut found = Around::default();
            along.store(&mut found[0]);
            up.store(&mut found[1]);
            found
        };
        own_x.iter().zip(own_y).enumerate().map(of_block).collect()
    }
}
