//! Second pair pass of a step: rates of change of density.

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, Task};
use crate::neighbours::PairList;
use crate::particles::{Fluid, Record};

use super::Workspace;

/// No density diffusion.
pub(super) const OFF: u8 = 0;
/// ψ_ij = 2 (ψ_j - ψ_i) x_ji/|x_ji|², of ψ = ρ or of ρ less its hydrostatic part.
pub(super) const PLAIN: u8 = 1;
/// The same less the mean renormalised gradient.
pub(super) const RENORMALISED: u8 = 2;

/// Continuity equation of Huang et al. 2019, Eq. 5, with the new velocities at the old places.
///
/// Ghosts take part in the divergence, not in the diffusion: no density flows through a wall.
pub(super) struct Continuity<'a, K, const DIFFUSION: u8, const CORRECTED: bool, const ENERGY: bool> {
    pub fluid: &'a Fluid,
    pub records: &'a [Record],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    pub pairs: &'a PairList,
    pub strain: &'a mut [[f64; 2]],
    pub work: &'a mut Workspace,
    pub support_radius: f64,
    /// 1 where viscosity leaves out the linear part of the velocity field, 0 where it does not.
    pub smooth_share: f64,
    pub bodies: usize,
    /// δ h c0 / R.
    pub diffusion: f64,
    pub kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, const DIFFUSION: u8, const CORRECTED: bool, const ENERGY: bool> Task
    for Continuity<'_, K, DIFFUSION, CORRECTED, ENERGY>
{
    /// The power that diffusion takes out of the elastic energy, W per metre of width (0 without
    /// `ENERGY`).
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut power = 0.0;
        for cluster in 0..self.pairs.clusters() {
            let at = cluster * LANES;
            let lanes = |field: &[f64]| L::load(field[at..at + LANES].first_chunk().unwrap());
            let work = &*self.work;
            let (x, y) = (lanes(&work.scaled_x), lanes(&work.scaled_y));
            let (vx, vy) = (lanes(&self.fluid.vx), lanes(&self.fluid.vy));
            let density = lanes(&self.fluid.density);
            let diffused = lanes(self.diffused);
            let (own_gx, own_gy) = if DIFFUSION == RENORMALISED {
                (lanes(&work.gradient_x), lanes(&work.gradient_y))
            } else {
                (L::splat(0.0), L::splat(0.0))
            };
            // Σ g du Δ: without correction only its trace is summed, in the first entry.
            let mut spread = [L::splat(0.0); 4];
            let mut diffusion = L::splat(0.0);
            for group in 0..=self.bodies {
                for &j in self.pairs.group(cluster, group) {
                    let record = &self.records[j as usize].0;
                    let dx = x - L::splat(record[Record::X]);
                    let dy = y - L::splat(record[Record::Y]);
                    let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                    let g = K::slope_over_q(s, s.rsqrt()) * L::splat(record[Record::WEIGHT]);
                    let du = vx - L::splat(record[Record::VX]);
                    let dv = vy - L::splat(record[Record::VY]);
                    if CORRECTED {
                        let (gx, gy) = (g * dx, g * dy);
                        spread = [
                            gx.mul_add(du, spread[0]),
                            gy.mul_add(du, spread[1]),
                            gx.mul_add(dv, spread[2]),
                            gy.mul_add(dv, spread[3]),
                        ];
                    } else {
                        spread[0] = g.mul_add(du.mul_add(dx, dv * dy), spread[0]);
                    }
                    if group == 0 && DIFFUSION != OFF {
                        let fall = diffused - L::splat(record[Record::DIFFUSED]);
                        let mut psi = fall + fall;
                        if DIFFUSION == RENORMALISED {
                            let gx = own_gx + L::splat(record[Record::GRADIENT_X]);
                            let gy = own_gy + L::splat(record[Record::GRADIENT_Y]);
                            psi = psi - gx.mul_add(dx, gy * dy);
                        }
                        diffusion = g.mul_add(psi, diffusion);
                    }
                }
            }
            let divergence = if CORRECTED {
                let [xx, xy, yy] = [&work.correction_xx, &work.correction_xy, &work.correction_yy]
                    .map(|component| lanes(component));
                let [ux, uy, vx, vy] = spread;
                let half = L::splat(-0.5 * self.support_radius * self.smooth_share);
                let stretch = (xx.mul_add(ux, xy * uy) - xy.mul_add(vx, yy * vy)) * L::splat(0.5) * half;
                let shear = (xy.mul_add(ux, yy * uy) + xx.mul_add(vx, xy * vy)) * half;
                let (stretch, shear) = (stretch.to_array(), shear.to_array());
                for lane in 0..LANES {
                    self.strain[at + lane] = [stretch[lane], shear[lane]];
                }
                xx.mul_add(ux, yy * vy) + xy * (uy + vx)
            } else {
                spread[0]
            };
            let diffusion = diffusion * L::splat(self.diffusion);
            let rate = density.mul_add(divergence, diffusion);
            rate.store(self.work.density_rate[at..at + LANES].first_chunk_mut().unwrap());
            if ENERGY {
                let lanes = |field: &[f64]| L::load(field[at..at + LANES].first_chunk().unwrap());
                // dE/dt = Σ m p/ρ² dρ/dt, by diffusion alone.
                let mass = lanes(&self.fluid.mass);
                let share = mass * lanes(&self.work.pressure);
                power += (share * diffusion).div(density * density).sum();
            }
        }
        power
    }
}
