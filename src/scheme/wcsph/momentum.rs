//! First pair pass of a step: accelerations, and the density gradient that diffusion needs.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::Fluid;

use super::Workspace;
use super::held::{HeldPairs, Slopes};
use super::precision::{Neighbour, Pairing};
use super::separation::{CHUNK, Geometry, Pair, lanes};

/// Forces alone.
pub(super) const FORCES: u8 = 0;
/// Also the kernel sums that shifting uses.
pub(super) const CONCENTRATION: u8 = 1;
/// Also the renormalised density gradient.
pub(super) const GRADIENTS: u8 = 2;

/// Momentum equation of Huang et al. 2019, Eq. 5, and what else `SUMS` asks for: the
/// kernel sums that shifting uses with a measure of how complete each particle's support is, and
/// the renormalised density gradient of Eq. 6. What the other passes over the same pairs need of
/// their geometry is left in `held`.
///
/// Pairs are antisymmetric: m_i a_i holds -V_i V_j (p_i L_i + p_j L_j) ∇W, L the correction of one
/// step before (the identity without `CORRECTED`), and, with the prefactor ρ0 in place of the
/// paper's ρ_i, V_i V_j α h c0 ρ0 π_ij ∇W. With `CORRECTED` π_ij holds only what a linear,
/// divergence-free velocity field leaves, limited so that every pair dissipates.
pub(super) struct Momentum<'a, K, P: Pairing, const SUMS: u8, const CORRECTED: bool> {
    pub fluid: &'a Fluid,
    pub records: &'a [P::Neighbour],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    /// R/2 (∂u/∂x - ∂v/∂y)/2 and R/2 (∂u/∂y + ∂v/∂x).
    pub strain: &'a [[f64; 2]],
    /// Responses of the ghosts' pressures to their wall's acceleration: xx, xy, yy.
    pub responses: &'a [[f64; 3]],
    /// Number of the first ghost among the records.
    pub first_ghost: usize,
    pub pairs: &'a PairList,
    /// The pairs in reach, found here.
    pub held: &'a mut HeldPairs,
    pub work: &'a mut Workspace,
    /// Number of bodies: groups 1.. of the list.
    pub bodies: usize,
    /// Body whose ghosts respond to its acceleration.
    pub responds: usize,
    /// α h c0 ρ0 / R.
    pub viscosity: f64,
    /// R, metres.
    pub support_radius: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
    pub kernel: std::marker::PhantomData<K>,
}

/// Sums over the neighbours of one cluster in one group, a value per lane.
#[derive(Clone, Copy)]
struct Sums {
    /// -Σ g (p_i + p_j) Δ.
    push: [[f64; LANES]; 2],
    /// Σ g drag Δ.
    viscous: [[f64; LANES]; 2],
    /// Σ g ΔΔᵀ: xx, xy, yy.
    moment: [[f64; LANES]; 3],
    /// Σ g Δ.
    concentration: [[f64; LANES]; 2],
    /// Σ g (ρ_j - ρ_i) Δ, of fluid neighbours.
    gradient: [[f64; LANES]; 2],
    /// Σ g b_j Δ, b the response of a wall ghost's pressure.
    response: [[f64; LANES]; 2],
    /// Pairs in reach.
    count: usize,
}

impl Sums {
    fn add(&mut self, other: &Sums) {
        let add = |into: &mut [[f64; LANES]], from: &[[f64; LANES]]| {
            for (a, b) in into.as_flattened_mut().iter_mut().zip(from.as_flattened()) {
                *a += b;
            }
        };
        add(&mut self.push, &other.push);
        add(&mut self.viscous, &other.viscous);
        add(&mut self.moment, &other.moment);
        add(&mut self.concentration, &other.concentration);
    }
}

/// The pair loop over one group of a cluster's neighbours: `FLUID` ones also count in the density
/// gradient, `RESPONSE` ones carry a response to their wall's acceleration.
struct Group<
    'a,
    'b,
    K,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const FLUID: bool,
    const RESPONSE: bool,
