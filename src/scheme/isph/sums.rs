//! Sums over neighbours, for eight particles at a time.

use super::lists::{Lists, Numbers, load};
use crate::math::simd::{LANES, Lanes, Task};

/// F Δ of the eight with an entry.
#[inline(always)]
pub(super) fn pull<L: Lanes>(weights: &[f64; LANES], at: &Numbers, [x, y]: [L; 2]) -> [L; 2] {
    let f = L::load(weights);
    [f * (L::splat(at.place[0]) - x), f * (L::splat(at.place[1]) - y)]
}

/// Σ F (p_i L_i + p_j L_j) Δ.
pub(super) struct Gradient<'a> {
    pub lists: Lists<'a>,
    /// p_i.
    pub pressure: &'a [f64],
    /// p_j L_j, as tensors.
    pub numbers: &'a [Numbers],
    pub slope: &'a mut [[f64; 2]],
}

impl Task for Gradient<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Gradient { lists, pressure, numbers, slope } = self;
        for (cluster, slope) in slope.chunks_mut(LANES).enumerate() {
            let place = lists.place::<L>(cluster);
            let mut sums = [L::splat(0.0); 4];
            let (near, weights) = lists.of(cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let at = &numbers[e as usize];
                let [gx, gy] = pull(weights, at, place);
                let [xx, xy, yy] = at.tensor;
                sums[0] = gx.mul_add(L::splat(xx), sums[0]);
                sums[1] = gy.mul_add(L::splat(xy), sums[1]);
                sums[2] = gx.mul_add(L::splat(xy), sums[2]);
                sums[3] = gy.mul_add(L::splat(yy), sums[3]);
            }
            let (x, y) = ((sums[0] + sums[1]).to_array(), (sums[2] + sums[3]).to_array());
            for (lane, slope) in slope.iter_mut().enumerate() {
                let i = cluster * LANES + lane;
                let ([sx, sy], [xx, xy, yy]) = (lists.sway[i], lists.correction[i]);
                let p = pressure[i];
                *slope = [x[lane] + p * (xx * sx + xy * sy), y[lane] + p * (xy * sx + yy * sy)];
            }
        }
    }
}

/// Σ F (u_j - u_i)·L_i Δ.
pub(super) struct Divergence<'a> {
    pub lists: Lists<'a>,
    /// u_i.
    pub own: &'a [[f64; 2]],
    /// u_j.
    pub numbers: &'a [Numbers],
    pub divergence: &'a mut [f64],
}

impl Task for Divergence<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Divergence { lists, own, numbers, divergence } = self;
        for (cluster, divergence) in divergence.chunks_mut(LANES).enumerate() {
            let [[ux, uy], [vx, vy]] = sum_products::<L>(&lists, numbers, cluster);
            for (lane, divergence) in divergence.iter_mut().enumerate() {
                let i = cluster * LANES + lane;
                let ([sx, sy], [lxx, lxy, lyy]) = (lists.sway[i], lists.correction[i]);
                let [u, v] = own[i];
                *divergence = lxx * (ux[lane] - sx * u)
                    + lxy * (uy[lane] + vx[lane] - sx * v - sy * u)
                    + lyy * (vy[lane] - sy * v);
            }
        }
    }
}

/// Σ F Δ u_j of the eight: along x and y, of u and of v.
#[inline(always)]
fn sum_products<L: Lanes>(
    lists: &Lists<'_>,
    numbers: &[Numbers],
    cluster: usize,
) -> [[[f64; LANES]; 2]; 2] {
    let place = lists.place::<L>(cluster);
    let mut sums = [L::splat(0.0); 4];
    let (near, weights) = lists.of(cluster);
    for (&e, weights) in near.iter().zip(weights) {
        let at = &numbers[e as usize];
        let [gx, gy] = pull(weights, at, place);
        let [u, v] = at.velocity;
        sums[0] = gx.mul_add(L::splat(u), sums[0]);
        sums[1] = gy.mul_add(L::splat(u), sums[1]);
        sums[2] = gx.mul_add(L::splat(v), sums[2]);
        sums[3] = gy.mul_add(L::splat(v), sums[3]);
    }
    let [ux, uy, vx, vy] = L::to_arrays(sums);
    [[ux, uy], [vx, vy]]
}

/// ∇u with the correction L: its trace and, trace-free and symmetric, the strain
/// (½ (∂u/∂x - ∂v/∂y), ½ (∂u/∂y + ∂v/∂x)).
pub(super) struct Strain<'a> {
    pub lists: Lists<'a>,
    /// u_i.
    pub own: &'a [[f64; 2]],
    /// u_j.
    pub numbers: &'a [Numbers],
    pub strain: &'a mut [[f64; 2]],
    pub divergence: &'a mut [f64],
}

impl Task for Strain<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Strain { lists, own, numbers, strain, divergence } = self;
        let results = strain.chunks_mut(LANES).zip(divergence.chunks_mut(LANES));
        for (cluster, (strain, divergence)) in results.enumerate() {
            let [[ux, uy], [vx, vy]] = sum_products::<L>(&lists, numbers, cluster);
            for lane in 0..strain.len() {
                let i = cluster * LANES + lane;
                let ([sx, sy], [u, v]) = (lists.sway[i], own[i]);
                let [ux, uy] = [ux[lane] - sx * u, uy[lane] - sy * u];
                let [vx, vy] = [vx[lane] - sx * v, vy[lane] - sy * v];
                let [xx, xy, yy] = lists.correction[i];
                let (along, across) = (ux * xx + uy * xy, vx * xy + vy * yy);
                let shear = ux * xy + uy * yy + vx * xx + vy * xy;
                strain[lane] = [0.5 * (along - across), 0.5 * shear];
                divergence[lane] = along + across;
            }
        }
    }
}

/// What the images that the walls make of the water do to it, along x: Σ V_i F ((p_i L_i + p_j L_j) Δ)_x
/// by the image's body.
pub(super) struct Reaction<'a> {
    pub lists: Lists<'a>,
    /// p_i.
    pub pressure: &'a [f64],
    /// V_i, padded.
    pub volume: &'a [f64],
    /// p_j L_j, as tensors.
    pub numbers: &'a [Numbers],
    /// Body of each point.
    pub body: &'a [u8],
    pub forces: &'a mut [f64],
}

impl Task for Reaction<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Reaction { lists, pressure, volume, numbers, body, forces } = self;
        for cluster in 0..pressure.len().div_ceil(LANES) {
            let (near, weights) = lists.images_of(cluster);
            if near.is_empty() {
                continue;
            }
            let place = lists.place::<L>(cluster);
            let (mut own_xx, mut own_xy) = ([0.0; LANES], [0.0; LANES]);
            let own = pressure[cluster * LANES..].iter().zip(&lists.correction[cluster * LANES..]);
            for ((p, [xx, xy, _]), stress) in own.zip(own_xx.iter_mut().zip(&mut own_xy)) {
                (*stress.0, *stress.1) = (xx * p, xy * p);
            }
            let (own_xx, own_xy) = (L::load(&own_xx), L::load(&own_xy));
            let volume = load::<L>(volume, cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let at = &numbers[e as usize];
                let [gx, gy] = pull(weights, at, place);
                let [xx, xy, _] = at.tensor;
                let along = (gx * (L::splat(xx) + own_xx)) + gy * (L::splat(xy) + own_xy);
                forces[body[e as usize] as usize] += (volume * along).sum();
            }
        }
    }
}
