//! The pair pass of an acoustic step: pressure forces over pairs whose geometry is held.

use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::Fluid;

use super::Workspace;
use super::factors::Factors;
use super::held::Product;
use super::momentum::store;
use super::momentum_pairs::own_push;
use super::parts::Part;
use super::separation::lanes;

/// The pressure part of the momentum equation with new pressures, at the places, volumes and
/// corrections of the last full pass. The loads of viscosity and the response to the wall's
/// acceleration are those of that pass; the water has had viscosity's whole impulse in it.
///
/// Factors of a neighbour, with P = p L its pressure times its correction: P_xx, P_xy, P_yy,
/// (P r)_x, (P r)_y.
pub(super) struct Acoustic<'a, const CORRECTED: bool> {
    pub fluid: &'a Fluid,
    pub factors: &'a [Factors],
    pub part: &'a mut Part,
    pub work: &'a Workspace,
    /// The part's rows: accelerations along x and y.
    pub acceleration: [&'a mut [f64]; 2],
    /// Number of bodies: groups 1.. of the pairs.
    pub bodies: usize,
    /// Gravity, m/s².
    pub gravity: f64,
}

impl<const CORRECTED: bool> Task for Acoustic<'_, CORRECTED> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Acoustic { fluid, factors, part, work, acceleration, bodies, gravity } = self;
        let Part { clusters, held: pairs, near, tally, .. } = part;
        let mut near = near.iter();
        let [acceleration_x, acceleration_y] = acceleration;
        tally.loads.clear();
        tally.force_entries += pairs.len();
        for (here, cluster) in clusters.clone().enumerate() {
            let (at, to) = (cluster * LANES, here * LANES);
            let x = lanes::<L>(&work.scaled_x, at);
            let y = lanes::<L>(&work.scaled_y, at);
            let inverse_density = lanes::<L>(&work.inverse_density, at);
            let sums = L::call(Product::<5> { pairs, factors, cluster: here, group: 0 });
            let [mut push_x, mut push_y] = pressed([x, y], &sums);
            for body in 0..bodies {
                let group = body + 1;
                if pairs.group(here, group).0.is_empty() {
                    continue;
                }
                let sums = L::call(Product::<5> { pairs, factors, cluster: here, group });
                let [more_x, more_y] = pressed([x, y], &sums);
                push_x += more_x;
                push_y += more_y;
                // The body bears the particles' own part of these pairs, too.
                let [near_x, near_y] = near.next().unwrap();
                let near = [L::load(near_x), L::load(near_y)];
                let [own_x, _] = own_push::<L, CORRECTED>(work, at, near);
                let volume = lanes::<L>(&fluid.mass, at) * inverse_density;
                let force = ((more_x + own_x) * volume).sum();
                tally.loads.push((body, [force, 0.0, 0.0]));
            }
            let all = [lanes(&work.concentration_x, at), lanes(&work.concentration_y, at)];
            let [own_x, own_y] = own_push::<L, CORRECTED>(work, at, all);
            let (still, fall) = (L::splat(0.0), L::splat(-gravity));
            let push_x = (push_x + own_x).negated_mul_add(inverse_density, still);
            let push_y = (push_y + own_y).negated_mul_add(inverse_density, fall);
            store(acceleration_x, to, push_x);
            store(acceleration_y, to, push_y);
        }
    }
}

/// Σ g P_j (r_i - r_j), from the sums over P and P r.
#[inline(always)]
fn pressed<L: Lanes>([x, y]: [L; 2], [xx, xy, yy, at_x, at_y]: &[[f64; LANES]; 5]) -> [L; 2] {
    let (xx, xy, yy) = (L::load(xx), L::load(xy), L::load(yy));
    let push_x = x.mul_sub(xx, L::load(at_x));
    let push_y = x.mul_sub(xy, L::load(at_y));
    [y.mul_add(xy, push_x), y.mul_add(yy, push_y)]
}
