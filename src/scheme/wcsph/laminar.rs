//! The pair pass of physical viscosity, for water that has any.

use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::{Fluid, Record};

use super::Workspace;
use super::held::Slopes;
use super::momentum::store;
use super::parts::Part;
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
    pub part: &'a mut Part,
    pub work: &'a Workspace,
    /// The part's rows: accelerations along x and y, added to.
    pub acceleration: [&'a mut [f64]; 2],
    /// Number of bodies: groups 1.. of the list.
    pub bodies: usize,
    /// 8 ν ρ0 / R.
    pub viscosity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
}

impl Task for Laminar<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Laminar { fluid, records, part, work, acceleration, bodies, .. } = self;
        let Part { clusters, held, tally, .. } = part;
        let [acceleration_x, acceleration_y] = acceleration;
        tally.clear();
        tally.force_entries += held.len();
        for (here, cluster) in clusters.clone().enumerate() {
            let (at, to) = (cluster * LANES, here * LANES);
            let inverse_density = lanes::<L>(&work.inverse_density, at);
            let volume = lanes::<L>(&fluid.mass, at) * inverse_density;
            let (mut sum_x, mut sum_y) = (L::splat(0.0), L::splat(0.0));
            for group in 0..=bodies {
                let (entries, slopes) = held.group(here, group);
                if entries.is_empty() {
                    continue;
                }
                let viscosity = self.viscosity;
                let [x, y] =
                    L::call(Group { fluid, records, work, viscosity, cluster, entries, slopes });
                let (x, y) = (L::load(&x), L::load(&y));
                if group > 0 {
                    let viscous = (x * volume).sum();
                    tally.loads.push((group - 1, [-viscous, -viscous, 0.0]));
                }
                sum_x += x;
                sum_y += y;
            }
            let (vx, vy) = (lanes::<L>(&fluid.vx, at), lanes::<L>(&fluid.vy, at));
            tally.powers.push((sum_x.mul_add(vx, sum_y * vy) * volume).sum());
            let share = inverse_density * L::splat(self.steps);
            let push = lanes::<L>(acceleration_x, to);
            store(acceleration_x, to, sum_x.mul_add(share, push));
            let push = lanes::<L>(acceleration_y, to);
            store(acceleration_y, to, sum_y.mul_add(share, push));
        }
    }
}

/// The pair loop over one group: force per volume of water, along x and y, by lanes.
struct Group<'a> {
    fluid: &'a Fluid,
    records: &'a [Record],
    work: &'a Workspace,
    viscosity: f64,
    cluster: usize,
    entries: &'a [u32],
    slopes: &'a [Slopes],
}

impl Task for Group<'_> {
    type Output = [[f64; LANES]; 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [[f64; LANES]; 2] {
        let Group { fluid, records, work, viscosity, cluster, entries, slopes } = self;
        let at = cluster * LANES;
        let x = lanes::<L>(&work.scaled_x, at);
        let y = lanes::<L>(&work.scaled_y, at);
        let vx = lanes::<L>(&fluid.vx, at);
        let vy = lanes::<L>(&fluid.vy, at);
        let (mut sum_x, mut sum_y) = (L::splat(0.0), L::splat(0.0));
        for (&j, slope) in entries.iter().zip(slopes) {
            let record = &records[j as usize].0;
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
        let viscosity = L::splat(viscosity);
        [(sum_x * viscosity).to_array(), (sum_y * viscosity).to_array()]
    }
}
