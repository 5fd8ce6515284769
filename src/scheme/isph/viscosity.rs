//! Viscosity: that of the fluid, and that of the scheme on what a linear velocity leaves.

use super::Isph;
use super::images::{NO_BODY, Points, turned};
use super::sums::{Lists, Strain};
use crate::math::simd::{LANES, Lanes, Task, dispatch};

/// Viscous accelerations: 2 ν Σ F (u_j - u_i), Liang et al. 2017, Eq. 3, and α h c Σ F π Δ with π =
/// (u_j - u_i)·Δ/r² less what a linear, divergence-free velocity gives, limited so that every pair
/// dissipates or does nothing.
struct Drag<'a> {
    points: &'a Points,
    places: &'a [super::images::Point],
    lists: Lists<'a>,
    own: &'a [[f64; 2]],
    moving: [&'a [f64]; 2],
    strain: &'a [[f64; 2]],
    /// Strain of every point.
    turned: [&'a [f64]; 2],
    /// α h c.
    artificial: f64,
    /// 2 ν.
    physical: f64,
    /// What Δ² is taken for at least, m².
    least: f64,
    drag: &'a mut [[f64; 2]],
}

impl Drag<'_> {
    /// What eight neighbours do to a particle, along x and y.
    #[inline(always)]
    fn of<L: Lanes>(&self, i: usize, near: &[u32; LANES], pull: [L; 2]) -> [L; 2] {
        let (x, y) = (L::gather(&self.points.x, near), L::gather(&self.points.y, near));
        let (u, v) = (L::gather(self.moving[0], near), L::gather(self.moving[1], near));
        let (p, q) = (L::gather(self.turned[0], near), L::gather(self.turned[1], near));
        let ([px, py], [ui, vi], [pi, qi]) = (self.places[i].place, self.own[i], self.strain[i]);
        let (dx, dy) = (x - L::splat(px), y - L::splat(py));
        let (du, dv) = (u - L::splat(ui), v - L::splat(vi));
        let (p, q) = ((p + L::splat(pi)) * L::splat(0.5), q + L::splat(qi));
        let approach = du.mul_add(dx, dv * dy);
        let linear = p.mul_add(dx * dx - dy * dy, q * (dx * dy));
        let zero = L::splat(0.0);
        let left = (approach - linear).min(approach.max(zero)).max(approach.min(zero));
        let square = dx.mul_add(dx, dy * dy).max(L::splat(self.least));
        let factor = (L::splat(self.artificial) * left).div(square);
        // F = (F Δ)·Δ/Δ².
        let weight = (L::splat(self.physical) * pull[0].mul_add(dx, pull[1] * dy)).div(square);
        [factor.mul_add(pull[0], weight * du), factor.mul_add(pull[1], weight * dv)]
    }

    /// The last few neighbours, padded with the particle's own first one, which pulls nothing.
    #[inline(always)]
    fn of_rest<L: Lanes>(&self, i: usize, near: &[u32], [x, y]: [&[f64]; 2]) -> [L; 2] {
        let mut padded = ([near[0]; LANES], [0.0; LANES], [0.0; LANES]);
        padded.0[..near.len()].copy_from_slice(near);
        padded.1[..near.len()].copy_from_slice(x);
        padded.2[..near.len()].copy_from_slice(y);
        self.of(i, &padded.0, [L::load(&padded.1), L::load(&padded.2)])
    }
}

impl Task for Drag<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let drag = std::mem::take(&mut self.drag);
        let Lists { starts, near, pull: [pull_x, pull_y], .. } = self.lists;
        for (i, drag) in drag.iter_mut().enumerate() {
            let range = starts[i] as usize..starts[i + 1] as usize;
            let (near, rest) = near[range.clone()].as_chunks::<LANES>();
            let (gx, rest_x) = pull_x[range.clone()].as_chunks::<LANES>();
            let (gy, rest_y) = pull_y[range].as_chunks::<LANES>();
            let mut sum = [L::splat(0.0); 2];
            for ((near, gx), gy) in near.iter().zip(gx).zip(gy) {
                let [x, y] = self.of(i, near, [L::load(gx), L::load(gy)]);
                sum = [sum[0] + x, sum[1] + y];
            }
            if !rest.is_empty() {
                let [x, y] = self.of_rest::<L>(i, rest, [rest_x, rest_y]);
                sum = [sum[0] + x, sum[1] + y];
            }
            *drag = sum.map(|sum| sum.sum());
        }
    }
}

