//! Viscosity: that of the fluid, and that of the scheme on what a linear velocity leaves.

use super::Isph;
use super::images::turned;
use super::lists::{Lists, Numbers, load, own};
use super::sums::Strain;
use crate::math::simd::{LANES, Lanes, Task, dispatch};

/// Viscous accelerations: 2 ν Σ F (u_j - u_i), Liang et al. 2017, Eq. 3, and α h c Σ F π Δ with π =
/// (u_j - u_i)·Δ/r² less what a linear, divergence-free velocity gives, limited so that every pair
/// dissipates or does nothing.
struct Drag<'a> {
    lists: Lists<'a>,
    /// u_i.
    own: &'a [[f64; 2]],
    /// Strain of the particles.
    strain: &'a [[f64; 2]],
    /// u_j, and the strain as a tensor.
    numbers: &'a [Numbers],
    /// α h c.
    artificial: f64,
    /// 2 ν.
    physical: f64,
    /// What Δ² is taken for at least, m².
    least: f64,
    /// m_i, padded.
    mass: &'a [f64],
    /// Body of each point.
    body: &'a [u8],
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

impl Drag<'_> {
    /// What an entry does to the eight, along x and y.
    #[inline(always)]
    fn of<L: Lanes>(&self, eight: &Eight<L>, e: u32, weights: &[f64; LANES]) -> [L; 2] {
        let at = &self.numbers[e as usize];
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
    fn run<L: Lanes>(mut self) {
        let (drag, on_bodies) =
            (std::mem::take(&mut self.drag), std::mem::take(&mut self.on_bodies));
        for (cluster, drag) in drag.chunks_mut(LANES).enumerate() {
            let eight = Eight {
                place: self.lists.place::<L>(cluster),
                velocity: own(self.own, cluster),
                strain: own(self.strain, cluster),
            };
            let mut sums = [L::splat(0.0); 2];
            let (near, weights) = self.lists.of(cluster);
            let water = self.lists.pairs.group(cluster, 0).len();
            for (&e, weights) in near[..water].iter().zip(weights) {
                let [x, y] = self.of(&eight, e, weights);
                sums = [sums[0] + x, sums[1] + y];
            }
            if water < near.len() {
                let mass = load::<L>(self.mass, cluster);
                for (&e, weights) in near[water..].iter().zip(&weights[water..]) {
                    let [x, y] = self.of(&eight, e, weights);
                    sums = [sums[0] + x, sums[1] + y];
                    on_bodies[self.body[e as usize] as usize] -= (mass * x).sum();
                }
            }
            let [x, y] = L::to_arrays(sums);
            for (lane, drag) in drag.iter_mut().enumerate() {
                *drag = [x[lane], y[lane]];
            }
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
        let own = &self.velocities;
        let (lists, numbers) = (self.lists(), &self.numbers);
        let (strain_out, divergence_out) = (&mut strain[..], &mut divergence[..]);
        dispatch(
            self.path,
            Strain { lists, own, numbers, strain: strain_out, divergence: divergence_out },
        );
        self.operators.divergence = divergence;
        self.strain = strain;
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let artificial = options.artificial_viscosity * smoothing * options.viscous_speed;
        if artificial + options.viscosity == 0.0 {
            return;
        }
        for (e, at) in self.numbers.iter_mut().enumerate() {
            let [p, q] = self.strain[self.points.original[e] as usize];
            at.tensor = turned(self.points.turn[e], [p, q, -p]);
        }
        let mut drag = std::mem::take(&mut self.drag);
        let mut on_bodies = std::mem::take(&mut self.drag_on_bodies);
        let pass = Drag {
            lists: self.lists(),
            own: &self.velocities,
            strain: &self.strain,
            numbers: &self.numbers,
            artificial,
            physical: 2.0 * options.viscosity,
            least: 1e-12 * options.spacing * options.spacing,
            mass: &self.fluid.mass,
            body: &self.points.body,
            drag: &mut drag,
            on_bodies: &mut on_bodies,
        };
        dispatch(self.path, pass);
        self.drag_on_bodies = on_bodies;
        self.drag = drag;
    }
}