> {
    pass: &'b Momentum<'a, K, P, SUMS, CORRECTED>,
    work: &'b Workspace,
    room: (&'b mut [u32], &'b mut [Slopes]),
    cluster: usize,
    group: usize,
}

impl<
    K: Kernel,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const FLUID: bool,
    const RESPONSE: bool,
> Task for Group<'_, '_, K, P, SUMS, CORRECTED, FLUID, RESPONSE>
{
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sums {
        let Group { pass, work, room, cluster, group } = self;
        let at = cluster * LANES;
        let zero = L::splat(0.0);
        let x = work.scaled_x[at..at + LANES].first_chunk().unwrap();
        let y = work.scaled_y[at..at + LANES].first_chunk().unwrap();
        let places = P::Neighbour::places::<L>(x, y);
        let vx = lanes::<L>(&pass.fluid.vx, at);
        let vy = lanes::<L>(&pass.fluid.vy, at);
        let diffused = lanes::<L>(pass.diffused, at);
        let (mut own_stretch, mut own_shear) = (zero, zero);
        if CORRECTED {
            let strain = pass.strain[at..at + LANES].first_chunk::<LANES>().unwrap();
            let (mut stretch, mut shear) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                [stretch[lane], shear[lane]] = strain[lane];
            }
            (own_stretch, own_shear) = (L::load(&stretch), L::load(&shear));
        }
        // Plain local variables throughout: they stay in registers, arrays of lanes may not.
        let (mut push_x, mut push_y) = (zero, zero);
        let (mut viscous_x, mut viscous_y) = (zero, zero);
        let (mut moment_xx, mut moment_xy, mut moment_yy) = (zero, zero, zero);
        let (mut concentration_x, mut concentration_y) = (zero, zero);
        let (mut gradient_x, mut gradient_y) = (zero, zero);
        let (mut response_x, mut response_y) = (zero, zero);
        let mut geometry = Geometry::new();
        let entries = pass.pairs.group(cluster, group);
        let (held, slopes) = room;
        let mut count = 0;
        for chunk in entries.chunks(CHUNK) {
            let room = (&mut held[count..], &mut slopes[count..]);
            let geometry =
                geometry.fill::<K, P::Neighbour, FLUID>(places, chunk, pass.records, room);
            let in_reach = &held[count..];
            count += geometry.len();
            for (&j, pair) in in_reach.iter().zip(geometry) {
                let record = &pass.records[j as usize];
                let Pair { dx, dy, inverse_s, slope: g } = *pair;
                let [record_vx, record_vy] = record.velocity::<L>();
                let (du, dv) = (vx - record_vx, vy - record_vy);
                let mut approach = du.mul_add(dx, dv * dy);
                if CORRECTED {
                    // Less what a linear, divergence-free velocity field would give.
                    let (stretch, shear) = if FLUID {
                        let [stretch, shear] = record.strain(&pass.strain[j as usize]);
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
                let gx = g * dx;
                let gy = g * dy;
                let drag = approach * inverse_s;
                viscous_x = drag.mul_add(gx, viscous_x);
                viscous_y = drag.mul_add(gy, viscous_y);
                let [xx, xy, yy] = record.pressure::<L>();
                push_x = xx.mul_add(gx, push_x);
                if CORRECTED {
                    push_x = xy.mul_add(gy, push_x);
                    push_y = xy.mul_add(gx, push_y);
                }
                push_y = yy.mul_add(gy, push_y);
                concentration_x += gx;
                concentration_y += gy;
                if SUMS > FORCES || CORRECTED {
                    moment_xx = gx.mul_add(dx, moment_xx);
                    moment_xy = gx.mul_add(dy, moment_xy);
                    moment_yy = gy.mul_add(dy, moment_yy);
                }
                if SUMS == GRADIENTS && FLUID {
                    let rise = L::splat(pass.diffused[j as usize]) - diffused;
                    gradient_x = rise.mul_add(gx, gradient_x);
                    gradient_y = rise.mul_add(gy, gradient_y);
                }
                if RESPONSE {
                    let [xx, xy, yy] = pass.responses[j as usize - pass.first_ghost];
                    let (xx, xy, yy) = (L::splat(xx), L::splat(xy), L::splat(yy));
                    response_x = xy.mul_add(gy, xx.mul_add(gx, response_x));
                    response_y = yy.mul_add(gy, xy.mul_add(gx, response_y));
                }
            }
        }
        let concentration = [concentration_x, concentration_y];
        let own = own_push::<L, CORRECTED>(work, at, concentration);
        let viscosity = L::splat(pass.viscosity);
        Sums {
            push: [(zero - push_x - own[0]).to_array(), (zero - push_y - own[1]).to_array()],
            viscous: [(viscous_x * viscosity).to_array(), (viscous_y * viscosity).to_array()],
            moment: [moment_xx.to_array(), moment_xy.to_array(), moment_yy.to_array()],
            concentration: [concentration_x.to_array(), concentration_y.to_array()],
            gradient: [gradient_x.to_array(), gradient_y.to_array()],
            response: [response_x.to_array(), response_y.to_array()],
            count,
        }
    }
}

impl<K: Kernel, P: Pairing, const SUMS: u8, const CORRECTED: bool> Task
    for Momentum<'_, K, P, SUMS, CORRECTED>
{
    /// The viscous power, W per metre of width.
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut out = std::mem::take(self.work);
        let mut held = std::mem::take(self.held);
        held.restart(self.bodies + 1);
        out.loads.iter_mut().for_each(|load| *load = [0.0; 2]);
        out.held_loads.iter_mut().for_each(|load| *load = 0.0);
        out.responding.clear();
        let mut viscous_power = 0.0;
        for cluster in 0..self.pairs.clusters() {
            let at = cluster * LANES;
            let density = lanes::<L>(&self.fluid.density, at);
            let inverse_density = L::splat(1.0).div(density);
            store(&mut out.inverse_density, at, inverse_density);
            let volume = lanes::<L>(&self.fluid.mass, at) * inverse_density;
            let mut sums = P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, true, false> {
                pass: &self,
                work: &out,
                room: held.room(self.pairs.group(cluster, 0).len()),
                cluster,
                group: 0,
            });
            held.close(sums.count);
            let fluid_moment = sums.moment;
            for body in 0..self.bodies {
                let group = body + 1;
                let listed = self.pairs.group(cluster, group).len();
                if listed == 0 {
                    held.close(0);
                    continue;
                }
                let (pass, work, room) = (&self, &out, held.room(listed));
                let more = if body == self.responds {
                    P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, false, true> {
                        pass,
                        work,
                        room,
                        cluster,
                        group,
                    })
                } else {
                    P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, false, false> {
                        pass,
                        work,
                        room,
                        cluster,
                        group,
                    })
                };
                held.close(more.count);
                sums.add(&more);
                // The body's reaction: minus the force of its ghosts on the water.
                let held = (L::load(&more.viscous[0]) * volume).sum();
                out.held_loads[body] -= held;
                out.loads[body][0] -= held + (L::load(&more.push[0]) * volume).sum();
                if body == self.responds {
                    let minus = L::splat(0.0) - inverse_density;
                    let (x, y) = (L::load(&more.response[0]), L::load(&more.response[1]));
                    out.loads[body][1] -= (x * volume).sum();
                    let response = ((x * minus).to_array(), (y * minus).to_array());
                    out.responding.push((cluster as u32, response.0, response.1));
                }
            }
            let viscous = [L::load(&sums.viscous[0]), L::load(&sums.viscous[1])];
            // All that viscosity does until the next full step, it does now.
            let steps = L::splat(self.steps);
            let force_x = viscous[0].mul_add(steps, L::load(&sums.push[0]));
            let force_y = viscous[1].mul_add(steps, L::load(&sums.push[1]));
            let fall = L::splat(self.gravity);
            store(&mut out.acceleration_x, at, force_x * inverse_density);
            store(&mut out.acceleration_y, at, force_y.mul_sub(inverse_density, fall));
            let (vx, vy) = (lanes::<L>(&self.fluid.vx, at), lanes::<L>(&self.fluid.vy, at));
            let power = viscous[0].mul_add(vx, viscous[1] * vy);
            viscous_power += (power * volume).sum();
            if SUMS == GRADIENTS {
                let [xx, xy, yy] = &fluid_moment;
                let moment = [L::load(xx), L::load(xy), L::load(yy)];
                let sum = [L::load(&sums.gradient[0]), L::load(&sums.gradient[1])];
                let [gradient_x, gradient_y] = solve_symmetric(moment, sum);
                store(&mut out.gradient_x, at, gradient_x);
                store(&mut out.gradient_y, at, gradient_y);
            }
            store(&mut out.concentration_x, at, L::load(&sums.concentration[0]));
            store(&mut out.concentration_y, at, L::load(&sums.concentration[1]));
            if SUMS > FORCES || CORRECTED {
                let radius = L::splat(-self.support_radius);
                let [xx, xy, yy] = &sums.moment;
                let moment = [L::load(xx) * radius, L::load(xy) * radius, L::load(yy) * radius];
                let completeness = smallest_eigenvalue(moment);
                store(&mut out.completeness, at, completeness);
                if CORRECTED {
                    let [xx, xy, yy] = correction(moment, completeness);
                    store(&mut out.next_correction_xx, at, xx);
                    store(&mut out.next_correction_xy, at, xy);
                    store(&mut out.next_correction_yy, at, yy);
                }
            }
        }
        *self.work = out;
        *self.held = held;
        viscous_power
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

