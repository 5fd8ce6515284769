//! Second pair pass of a step: rates of change of density.

use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::{Fluid, Record};

use super::Workspace;
use super::momentum::store;
use super::separation::{Slopes, lanes};

/// No density diffusion.
pub(super) const OFF: u8 = 0;
/// ψ_ij = 2 (ψ_j - ψ_i) x_ji/|x_ji|², of ψ = ρ or of ψ = ρ_s (ln(ρ/ρ_s) + g y/c0²).
pub(super) const PLAIN: u8 = 1;
/// The same less the mean renormalised gradient.
pub(super) const RENORMALISED: u8 = 2;
/// Like `PLAIN`, faded out towards the free surface on both sides of a pair.
pub(super) const FADED: u8 = 3;

/// Continuity equation of Huang et al. 2019, Eq. 5, with the new velocities at the old places.
///
/// With `CORRECTED` the divergence is Σ V_j (u_i - u_j)·L_i ∇W, the adjoint of the momentum
/// equation's form, with the same L. Ghosts take part in it, not in the diffusion: no density flows
/// through a wall.
pub(super) struct Continuity<'a, const DIFFUSION: u8, const CORRECTED: bool> {
    pub fluid: &'a Fluid,
    pub records: &'a [Record],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    pub pairs: &'a PairList,
    /// What the momentum pass has left of the pairs' geometry.
    pub slopes: &'a [Slopes],
    pub strain: &'a mut [[f64; 2]],
    pub work: &'a mut Workspace,
    pub support_radius: f64,
    pub bodies: usize,
    /// δ h c0 / R.
    pub diffusion: f64,
    /// Whether the power of diffusion is wanted.
    pub sample: bool,
}

impl<const DIFFUSION: u8, const CORRECTED: bool> Task for Continuity<'_, DIFFUSION, CORRECTED> {
    /// The power that diffusion takes out of the elastic energy, W per metre of width (0 without
    /// `sample`).
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut power = 0.0;
        for cluster in 0..self.pairs.clusters() {
            let at = cluster * LANES;
            let mut sums =
                L::call(Group::<DIFFUSION, CORRECTED, true> { pass: &self, cluster, group: 0 });
            for group in 1..=self.bodies {
                if !self.pairs.group(cluster, group).is_empty() {
                    let more = L::call(Group::<DIFFUSION, CORRECTED, false> {
                        pass: &self,
                        cluster,
                        group,
                    });
                    for (sum, more) in
                        sums.spread.as_flattened_mut().iter_mut().zip(more.spread.as_flattened())
                    {
                        *sum += more;
                    }
                }
            }
            let near_x = lanes::<L>(&self.work.concentration_x, at);
            let near_y = lanes::<L>(&self.work.concentration_y, at);
            let vx = lanes::<L>(&self.fluid.vx, at);
            let vy = lanes::<L>(&self.fluid.vy, at);
            let spread = |part: usize| L::load(&sums.spread[part]);
            let divergence = if CORRECTED {
                let xx = lanes::<L>(&self.work.correction_xx, at);
                let xy = lanes::<L>(&self.work.correction_xy, at);
                let yy = lanes::<L>(&self.work.correction_yy, at);
                // Σ g (u_i - u_j) Δ
                let ux = vx.mul_sub(near_x, spread(0));
                let uy = vx.mul_sub(near_y, spread(1));
                let wx = vy.mul_sub(near_x, spread(2));
                let wy = vy.mul_sub(near_y, spread(3));
                let minus_half = L::splat(-0.5 * self.support_radius);
                let stretch = xx.mul_add(ux, xy * uy) - xy.mul_add(wx, yy * wy);
                let stretch = (stretch * minus_half * L::splat(0.5)).to_array();
                let shear = xy.mul_add(ux, yy * uy) + xx.mul_add(wx, xy * wy);
                let shear = (shear * minus_half).to_array();
                for lane in 0..LANES {
                    self.strain[at + lane] = [stretch[lane], shear[lane]];
                }
                xx.mul_add(ux, yy * wy) + xy * (uy + wx)
            } else {
                vx.mul_add(near_x, vy * near_y) - spread(0)
            };
            let mut diffusion = L::load(&sums.diffusion) * L::splat(self.diffusion);
            if DIFFUSION == FADED {
                diffusion = diffusion * lanes(&self.work.diffused_share, at);
            }
            let density = lanes::<L>(&self.fluid.density, at);
            store(&mut self.work.density_rate, at, density.mul_add(divergence, diffusion));
            if self.sample {
                // dE/dt = Σ m p/ρ² dρ/dt, by diffusion alone.
                let mass = lanes::<L>(&self.fluid.mass, at);
                let share = mass * lanes(&self.work.pressure, at);
                power += (share * diffusion).div(density * density).sum();
            }
        }
        power
    }
}

