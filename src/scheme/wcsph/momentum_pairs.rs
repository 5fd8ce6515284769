//! The momentum pass's loop over the neighbours of eight particles.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task, Vector};

use super::Workspace;
use super::held::{AHEAD, Slopes, prefetch_first_reached};
use super::momentum::{FORCES, GRADIENTS, Momentum};
use super::pair_sums::{Running, Sums};
use super::precision::{Neighbour, Pairing};
use super::separation::{CHUNK, Geometry, Pair, eight, lanes};

/// The pair loop over one group of a cluster's neighbours: `FLUID` ones also count in the density
/// gradient, `RESPONSE` ones carry a response to their wall's acceleration.
pub(super) struct Group<
    'a,
    'b,
    K,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const VISCOUS: bool,
    const FLUID: bool,
    const RESPONSE: bool,
> {
    pub pass: &'b Momentum<'a, K, P, SUMS, CORRECTED, VISCOUS>,
    /// The listed neighbours, and room for those in reach.
    pub entries: &'b [u32],
    pub room: (&'b mut [u32], &'b mut [Slopes]),
    pub cluster: usize,
}

impl<
    K: Kernel,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const VISCOUS: bool,
    const FLUID: bool,
    const RESPONSE: bool,
> Task for Group<'_, '_, K, P, SUMS, CORRECTED, VISCOUS, FLUID, RESPONSE>
{
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sums {
        self.sums::<L, P::In<L>>()
    }
}

impl<
    K: Kernel,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const VISCOUS: bool,
    const FLUID: bool,
    const RESPONSE: bool,
