//! First pair pass of a step: accelerations, and the density gradient that diffusion needs.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::{Fluid, Record};

use super::Workspace;

/// Momentum equation of Huang et al. 2019, Eq. 5, and with `GRADIENTS` the renormalised density
/// gradient of Eq. 6, the kernel sums that shifting uses, and a measure of how complete each
/// particle's support is. With `ENERGY` the viscous power is summed on its own.
///
/// Pairs are antisymmetric: m_i a_i holds V_i V_j (p_i + p_j) ∇W and, with the prefactor ρ0 in
/// place of the paper's ρ_i, V_i V_j α h c0 ρ0 π_ij ∇W.
pub(super) struct Momentum<'a, K, const GRADIENTS: bool, const CORRECTED: bool, const ENERGY: bool> {
    pub fluid: &'a Fluid,
    pub records: &'a [Record],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    /// R/2 (∂u/∂x - ∂v/∂y)/2 and R/2 (∂u/∂y + ∂v/∂x).
    pub strain: &'a [[f64; 2]],
    pub pairs: &'a PairList,
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
    pub kernel: std::marker::PhantomData<K>,
}

/// What one particle's lane holds while its neighbours pass by.
#[derive(Clone, Copy)]
struct Own<L> {
    x: L,
    y: L,
    vx: L,
    vy: L,
    /// Pressure times correction: xx, xy, yy (without correction all of it is in the first).
    pressure: [L; 3],
    diffused: L,
    strain: [L; 2],
}

/// Sums over neighbours.
#[derive(Clone, Copy)]
struct Sums<L> {
    /// Σ g (-(p_i + p_j) + viscous) Δ.
    force: [L; 2],
    /// The viscous part of it.
    viscous: [L; 2],
    /// Σ g ΔΔᵀ: xx, xy, yy.
    moment: [L; 3],
    /// Σ g Δ.
    concentration: [L; 2],
    /// Σ g (ρ_j - ρ_i) Δ.
    gradient: [L; 2],
    /// Σ g b_j Δ, b the response of a wall ghost's pressure.
    response: [L; 2],
}

impl<L: Lanes> Sums<L> {
    #[inline(always)]
    fn zero() -> Self {
        let zero = L::splat(0.0);
        Sums {
            force: [zero; 2],
            viscous: [zero; 2],
            moment: [zero; 3],
            concentration: [zero; 2],
            gradient: [zero; 2],
            response: [zero; 2],
        }
    }
}

impl<K: Kernel, const GRADIENTS: bool, const CORRECTED: bool, const ENERGY: bool> Momentum<'_, K, GRADIENTS, CORRECTED, ENERGY> {
    /// Adds the neighbours of one group. `FLUID` neighbours also count in the density gradient,
    /// `RESPONSE` ones carry a response to their wall's acceleration.
    #[inline(always)]
    fn add<L: Lanes, const FLUID: bool, const RESPONSE: bool>(
        &self,
        own: Own<L>,
        neighbours: &[u32],
        sums: &mut Sums<L>,
    ) {
        let viscosity = L::splat(self.viscosity);
        let mut force = sums.force;
        let mut viscous = sums.viscous;
        let mut moment = sums.moment;
        let mut concentration = sums.concentration;
        let mut gradient = sums.gradient;
        let mut response = sums.response;
        for &j in neighbours {
            let record = &self.records[j as usize].0;
            let dx = own.x - L::splat(record[Record::X]);
            let dy = own.y - L::splat(record[Record::Y]);
            let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
            let inverse_q = s.rsqrt();
            let g = K::slope_over_q(s, inverse_q) * L::splat(record[Record::WEIGHT]);
            let du = own.vx - L::splat(record[Record::VX]);
            let dv = own.vy - L::splat(record[Record::VY]);
            let mut approach = du.mul_add(dx, dv * dy);
            if CORRECTED {
                // Less what a linear, divergence-free velocity field would give.
                let (stretch, shear) = if FLUID {
                    let [stretch, shear] = self.strain[j as usize];
                    (own.strain[0] + L::splat(stretch), own.strain[1] + L::splat(shear))
                } else {
                    (own.strain[0] + own.strain[0], own.strain[1] + own.strain[1])
                };
                let smooth = stretch.mul_add(dx.mul_add(dx, L::splat(0.0) - dy * dy), shear * (dx * dy));
                approach = approach - smooth;
            }
            let approach = approach * (inverse_q * inverse_q);
            let factor = g * approach * viscosity;
            let [own_xx, own_xy, own_yy] = own.pressure;
            if CORRECTED {
                let (xx, xy, yy) = if FLUID {
                    (
                        own_xx + L::splat(record[Record::PRESSURE]),
                        own_xy + L::splat(record[Record::PRESSURE_XY]),
                        own_yy + L::splat(record[Record::PRESSURE_YY]),
                    )
                } else {
                    let pressure = L::splat(record[Record::PRESSURE]);
                    (own_xx + pressure, own_xy, own_yy + pressure)
                };
                let (gx, gy) = (g * dx, g * dy);
                force[0] = force[0] + factor.mul_add(dx, L::splat(0.0) - xx.mul_add(gx, xy * gy));
                force[1] = force[1] + factor.mul_add(dy, L::splat(0.0) - xy.mul_add(gx, yy * gy));
            } else {
                let pressure = own_xx + L::splat(record[Record::PRESSURE]);
                let factor = factor - g * pressure;
                force = [factor.mul_add(dx, force[0]), factor.mul_add(dy, force[1])];
            }
            if ENERGY {
                viscous = [factor.mul_add(dx, viscous[0]), factor.mul_add(dy, viscous[1])];
            }
            if GRADIENTS || CORRECTED {
                let (gx, gy) = (g * dx, g * dy);
                moment = [
                    gx.mul_add(dx, moment[0]),
                    gx.mul_add(dy, moment[1]),
                    gy.mul_add(dy, moment[2]),
                ];
                if GRADIENTS {
                    concentration = [concentration[0] + gx, concentration[1] + gy];
                }
                if GRADIENTS && FLUID {
                    let rise = L::splat(self.diffused[j as usize]) - own.diffused;
                    gradient = [rise.mul_add(gx, gradient[0]), rise.mul_add(gy, gradient[1])];
                }
            }
            if RESPONSE {
                let factor = g * L::splat(record[Record::RESPONSE]);
                response = [factor.mul_add(dx, response[0]), factor.mul_add(dy, response[1])];
            }
        }
        *sums = Sums { force, viscous, moment, concentration, gradient, response };
    }
}