/// Sums over the neighbours of one cluster in one group, a value per lane.
struct Sums {
    /// Σ g u_j Δ: ux, uy, vx, vy; without correction the trace alone, in the first.
    spread: [[f64; LANES]; 4],
    /// Σ g ψ.
    diffusion: [f64; LANES],
}

/// The pair loop over one group; only `FLUID` neighbours exchange density.
struct Group<'a, 'b, const DIFFUSION: u8, const CORRECTED: bool, const FLUID: bool> {
    pass: &'b Continuity<'a, DIFFUSION, CORRECTED>,
    cluster: usize,
    group: usize,
}

impl<const DIFFUSION: u8, const CORRECTED: bool, const FLUID: bool> Task
    for Group<'_, '_, DIFFUSION, CORRECTED, FLUID>
{
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sums {
        let Group { pass, cluster, group } = self;
        let at = cluster * LANES;
        let zero = L::splat(0.0);
        let x = lanes::<L>(&pass.work.scaled_x, at);
        let y = lanes::<L>(&pass.work.scaled_y, at);
        let diffused = lanes::<L>(pass.diffused, at);
        let (mut own_gx, mut own_gy) = (zero, zero);
        if DIFFUSION == RENORMALISED {
            own_gx = lanes(&pass.work.gradient_x, at);
            own_gy = lanes(&pass.work.gradient_y, at);
        }
        let (mut ux, mut uy, mut wx, mut wy) = (zero, zero, zero, zero);
        let mut diffusion = zero;
        let entries = pass.pairs.group(cluster, group);
        let slopes = &pass.slopes[pass.pairs.range(cluster, group)];
        for (&j, slope) in entries.iter().zip(slopes) {
            let record = &pass.records[j as usize].0;
            let g = L::load_single(&slope.0);
            let dx = x - L::splat(record[Record::X]);
            let dy = y - L::splat(record[Record::Y]);
            let (vx, vy) = (L::splat(record[Record::VX]), L::splat(record[Record::VY]));
            let (gx, gy) = (g * dx, g * dy);
            ux = gx.mul_add(vx, ux);
            if CORRECTED {
                uy = gy.mul_add(vx, uy);
                wx = gx.mul_add(vy, wx);
                wy = gy.mul_add(vy, wy);
            } else {
                uy = gy.mul_add(vy, uy);
            }
            if FLUID && DIFFUSION != OFF {
                let mut fall = diffused - L::splat(record[Record::DIFFUSED]);
                if DIFFUSION == FADED {
                    fall = fall * L::splat(record[Record::SHARE]);
                }
                let mut psi = fall + fall;
                if DIFFUSION == RENORMALISED {
                    let gradient_x = own_gx + L::splat(record[Record::GRADIENT_X]);
                    let gradient_y = own_gy + L::splat(record[Record::GRADIENT_Y]);
                    psi = gradient_x.negated_mul_add(dx, gradient_y.negated_mul_add(dy, psi));
                }
                diffusion = g.mul_add(psi, diffusion);
            }
        }
        if !CORRECTED {
            ux += uy;
        }
        Sums {
            spread: [ux.to_array(), uy.to_array(), wx.to_array(), wy.to_array()],
            diffusion: diffusion.to_array(),
        }
    }
}
