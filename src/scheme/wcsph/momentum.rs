//! First pair pass of a step: accelerations, and the density gradient that diffusion needs.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::Fluid;

use super::Workspace;
use super::correction::{correction, smallest_eigenvalue, solve_symmetric};
use super::momentum_pairs::Group;
use super::parts::Part;
use super::precision::Pairing;
use super::separation::lanes;

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
/// step before (the identity without `CORRECTED`), and where it is `VISCOUS`, with the prefactor ρ0 in
/// place of the paper's ρ_i, V_i V_j α h c0 ρ0 π_ij ∇W. With `CORRECTED` π_ij holds only what a
/// linear, divergence-free velocity field leaves, limited so that every pair dissipates.
pub(super) struct Momentum<
    'a,
    K,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const VISCOUS: bool,
> {
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
    /// See [`super::correction::first_row_share`].
    pub first_row: f64,
    /// Rest density, kg/m³.
    pub density: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
    pub kernel: std::marker::PhantomData<K>,
}

/// The pass over one part.
pub(super) struct OnPart<
    'a,
    'b,
    K,
    P: Pairing,
    const SUMS: u8,
    const CORRECTED: bool,
    const VISCOUS: bool,
> {
    pub pass: &'b Momentum<'a, K, P, SUMS, CORRECTED, VISCOUS>,
    pub part: &'b mut Part,
    /// The part's rows of [`Workspace::found_mut`].
    pub found: [&'b mut [f64]; FOUND],
}

impl<K: Kernel, P: Pairing, const SUMS: u8, const CORRECTED: bool, const VISCOUS: bool> Task
    for OnPart<'_, '_, K, P, SUMS, CORRECTED, VISCOUS>
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
        tally.force_entries += pairs.len();
        responding.clear();
        for (here, cluster) in clusters.clone().enumerate() {
            // Of the water, and of the part's rows.
            let (at, to) = (cluster * LANES, here * LANES);
            let density = lanes::<L>(&pass.fluid.density, at);
            let inverse_density = L::splat(1.0).div(density);
            store(found_inverse_density, to, inverse_density);
            let volume = lanes::<L>(&pass.fluid.mass, at) * inverse_density;
            let entries = pairs.group(here, 0);
            let mut sums = L::call(Group::<_, P, SUMS, CORRECTED, VISCOUS, true, false> {
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
                    L::call(Group::<_, P, SUMS, CORRECTED, VISCOUS, false, true> {
                        pass,
                        entries,
                        room,
                        cluster,
                    })
                } else {
                    L::call(Group::<_, P, SUMS, CORRECTED, VISCOUS, false, false> {
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
            if VISCOUS {
                let (vx, vy) = (lanes::<L>(&pass.fluid.vx, at), lanes::<L>(&pass.fluid.vy, at));
                let power = viscous[0].mul_add(vx, viscous[1] * vy);
                tally.powers.push((power * volume).sum());
            }
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
                    let [xx, xy, yy] = correction(moment, completeness, of_walls, pass.first_row);
                    store(next_xx, to, xx);
                    store(next_xy, to, xy);
                    store(next_yy, to, yy);
                }
            }
        }
    }
}

#[inline(always)]
pub(super) fn store<L: Lanes>(field: &mut [f64], at: usize, value: L) {
    value.store(field[at..at + LANES].first_chunk_mut().unwrap());
}