/// The part of the drag along x that single neighbours of a particle make.
struct ByNeighbour<'a, 'b> {
    drag: &'b Drag<'a>,
    i: usize,
    take: &'b mut dyn FnMut(usize, f64),
}

impl Task for ByNeighbour<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Lists { starts, near, pull: [pull_x, pull_y], .. } = self.drag.lists;
        let mut at = starts[self.i] as usize;
        let end = starts[self.i + 1] as usize;
        while at < end {
            let part = at..end.min(at + LANES);
            let pulls = [&pull_x[part.clone()], &pull_y[part.clone()]];
            let [x, _] = self.drag.of_rest::<L>(self.i, &near[part.clone()], pulls);
            for (&e, &x) in near[part].iter().zip(&x.to_array()) {
                (self.take)(e as usize, x);
            }
            at += LANES;
        }
    }
}

impl Isph {
    /// Viscous accelerations, with walls that slip freely, and the divergence of the velocities.
    pub(super) fn find_drag(&mut self) {
        let options = self.options;
        let n = self.fluid.len();
        self.drag.clear();
        self.drag.resize(n, [0.0; 2]);
        self.drag_on_bodies.fill(0.0);
        self.velocities.clear();
        self.velocities.extend((0..n).map(|i| [self.fluid.vx[i], self.fluid.vy[i]]));
        self.mirror(|walls| walls.start_velocity);
        let mut strain = std::mem::take(&mut self.strain);
        let mut divergence = std::mem::take(&mut self.operators.divergence);
        strain.resize(n, [0.0; 2]);
        divergence.resize(n, 0.0);
        dispatch(
            self.path,
            Strain {
                lists: self.lists(),
                own: &self.velocities,
                moving: [&self.moving[0], &self.moving[1]],
                strain: &mut strain,
                divergence: &mut divergence,
            },
        );
        self.operators.divergence = divergence;
        self.strain = strain;
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let artificial = options.artificial_viscosity * smoothing * options.viscous_speed;
        if artificial + options.viscosity == 0.0 {
            return;
        }
        self.turned_strain.iter_mut().for_each(Vec::clear);
        for e in 0..self.loose.len() {
            let [p, q] = self.strain[self.points.original[e] as usize];
            let [p, q, _] = turned(self.points.turn[e], [p, q, -p]);
            self.turned_strain[0].push(p);
            self.turned_strain[1].push(q);
        }
        let mut drag = std::mem::take(&mut self.drag);
        let mut on_bodies = std::mem::take(&mut self.drag_on_bodies);
        let pass = |drag| Drag {
            points: &self.points,
            places: &self.loose,
            lists: self.lists(),
            own: &self.velocities,
            moving: [&self.moving[0], &self.moving[1]],
            strain: &self.strain,
            turned: [&self.turned_strain[0], &self.turned_strain[1]],
            artificial,
            physical: 2.0 * options.viscosity,
            least: 1e-12 * options.spacing * options.spacing,
            drag,
        };
        dispatch(self.path, pass(&mut drag));
        // What the walls' images do to the water, the water does to the walls.
        let alone = pass(&mut []);
        for &i in &self.at_walls {
            let mass = self.fluid.mass[i as usize];
            let mut take = |e: usize, x: f64| {
                if self.points.body[e] != NO_BODY {
                    on_bodies[self.points.body[e] as usize] -= mass * x;
                }
            };
            dispatch(self.path, ByNeighbour { drag: &alone, i: i as usize, take: &mut take });
        }
        self.drag_on_bodies = on_bodies;
        self.drag = drag;
    }
}
