//! The pair pass of physical viscosity, for water that has any.

use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::{Fluid, Record};

use super::Workspace;
use super::held::HeldPairs;
use super::momentum::store;
use super::separation::{COINCIDENT, lanes};

/// Adds ν∇²u in the form of Monaghan & Gingold 1983, which keeps linear and angular momentum:
/// ```text
/// a_i = 8 ν Σ V_j ρ0/ρ_i (u_ij·x_ij)/|x_ij|² ∇W
/// ```
/// in two dimensions (2 (d + 2) in d), over the pairs and slopes of the momentum pass that has just
/// gone before. Like artificial viscosity it does in a full step all that it does until the next.
pub(super) struct Laminar<'a> {
    pub fluid: &'a Fluid,
    pub records: &'a [Record],
    pub pairs: &'a HeldPairs,
    pub work: &'a mut Workspace,
    /// Number of bodies: groups 1.. of the list.
    pub bodies: usize,
    /// 8 ν ρ0 / R.
    pub viscosity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
}

impl Task for Laminar<'_> {
    /// The viscous power, W per metre of width.
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut out = std::mem::take(self.work);
        let mut power = 0.0;
        for cluster in 0..self.fluid.padded_len() / LANES {
            let at = cluster * LANES;
            let inverse_density = lanes::<L>(&out.inverse_density, at);
            let volume = lanes::<L>(&self.fluid.mass, at) * inverse_density;
            let (mut sum_x, mut sum_y) = (L::splat(0.0), L::splat(0.0));
            for group in 0..=self.bodies {
                if self.pairs.group(cluster, group).0.is_empty() {
                    continue;
                }
                let [x, y] = L::call(Group { pass: &self, work: &out, cluster, group });
                let (x, y) = (L::load(&x), L::load(&y));
                if group > 0 {
                    let held = (x * volume).sum();
                    out.held_loads[group - 1] -= held;
                    out.loads[group - 1][0] -= held;
                }
                sum_x += x;
                sum_y += y;
            }
            let (vx, vy) = (lanes::<L>(&self.fluid.vx, at), lanes::<L>(&self.fluid.vy, at));
            power += (sum_x.mul_add(vx, sum_y * vy) * volume).sum();
            let share = inverse_density * L::splat(self.steps);
            let push = lanes::<L>(&out.acceleration_x, at);
            store(&mut out.acceleration_x, at, sum_x.mul_add(share, push));
            let push = lanes::<L>(&out.acceleration_y, at);
            store(&mut out.acceleration_y, at, sum_y.mul_add(share, push));
        }
        *self.work = out;
        power
    }
}

/// The pair loop over one group: force per volume of water, along x and y, by lanes.
struct Group<'a, 'b> {
    pass: &'b Laminar<'a>,
    work: &'b Workspace,
    cluster: usize,
    group: usize,
}

impl Task for Group<'_, '_> {
    type Output = [[f64; LANES]; 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [[f64; LANES]; 2] {
        let Group { pass, work, cluster, group } = self;
        let at = cluster * LANES;
        let x = lanes::<L>(&work.scaled_x, at);
        let y = lanes::<L>(&work.scaled_y, at);
        let vx = lanes::<L>(&pass.fluid.vx, at);
        let vy = lanes::<L>(&pass.fluid.vy, at);
        let (mut sum_x, mut sum_y) = (L::splat(0.0), L::splat(0.0));
        let (entries, slopes) = pass.pairs.group(cluster, group);
        for (&j, slope) in entries.iter().zip(slopes) {
            let record = &pass.records[j as usize].0;
            let g = L::load_single(&slope.0);
            let dx = x - L::splat(record[Record::X]);
            let dy = y - L::splat(record[Record::Y]);
            let s = dx.mul_add(dx, dy.mul_add(dy, L::splat(COINCIDENT)));
            let du = vx - L::splat(record[Record::VX]);
            let dv = vy - L::splat(record[Record::VY]);
            let drag = g * du.mul_add(dx, dv * dy).div(s);
            sum_x = drag.mul_add(dx, sum_x);
            sum_y = drag.mul_add(dy, sum_y);
        }
        let viscosity = L::splat(pass.viscosity);
        [(sum_x * viscosity).to_array(), (sum_y * viscosity).to_array()]
    }
}
