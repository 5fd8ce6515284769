//! First pair pass of a step: accelerations, and the density gradient that diffusion needs.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::Fluid;

use super::Workspace;
use super::correction::{correction, smallest_eigenvalue, solve_symmetric};
use super::held::{AHEAD, Slopes};
use super::parts::Part;
use super::precision::{Neighbour, Pairing};
use super::separation::{CHUNK, Geometry, Pair, lanes};

/// How many fields the pass writes.
pub(super) const FOUND: usize = 11;
/// Forces alone.
pub(super) const FORCES: u8 = 0;
/// Also the kernel sums that shifting uses.
pub(super) const CONCENTRATION: u8 = 1;
/// Also the renormalised density gradient.
pub(super) const GRADIENTS: u8 = 2;

/// Momentum equation of Huang et al. 2019, Eq. 5, and what else `SUMS` asks for: the
/// kernel sums that shifting uses with a measure of how complete each particle's support is, and
/// the renormalised density gradient of Eq. 6. What the other passes over the same pairs need of
/// their geometry is left in each part's held pairs.
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
    /// What is not written: see [`Workspace::found_mut`].
    pub work: &'a Workspace,
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
    /// The listed neighbours, and room for those in reach.
    entries: &'b [u32],
    room: (&'b mut [u32], &'b mut [Slopes]),
    cluster: usize,
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
        let Group { pass, entries, room, cluster } = self;
        let work = pass.work;
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
        let (held, slopes) = room;
        let mut count = 0;
        for chunk in entries.chunks(CHUNK) {
            let in_reach = geometry.fill::<K, P::Neighbour, FLUID>(places, chunk, pass.records);
            for (k, pair) in in_reach {
                let j = chunk[k];
                held[count] = j;
                L::prefetch(&slopes[count], AHEAD);
                pair.slope.store_single(&mut slopes[count].0);
                count += 1;
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

/// The pass over one part.
pub(super) struct OnPart<'a, 'b, K, P: Pairing, const SUMS: u8, const CORRECTED: bool> {
    pub pass: &'b Momentum<'a, K, P, SUMS, CORRECTED>,
    pub part: &'b mut Part,
    /// The part's rows of [`Workspace::found_mut`].
    pub found: [&'b mut [f64]; FOUND],
}

impl<K: Kernel, P: Pairing, const SUMS: u8, const CORRECTED: bool> Task
    for OnPart<'_, '_, K, P, SUMS, CORRECTED>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let OnPart { pass, part, found } = self;
        let Part { clusters, pairs, held, near, responding, tally } = part;
        let [
            found_inverse_density,
            acceleration_x,
            acceleration_y,
            found_gradient_x,
            found_gradient_y,
            concentration_x,
            concentration_y,
            found_completeness,
            next_xx,
            next_xy,
            next_yy,
        ] = found;
        held.restart(pass.bodies + 1);
        near.clear();
        tally.clear();
        responding.clear();
        for (here, cluster) in clusters.clone().enumerate() {
            // Of the water, and of the part's rows.
            let (at, to) = (cluster * LANES, here * LANES);
            let density = lanes::<L>(&pass.fluid.density, at);
            let inverse_density = L::splat(1.0).div(density);
            store(found_inverse_density, to, inverse_density);
            let volume = lanes::<L>(&pass.fluid.mass, at) * inverse_density;
            let entries = pairs.group(here, 0);
            let mut sums = P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, true, false> {
                pass,
                entries,
                room: held.room(entries.len()),
                cluster,
            });
            held.close(sums.count);
            let water_moment = sums.moment;
            for body in 0..pass.bodies {
                let entries = pairs.group(here, body + 1);
                if entries.is_empty() {
                    held.close(0);
                    continue;
                }
                let room = held.room(entries.len());
                let more = if body == pass.responds {
                    P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, false, true> {
                        pass,
                        entries,
                        room,
                        cluster,
                    })
                } else {
                    P::In::<L>::call(Group::<_, P, SUMS, CORRECTED, false, false> {
                        pass,
                        entries,
                        room,
                        cluster,
                    })
                };
                held.close(more.count);
                if more.count > 0 {
                    near.push(more.concentration);
                }
                sums.add(&more);
                // The body's reaction: minus the force of its ghosts on the water.
                let viscous = (L::load(&more.viscous[0]) * volume).sum();
                let force = viscous + (L::load(&more.push[0]) * volume).sum();
                let mut added_mass = 0.0;
                if body == pass.responds {
                    let minus = L::splat(0.0) - inverse_density;
                    let (x, y) = (L::load(&more.response[0]), L::load(&more.response[1]));
                    added_mass = (x * volume).sum();
                    let response = ((x * minus).to_array(), (y * minus).to_array());
                    responding.push((cluster as u32, response.0, response.1));
                }
                tally.loads.push((body, [-force, -viscous, -added_mass]));
            }
            let viscous = [L::load(&sums.viscous[0]), L::load(&sums.viscous[1])];
            // All that viscosity does until the next full step, it does now.
            let steps = L::splat(pass.steps);
            let force_x = viscous[0].mul_add(steps, L::load(&sums.push[0]));
            let force_y = viscous[1].mul_add(steps, L::load(&sums.push[1]));
            let fall = L::splat(pass.gravity);
            store(acceleration_x, to, force_x * inverse_density);
            store(acceleration_y, to, force_y.mul_sub(inverse_density, fall));
            let (vx, vy) = (lanes::<L>(&pass.fluid.vx, at), lanes::<L>(&pass.fluid.vy, at));
            let power = viscous[0].mul_add(vx, viscous[1] * vy);
            tally.powers.push((power * volume).sum());
            if SUMS == GRADIENTS {
                let [xx, xy, yy] = &water_moment;
                let moment = [L::load(xx), L::load(xy), L::load(yy)];
                let sum = [L::load(&sums.gradient[0]), L::load(&sums.gradient[1])];
                let [gradient_x, gradient_y] = solve_symmetric(moment, sum);
                store(found_gradient_x, to, gradient_x);
                store(found_gradient_y, to, gradient_y);
            }
            store(concentration_x, to, L::load(&sums.concentration[0]));
            store(concentration_y, to, L::load(&sums.concentration[1]));
            if SUMS > FORCES || CORRECTED {
                let radius = L::splat(-pass.support_radius);
                let [xx, xy, yy] = &sums.moment;
                let moment = [L::load(xx) * radius, L::load(xy) * radius, L::load(yy) * radius];
                let completeness = smallest_eigenvalue(moment);
                store(found_completeness, to, completeness);
                if CORRECTED {
                    let [of_water_xx, _, of_water_yy] = &water_moment;
                    let of_water = (L::load(of_water_xx) + L::load(of_water_yy)) * radius;
                    let of_walls = moment[0] + moment[2] - of_water;
                    let [xx, xy, yy] = correction(moment, completeness, of_walls);
                    store(next_xx, to, xx);
                    store(next_xy, to, xy);
                    store(next_yy, to, yy);
                }
            }
        }
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