impl<K: Kernel, const GRADIENTS: bool, const CORRECTED: bool, const ENERGY: bool> Task
    for Momentum<'_, K, GRADIENTS, CORRECTED, ENERGY>
{
    /// The viscous power, W per metre of width (0 without `ENERGY`).
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let work = std::mem::take(self.work);
        let mut out = work;
        out.loads.iter_mut().for_each(|load| *load = [0.0; 2]);
        out.responding.clear();
        let mut viscous_power = 0.0;
        for cluster in 0..self.pairs.clusters() {
            let at = cluster * LANES;
            let lanes = |field: &[f64]| L::load(field[at..at + LANES].first_chunk().unwrap());
            let own = Own {
                x: lanes(&out.scaled_x),
                y: lanes(&out.scaled_y),
                vx: lanes(&self.fluid.vx),
                vy: lanes(&self.fluid.vy),
                pressure: if CORRECTED {
                    let pressure = lanes(&out.pressure);
                    [&out.correction_xx, &out.correction_xy, &out.correction_yy]
                        .map(|component| pressure * lanes(component))
                } else {
                    [lanes(&out.pressure), L::splat(0.0), L::splat(0.0)]
                },
                diffused: lanes(self.diffused),
                strain: if CORRECTED {
                    let strain = &self.strain[at..at + LANES];
                    [0, 1].map(|part| L::load(&std::array::from_fn(|lane| strain[lane][part])))
                } else {
                    [L::splat(0.0); 2]
                },
            };
            let density = lanes(&self.fluid.density);
            let inverse_density = L::splat(1.0).div(density);
            let volume = lanes(&self.fluid.mass) * inverse_density;
            let mut sums = Sums::zero();
            self.add::<L, true, false>(own, self.pairs.group(cluster, 0), &mut sums);
            let fluid_moment = sums.moment;
            for body in 0..self.bodies {
                let neighbours = self.pairs.group(cluster, body + 1);
                if neighbours.is_empty() {
                    continue;
                }
                let before = sums.force[0];
                sums.force[0] = L::splat(0.0);
                if body == self.responds {
                    self.add::<L, false, true>(own, neighbours, &mut sums);
                    let response = [sums.response[0], sums.response[1]];
                    let minus = L::splat(0.0) - inverse_density;
                    out.responding.push((
                        cluster as u32,
                        (response[0] * minus).to_array(),
                        (response[1] * minus).to_array(),
                    ));
                    out.loads[body][1] -= (response[0] * volume).sum();
                } else {
                    self.add::<L, false, false>(own, neighbours, &mut sums);
                }
                // The body's reaction: minus the force of its ghosts on the water.
                out.loads[body][0] -= (sums.force[0] * volume).sum();
                sums.force[0] = before + sums.force[0];
            }
            let store = |field: &mut [f64], value: L| {
                value.store(field[at..at + LANES].first_chunk_mut().unwrap());
            };
            store(&mut out.acceleration_x, sums.force[0] * inverse_density);
            let fall = L::splat(self.gravity);
            store(&mut out.acceleration_y, sums.force[1] * inverse_density - fall);
            if ENERGY {
                let power = sums.viscous[0].mul_add(own.vx, sums.viscous[1] * own.vy);
                viscous_power += (power * volume).sum();
            }
            if GRADIENTS {
                let [gradient_x, gradient_y] = solve_symmetric(fluid_moment, sums.gradient);
                store(&mut out.gradient_x, gradient_x);
                store(&mut out.gradient_y, gradient_y);
                store(&mut out.concentration_x, sums.concentration[0]);
                store(&mut out.concentration_y, sums.concentration[1]);
            }
            if GRADIENTS || CORRECTED {
                let radius = L::splat(-self.support_radius);
                let scaled = sums.moment.map(|m| m * radius);
                let completeness = smallest_eigenvalue(scaled);
                store(&mut out.completeness, completeness);
                if CORRECTED {
                    let [xx, xy, yy] = correction(scaled, completeness);
                    store(&mut out.next_correction_xx, xx);
                    store(&mut out.next_correction_xy, xy);
                    store(&mut out.next_correction_yy, yy);
                }
            }
        }
        *self.work = out;
        viscous_power
    }
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
    const TRUSTED_FROM: f64 = 0.25;
    const TRUSTED_FULL: f64 = 0.45;
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let determinant = (xx * yy - xy * xy).max(L::splat(1e-3));
    let trust = (completeness - L::splat(TRUSTED_FROM))
        * L::splat(1.0 / (TRUSTED_FULL - TRUSTED_FROM));
    let trust = trust.max(zero).min(one);
    let share = trust.div(determinant);
    let rest = one - trust;
    [yy.mul_add(share, rest), zero - xy * share, xx.mul_add(share, rest)]
}