#[inline(always)]
pub(super) fn store<L: Lanes>(field: &mut [f64], at: usize, value: L) {
    value.store(field[at..at + LANES].first_chunk_mut().unwrap());
}

/// R ∇ρ = A⁻¹ Σ g (ρ_j - ρ_i) Δ with A = -Σ g ΔΔᵀ taken positive: signs cancel. Where fewer than
/// three particles span the plane A is singular and the gradient is left at zero.
#[inline(always)]
fn solve_symmetric<L: Lanes>([xx, xy, yy]: [L; 3], [bx, by]: [L; 2]) -> [L; 2] {
    let zero = L::splat(0.0);
    let determinant = xx * yy - xy * xy;
    let trace = xx + yy;
    let floor = trace * trace * L::splat(1e-4);
    let safe = determinant.max(floor.max(L::splat(1e-300)));
    let usable = |value: L| floor.select_less(determinant, value, zero);
    // A Δ-sum of the same sign convention on both sides: minus signs cancel except one.
    let x = (yy * bx - xy * by).div(safe);
    let y = (xx * by - xy * bx).div(safe);
    [usable(zero - x), usable(zero - y)]
}

/// Smallest eigenvalue of a symmetric matrix: 1 inside the water, 0 for a lone particle.
#[inline(always)]
fn smallest_eigenvalue<L: Lanes>([xx, xy, yy]: [L; 3]) -> L {
    let half = L::splat(0.5);
    let (mean, apart) = ((xx + yy) * half, (xx - yy) * half);
    let radius = apart.mul_add(apart, xy * xy).max(L::splat(1e-300)).sqrt();
    mean - radius
}

/// Inverse of Σ V (x_j - x_i) ⊗ ∇W, fading to the identity where the support is too incomplete
/// for the inverse to be trusted.
#[inline(always)]
fn correction<L: Lanes>([xx, xy, yy]: [L; 3], completeness: L) -> [L; 3] {
    const TRUSTED_FROM: f64 = 0.35;
    const TRUSTED_FULL: f64 = 0.48;
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let determinant = (xx * yy - xy * xy).max(L::splat(1e-3));
    let trust =
        (completeness - L::splat(TRUSTED_FROM)) * L::splat(1.0 / (TRUSTED_FULL - TRUSTED_FROM));
    let trust = trust.max(zero).min(one);
    let share = trust.div(determinant);
    let rest = one - trust;
    [yy.mul_add(share, rest), zero - xy * share, xx.mul_add(share, rest)]
}