> Group<'_, '_, K, P, SUMS, CORRECTED, VISCOUS, FLUID, RESPONSE>
{
    #[inline(always)]
    fn sums<L: Lanes, V: Vector>(self) -> Sums {
        let Group { pass, entries, room, cluster } = self;
        let work = pass.work;
        let at = cluster * LANES;
        let zero = V::splat(0.0);
        let places =
            P::Neighbour::places::<L, V>(eight(&work.scaled_x, at), eight(&work.scaled_y, at));
        let vx = V::load(eight(&pass.fluid.vx, at));
        let vy = V::load(eight(&pass.fluid.vy, at));
        let diffused = P::Neighbour::own_diffused::<V>(eight(pass.diffused, at), pass.density);
        let (mut own_stretch, mut own_shear) = (zero, zero);
        if CORRECTED && VISCOUS {
            let strain = pass.strain[at..at + LANES].first_chunk::<LANES>().unwrap();
            let (mut stretch, mut shear) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                [stretch[lane], shear[lane]] = strain[lane];
            }
            (own_stretch, own_shear) = (V::load(&stretch), V::load(&shear));
        }
        prefetch_first_reached::<L, _>(pass.records, entries);
        let mut turns = [Running::<V>::nothing(); 2];
        let mut geometry = Geometry::new();
        let (held, slopes) = room;
        let mut count = 0;
        for chunk in entries.chunks(CHUNK) {
            let in_reach = geometry.fill::<K, P::Neighbour, FLUID>(places, chunk, pass.records);
            for (turn, kept) in turns.iter_mut().take(V::TURNS).enumerate() {
                // Plain local variables throughout: they stay in registers, arrays of them may not.
                let Running {
                    push: (mut push_x, mut push_y),
                    viscous: (mut viscous_x, mut viscous_y),
                    moment: (mut moment_xx, mut moment_xy, mut moment_yy),
                    concentration: (mut concentration_x, mut concentration_y),
                    gradient: (mut gradient_x, mut gradient_y),
                    response: (mut response_x, mut response_y),
                } = *kept;
                let mut place = count + turn;
                for (number, pair) in in_reach.turn(turn) {
                    let number = chunk[number];
                    let Pair { dx, dy, divisor, slope: g } = pair;
                    held[place] = number;
                    L::prefetch(&slopes[place], AHEAD);
                    g.store_single(&mut slopes[place].0);
                    place += V::TURNS;
                    let other = &pass.records[number as usize];
                    let gx = g * dx;
                    let gy = g * dy;
                    if VISCOUS {
                        let [their_vx, their_vy] = other.velocity::<V>();
                        let (du, dv) = (vx - their_vx, vy - their_vy);
                        let mut approach = du.mul_add(dx, dv * dy);
                        if CORRECTED {
                            // Less what a linear, divergence-free velocity field would give.
                            let (stretch, shear) = if FLUID {
                                let [stretch, shear] = other.strain::<V>(pass.strain, number);
                                (own_stretch + stretch, own_shear + shear)
                            } else {
                                (own_stretch + own_stretch, own_shear + own_shear)
                            };
                            let apart = dx.mul_sub(dx, dy * dy);
                            let rest = (dx * dy).negated_mul_add(shear, approach);
                            let rest = apart.negated_mul_add(stretch, rest);
                            // Between nothing and all of it: every pair then dissipates.
                            let (low, high) = (approach.min(zero), approach.max(zero));
                            approach = rest.min(high).max(low);
                        }
                        let drag = approach.over(divisor);
                        viscous_x = drag.mul_add(gx, viscous_x);
                        viscous_y = drag.mul_add(gy, viscous_y);
                    }
                    let [xx, xy, yy] = other.pressure::<V>();
                    push_x = xx.mul_add(gx, push_x);
                    if CORRECTED {
                        push_x = xy.mul_add(gy, push_x);
                        push_y = xy.mul_add(gx, push_y);
                    }
                    push_y = yy.mul_add(gy, push_y);
                    concentration_x = concentration_x + gx.widened();
                    concentration_y = concentration_y + gy.widened();
                    if SUMS > FORCES || CORRECTED {
                        moment_xx = gx.mul_add(dx, moment_xx);
                        moment_xy = gx.mul_add(dy, moment_xy);
                        moment_yy = gy.mul_add(dy, moment_yy);
                    }
                    if SUMS == GRADIENTS && FLUID {
                        let theirs = other.diffused::<V>(pass.diffused, number);
                        let rise = theirs - diffused;
                        gradient_x = rise.mul_add(gx, gradient_x);
                        gradient_y = rise.mul_add(gy, gradient_y);
                    }
                    if RESPONSE {
                        let [xx, xy, yy] = pass.responses[number as usize - pass.first_ghost];
                        let (xx, xy, yy) = (V::splat(xx), V::splat(xy), V::splat(yy));
                        response_x = xy.mul_add(gy, xx.mul_add(gx, response_x));
                        response_y = yy.mul_add(gy, xy.mul_add(gx, response_y));
                    }
                }
                *kept = Running {
                    push: (push_x, push_y),
                    viscous: (viscous_x, viscous_y),
                    moment: (moment_xx, moment_xy, moment_yy),
                    concentration: (concentration_x, concentration_y),
                    gradient: (gradient_x, gradient_y),
                    response: (response_x, response_y),
                };
            }
            count += in_reach.len();
        }
        let mut sums = Running::sums(turns, count);
        let [near_x, near_y] = &sums.concentration;
        let near = [L::load(near_x), L::load(near_y)];
        let [own_x, own_y] = own_push::<L, CORRECTED>(work, at, near);
        let (zero, viscosity) = (L::splat(0.0), L::splat(pass.viscosity));
        for (push, own) in sums.push.iter_mut().zip([own_x, own_y]) {
            *push = (zero - L::load(push) - own).to_array();
        }
        for viscous in &mut sums.viscous {
            *viscous = (L::load(viscous) * viscosity).to_array();
        }
        sums
    }
}

/// p_i L_i Σ g Δ: a particle's own part of the pressure sum.
#[inline(always)]
pub(super) fn own_push<L: Lanes, const CORRECTED: bool>(
    work: &Workspace,
    at: usize,
    [x, y]: [L; 2],
) -> [L; 2] {
    let pressure = lanes::<L>(&work.pressure, at);
    if !CORRECTED {
        return [pressure * x, pressure * y];
    }
    let xx = lanes::<L>(&work.correction_xx, at);
    let xy = lanes::<L>(&work.correction_xy, at);
    let yy = lanes::<L>(&work.correction_yy, at);
    [pressure * xx.mul_add(x, xy * y), pressure * xy.mul_add(x, yy * y)]
}
