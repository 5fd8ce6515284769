//! Viscosity: that of the fluid, and that of the scheme on what a linear velocity leaves.

use super::Isph;
use super::images::{NO_BODY, turned};
use super::lists::{Lists, Numbers, load};
use super::sums;
use crate::math::simd::{LANES, Lanes, Task, dispatch};

/// Viscous accelerations: 2 ν Σ F (u_j - u_i), Liang et al. 2017, Eq. 3, and α h c Σ F π Δ with π =
/// (u_j - u_i)·Δ/r² less what a linear, divergence-free velocity gives, limited so that every pair
/// dissipates or does nothing.
struct Drag<'a> {
    lists: Lists<'a>,
    /// Of every point, images too: u, and the strain as a tensor.
    numbers: &'a [Numbers],
    /// α h c.
    artificial: f64,
    /// 2 ν.
    physical: f64,
    /// What Δ² is taken for at least, m².
    least: f64,
    /// m_i, padded.
    mass: &'a [f64],
    drag: &'a mut [[f64; 2]],
    /// What the water does to the bodies, whose images do this to the water.
    on_bodies: &'a mut [f64],
}

/// The eight, as their drag wants them.
struct Eight<L> {
    place: [L; 2],
    velocity: [L; 2],
    strain: [L; 2],
}

impl<L: Lanes> Eight<L> {
    #[inline(always)]
    fn of(lists: &Lists<'_>, numbers: &[Numbers], cluster: usize) -> Eight<L> {
        let mut fields = [[0.0; LANES]; 4];
        for lane in 0..LANES {
            let at = &numbers[cluster * LANES + lane];
            let [u, v] = at.velocity;
            let [p, q, _] = at.tensor;
            for (field, value) in fields.iter_mut().zip([u, v, p, q]) {
                field[lane] = value;
            }
        }
        let [u, v, p, q] = &fields;
        Eight {
            place: lists.place(cluster),
            velocity: [L::load(u), L::load(v)],
            strain: [L::load(p), L::load(q)],
        }
    }
}

impl Drag<'_> {
    /// What an entry does to the eight, along x and y.
    #[inline(always)]
    fn of<L: Lanes>(&self, eight: &Eight<L>, at: &Numbers, weights: &[f64; LANES]) -> [L; 2] {
        let ([x, y], [u, v], [p, q]) = (eight.place, eight.velocity, eight.strain);
        let (dx, dy) = (L::splat(at.place[0]) - x, L::splat(at.place[1]) - y);
        let (du, dv) = (L::splat(at.velocity[0]) - u, L::splat(at.velocity[1]) - v);
        let p = (L::splat(at.tensor[0]) + p) * L::splat(0.5);
        let q = L::splat(at.tensor[1]) + q;
        let approach = du.mul_add(dx, dv * dy);
        let linear = p.mul_add(dx * dx - dy * dy, q * (dx * dy));
        let zero = L::splat(0.0);
        let left = (approach - linear).min(approach.max(zero)).max(approach.min(zero));
        let square = dx.mul_add(dx, dy * dy).max(L::splat(self.least));
        let f = L::load(weights);
        let factor = f * (L::splat(self.artificial) * left).div(square);
        let weight = f * L::splat(self.physical);
        [factor.mul_add(dx, weight * du), factor.mul_add(dy, weight * dv)]
    }
}

impl Task for Drag<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for cluster in 0..self.drag.len().div_ceil(LANES) {
            let eight = Eight::<L>::of(&self.lists, self.numbers, cluster);
            let mass = load::<L>(self.mass, cluster);
            let mut sums = [L::splat(0.0); 2];
            let (near, weights) = self.lists.of(cluster);
            for (&e, weights) in near.iter().zip(weights) {
                let [x, y] = self.of(&eight, &self.numbers[e as usize], weights);
                sums = [sums[0] + x, sums[1] + y];
                let body = self.lists.points.body[e as usize];
                if body != NO_BODY {
                    self.on_bodies[body as usize] -= (mass * x).sum();
                }
            }
            let [x, y] = L::to_arrays(sums);
            for (lane, drag) in self.drag[cluster * LANES..].iter_mut().take(LANES).enumerate() {
                *drag = [x[lane], y[lane]];
            }
        }
    }
}

impl Isph {
    /// Viscous accelerations, with walls that slip freely, and the divergence of the velocities.
    pub(super) fn find_drag(&mut self) {
        let n = self.fluid.len();
        self.drag.clear();
        self.drag.resize(n, [0.0; 2]);
        self.drag_on_bodies.fill(0.0);
        self.velocities.clear();
        self.velocities.extend((0..n).map(|i| [self.fluid.vx[i], self.fluid.vy[i]]));
        self.mirror(|walls| walls.start_velocity);
        let (lists, points) = (self.near.lists(&self.operators), &self.near.points);
        let found = (&mut self.strain[..], &mut self.divergence[..]);
        sums::strain(self.path, (lists, &self.numbers), &self.velocities, found);
        let options = &self.options;
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let artificial = options.artificial_viscosity * smoothing * options.viscous_speed;
        if artificial + options.viscosity == 0.0 {
            return;
        }
        for (e, at) in self.numbers.iter_mut().enumerate() {
            let [p, q] = self.strain[points.original[e] as usize];
            at.tensor = turned(points.turn[e], [p, q, -p]);
        }
        let pass = Drag {
            lists,
            numbers: &self.numbers,
            artificial,
            physical: 2.0 * options.viscosity,
            least: 1e-12 * options.spacing * options.spacing,
            mass: &self.fluid.mass,
            drag: &mut self.drag,
            on_bodies: &mut self.drag_on_bodies,
        };
        dispatch(self.path, pass);
    }
}
