//! Sums over neighbours, eight of them at a time.

use crate::math::simd::{LANES, Lanes, Task};

/// Neighbours of every particle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lists<'a> {
    pub starts: &'a [u32],
    pub near: &'a [u32],
    /// F Δ.
    pub pull: [&'a [f64]; 2],
    /// Its sum.
    pub sway: &'a [[f64; 2]],
    /// L.
    pub correction: &'a [[f64; 3]],
}

/// Σ F (p_i L_i + p_j L_j) Δ.
pub(super) struct Gradient<'a> {
    pub lists: Lists<'a>,
    /// p_i.
    pub pressure: &'a [f64],
    /// p_j L_j.
    pub stress: [&'a [f64]; 3],
    pub slope: &'a mut [[f64; 2]],
}

impl Task for Gradient<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Lists { starts, near, pull: [pull_x, pull_y], sway, correction } = self.lists;
        for (i, slope) in self.slope.iter_mut().enumerate() {
            let range = starts[i] as usize..starts[i + 1] as usize;
            let (near, rest) = near[range.clone()].as_chunks::<LANES>();
            let (gx, rest_x) = pull_x[range.clone()].as_chunks::<LANES>();
            let (gy, rest_y) = pull_y[range].as_chunks::<LANES>();
            let zero = L::splat(0.0);
            let (mut x, mut y) = (zero, zero);
            for ((near, gx), gy) in near.iter().zip(gx).zip(gy) {
                let xx = L::gather(self.stress[0], near);
                let xy = L::gather(self.stress[1], near);
                let yy = L::gather(self.stress[2], near);
                let (gx, gy) = (L::load(gx), L::load(gy));
                x = gx.mul_add(xx, gy.mul_add(xy, x));
                y = gx.mul_add(xy, gy.mul_add(yy, y));
            }
            let [sx, sy] = sway[i];
            let [xx, xy, yy] = correction[i];
            let p = self.pressure[i];
            let (mut x, mut y) =
                (x.sum() + p * (xx * sx + xy * sy), y.sum() + p * (xy * sx + yy * sy));
            for ((&e, gx), gy) in rest.iter().zip(rest_x).zip(rest_y) {
                let [xx, xy, yy] = self.stress.map(|stress| stress[e as usize]);
                x += gx * xx + gy * xy;
                y += gx * xy + gy * yy;
            }
            *slope = [x, y];
        }
    }
}

/// Σ F (u_j - u_i)·L_i Δ.
pub(super) struct Divergence<'a> {
    pub lists: Lists<'a>,
    /// u_i.
    pub own: &'a [[f64; 2]],
    /// u_j.
    pub moving: [&'a [f64]; 2],
    pub divergence: &'a mut [f64],
}

impl Task for Divergence<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Lists { starts, near, pull: [pull_x, pull_y], sway, correction } = self.lists;
        for (i, divergence) in self.divergence.iter_mut().enumerate() {
            let range = starts[i] as usize..starts[i + 1] as usize;
            let (near, rest) = near[range.clone()].as_chunks::<LANES>();
            let (gx, rest_x) = pull_x[range.clone()].as_chunks::<LANES>();
            let (gy, rest_y) = pull_y[range].as_chunks::<LANES>();
            let zero = L::splat(0.0);
            let (mut xx, mut xy, mut yy) = (zero, zero, zero);
            for ((near, gx), gy) in near.iter().zip(gx).zip(gy) {
                let u = L::gather(self.moving[0], near);
                let v = L::gather(self.moving[1], near);
                let (gx, gy) = (L::load(gx), L::load(gy));
                xx = gx.mul_add(u, xx);
                yy = gy.mul_add(v, yy);
                xy = gx.mul_add(v, gy.mul_add(u, xy));
            }
            let [sx, sy] = sway[i];
            let [u, v] = self.own[i];
            let (mut xx, mut xy, mut yy) = (xx.sum(), xy.sum(), yy.sum());
            for ((&e, gx), gy) in rest.iter().zip(rest_x).zip(rest_y) {
                let [u, v] = self.moving.map(|moving| moving[e as usize]);
                xx += gx * u;
                xy += gx * v + gy * u;
                yy += gy * v;
            }
            let [lxx, lxy, lyy] = correction[i];
            *divergence = lxx * (xx - sx * u) + lxy * (xy - sx * v - sy * u) + lyy * (yy - sy * v);
        }
    }
}

/// ∇u with the correction L: its trace and, trace-free and symmetric, the strain
/// (½ (∂u/∂x - ∂v/∂y), ½ (∂u/∂y + ∂v/∂x)).
pub(super) struct Strain<'a> {
    pub lists: Lists<'a>,
    /// u_i.
    pub own: &'a [[f64; 2]],
    /// u_j.
    pub moving: [&'a [f64]; 2],
    pub strain: &'a mut [[f64; 2]],
    pub divergence: &'a mut [f64],
}

impl Task for Strain<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Lists { starts, near, pull: [pull_x, pull_y], sway, correction } = self.lists;
        for (i, strain) in self.strain.iter_mut().enumerate() {
            let range = starts[i] as usize..starts[i + 1] as usize;
            let (near, rest) = near[range.clone()].as_chunks::<LANES>();
            let (gx, rest_x) = pull_x[range.clone()].as_chunks::<LANES>();
            let (gy, rest_y) = pull_y[range].as_chunks::<LANES>();
            let mut sums = [L::splat(0.0); 4];
            for ((near, gx), gy) in near.iter().zip(gx).zip(gy) {
                let u = L::gather(self.moving[0], near);
                let v = L::gather(self.moving[1], near);
                let (gx, gy) = (L::load(gx), L::load(gy));
                sums[0] = gx.mul_add(u, sums[0]);
                sums[1] = gy.mul_add(u, sums[1]);
                sums[2] = gx.mul_add(v, sums[2]);
                sums[3] = gy.mul_add(v, sums[3]);
            }
            let [sx, sy] = sway[i];
            let [u, v] = self.own[i];
            let mut sums = sums.map(|sum| sum.sum());
            for ((&e, gx), gy) in rest.iter().zip(rest_x).zip(rest_y) {
                let [u, v] = self.moving.map(|moving| moving[e as usize]);
                sums[0] += gx * u;
                sums[1] += gy * u;
                sums[2] += gx * v;
                sums[3] += gy * v;
            }
            let [ux, uy] = [sums[0] - sx * u, sums[1] - sy * u];
            let [vx, vy] = [sums[2] - sx * v, sums[3] - sy * v];
            let [xx, xy, yy] = correction[i];
            let (along, across) = (ux * xx + uy * xy, vx * xy + vy * yy);
            let shear = ux * xy + uy * yy + vx * xx + vy * xy;
            *strain = [0.5 * (along - across), 0.5 * shear];
            self.divergence[i] = along + across;
        }
    }
}
