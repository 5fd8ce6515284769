//! Sums over neighbours, for eight particles at a time.

use super::lists::{Lists, Numbers, load};
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};

/// F Δ of the eight with an entry.
#[inline(always)]
pub(super) fn pull<L: Lanes>(weights: &[f64; LANES], at: &Numbers, [x, y]: [L; 2]) -> [L; 2] {
    let f = L::load(weights);
    [f * (L::splat(at.place[0]) - x), f * (L::splat(at.place[1]) - y)]
}

/// An entry of a list: number of the point, its weights with the eight, and what is at it.
pub(super) type Entry<'a> = (usize, &'a [f64; LANES], &'a Numbers);

/// The four terms that a pass adds up over the entries of the eight.
pub(super) trait Terms: Copy {
    /// Adds those of an entry.
    fn add<L: Lanes>(self, sums: &mut [L; 4], place: [L; 2], entry: Entry<'_>);
}

/// p_j L_j Δ F, the tensor being p L: along x from Δx and Δy, along y from both.
#[derive(Clone, Copy)]
struct Stress;

impl Terms for Stress {
    #[inline(always)]
    fn add<L: Lanes>(self, sums: &mut [L; 4], place: [L; 2], (_, weights, at): Entry<'_>) {
        let [gx, gy] = pull(weights, at, place);
        let [xx, xy, yy] = at.tensor;
        sums[0] = gx.mul_add(L::splat(xx), sums[0]);
        sums[1] = gy.mul_add(L::splat(xy), sums[1]);
        sums[2] = gx.mul_add(L::splat(xy), sums[2]);
        sums[3] = gy.mul_add(L::splat(yy), sums[3]);
    }
}

/// F Δ u_j: along x and y, of u and of v.
#[derive(Clone, Copy)]
struct Flow;

impl Terms for Flow {
    #[inline(always)]
    fn add<L: Lanes>(self, sums: &mut [L; 4], place: [L; 2], (_, weights, at): Entry<'_>) {
        let [gx, gy] = pull(weights, at, place);
        let [u, v] = at.velocity;
        sums[0] = gx.mul_add(L::splat(u), sums[0]);
        sums[1] = gy.mul_add(L::splat(u), sums[1]);
        sums[2] = gx.mul_add(L::splat(v), sums[2]);
        sums[3] = gy.mul_add(L::splat(v), sums[3]);
    }
}

struct Sum<'a, T, F> {
    lists: Lists<'a>,
    numbers: &'a [Numbers],
    terms: T,
    close: F,
}

impl<T: Terms, F: FnMut(usize, [f64; 4])> Task for Sum<'_, T, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let n = self.lists.sway.len();
        for cluster in 0..n.div_ceil(LANES) {
            let place = self.lists.place::<L>(cluster);
            let mut sums = [L::splat(0.0); 4];
            let (near, weights) = self.lists.of(cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let at = &self.numbers[e as usize];
                self.terms.add(&mut sums, place, (e as usize, weights, at));
            }
            let [a, b, c, d] = L::to_arrays(sums);
            for lane in 0..LANES.min(n - cluster * LANES) {
                (self.close)(cluster * LANES + lane, [a[lane], b[lane], c[lane], d[lane]]);
            }
        }
    }
}

/// Adds up terms over the entries of every particle and hands its four sums to `close`.
pub(super) fn sum(
    path: SimdPath,
    (lists, numbers): (Lists<'_>, &[Numbers]),
    terms: impl Terms,
    close: impl FnMut(usize, [f64; 4]),
) {
    dispatch(path, Sum { lists, numbers, terms, close });
}

/// Σ F (p_i L_i + p_j L_j) Δ for the pressures p_i, with p_j L_j as tensors.
pub(super) fn gradient(
    path: SimdPath,
    near: (Lists<'_>, &[Numbers]),
    pressure: &[f64],
    slope: &mut [[f64; 2]],
) {
    let lists = near.0;
    sum(path, near, Stress, |i, [x, more_x, y, more_y]| {
        let ([sx, sy], [xx, xy, yy], p) = (lists.sway[i], lists.correction[i], pressure[i]);
        slope[i] = [(x + more_x) + p * (xx * sx + xy * sy), (y + more_y) + p * (xy * sx + yy * sy)];
    });
}

/// Σ F (u_j - u_i)·L_i Δ for the velocities u_i.
pub(super) fn divergence(
    path: SimdPath,
    near: (Lists<'_>, &[Numbers]),
    own: &[[f64; 2]],
    divergence: &mut [f64],
) {
    let lists = near.0;
    sum(path, near, Flow, |i, [ux, uy, vx, vy]| {
        let ([sx, sy], [lxx, lxy, lyy], [u, v]) = (lists.sway[i], lists.correction[i], own[i]);
        divergence[i] =
            lxx * (ux - sx * u) + lxy * (uy + vx - sx * v - sy * u) + lyy * (vy - sy * v);
    });
}

/// ∇u with the correction L: its trace and, trace-free and symmetric, the strain
/// (½ (∂u/∂x - ∂v/∂y), ½ (∂u/∂y + ∂v/∂x)).
pub(super) fn strain(
    path: SimdPath,
    near: (Lists<'_>, &[Numbers]),
    own: &[[f64; 2]],
    (strain, divergence): (&mut [[f64; 2]], &mut [f64]),
) {
    let lists = near.0;
    sum(path, near, Flow, |i, [ux, uy, vx, vy]| {
        let ([sx, sy], [xx, xy, yy], [u, v]) = (lists.sway[i], lists.correction[i], own[i]);
        let [ux, uy] = [ux - sx * u, uy - sy * u];
        let [vx, vy] = [vx - sx * v, vy - sy * v];
        let (along, across) = (ux * xx + uy * xy, vx * xy + vy * yy);
        let shear = ux * xy + uy * yy + vx * xx + vy * xy;
        strain[i] = [0.5 * (along - across), 0.5 * shear];
        divergence[i] = along + across;
    });
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
