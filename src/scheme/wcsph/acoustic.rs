//! The pair pass of an acoustic step: pressure forces over pairs whose geometry is held.

use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::{Fluid, Record};

use super::Workspace;
use super::momentum::{own_push, store};
use super::separation::{Slopes, lanes};

/// The pressure part of the momentum equation with new pressures, at the places, volumes and
/// corrections of the last full pass. The loads of viscosity and the response to the wall's
/// acceleration are those of that pass; the water has had viscosity's whole impulse in it.
pub(super) struct Acoustic<'a, const CORRECTED: bool> {
    pub fluid: &'a Fluid,
    pub records: &'a [Record],
    pub pairs: &'a PairList,
    /// What the last full pass has left of the pairs' geometry.
    pub slopes: &'a [Slopes],
    pub work: &'a mut Workspace,
    /// Number of bodies: groups 1.. of the list.
    pub bodies: usize,
    /// Gravity, m/s².
    pub gravity: f64,
}

impl<const CORRECTED: bool> Task for Acoustic<'_, CORRECTED> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let mut out = std::mem::take(self.work);
        for body in 0..self.bodies {
            out.loads[body][0] = out.held_loads[body];
        }
        for cluster in 0..self.pairs.clusters() {
            let at = cluster * LANES;
            let inverse_density = lanes::<L>(&out.inverse_density, at);
            let sums = L::call(Group { pass: &self, work: &out, cluster, group: 0 });
            let (mut push_x, mut push_y) = (L::load(&sums.push[0]), L::load(&sums.push[1]));
            for body in 0..self.bodies {
                let group = body + 1;
                if self.pairs.group(cluster, group).is_empty() {
                    continue;
                }
                let more = L::call(Group { pass: &self, work: &out, cluster, group });
                let more = [L::load(&more.push[0]), L::load(&more.push[1])];
                let volume = lanes::<L>(&self.fluid.mass, at) * inverse_density;
                out.loads[body][0] += (more[0] * volume).sum();
                push_x += more[0];
                push_y += more[1];
            }
            let (still, fall) = (L::splat(0.0), L::splat(-self.gravity));
            store(&mut out.acceleration_x, at, push_x.negated_mul_add(inverse_density, still));
            store(&mut out.acceleration_y, at, push_y.negated_mul_add(inverse_density, fall));
        }
        *self.work = out;
    }
}

/// Sums over the neighbours of one cluster in one group, a value per lane.
struct Sums {
    /// Σ g (p_i + p_j) Δ.
    push: [[f64; LANES]; 2],
}

/// The pair loop over one group.
struct Group<'a, 'b, const CORRECTED: bool> {
    pass: &'b Acoustic<'a, CORRECTED>,
    work: &'b Workspace,
    cluster: usize,
    group: usize,
}

impl<const CORRECTED: bool> Task for Group<'_, '_, CORRECTED> {
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sums {
        let Group { pass, work, cluster, group } = self;
        let at = cluster * LANES;
        let zero = L::splat(0.0);
        let x = lanes::<L>(&work.scaled_x, at);
        let y = lanes::<L>(&work.scaled_y, at);
        let (mut xx, mut xy, mut yx, mut yy) = (zero, zero, zero, zero);
        let (mut near_x, mut near_y) = (zero, zero);
        let entries = pass.pairs.group(cluster, group);
        let slopes = &pass.slopes[pass.pairs.range(cluster, group)];
        for (&j, slope) in entries.iter().zip(slopes) {
            let record = &pass.records[j as usize].0;
            let g = L::load_single(&slope.0);
            let gx = g * (x - L::splat(record[Record::X]));
            let gy = g * (y - L::splat(record[Record::Y]));
            let pressure = L::splat(record[Record::PRESSURE]);
            xx = pressure.mul_add(gx, xx);
            if CORRECTED {
                let cross = L::splat(record[Record::PRESSURE_XY]);
                xy = cross.mul_add(gy, xy);
                yx = cross.mul_add(gx, yx);
                yy = L::splat(record[Record::PRESSURE_YY]).mul_add(gy, yy);
            } else {
                yy = pressure.mul_add(gy, yy);
            }
            near_x += gx;
            near_y += gy;
        }
        let own = own_push::<L, CORRECTED>(work, at, [near_x, near_y]);
        Sums { push: [(xx + xy + own[0]).to_array(), (yx + yy + own[1]).to_array()] }
    }
}
