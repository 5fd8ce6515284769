//! Second pair pass of a step: rates of change of density.

use crate::math::simd::{LANES, Lanes, Task};
use crate::particles::Fluid;

use super::Workspace;
use super::correction::surface_share;
use super::factors::Factors;
use super::flow::Flow;
use super::held::Product;
use super::momentum::store;
use super::parts::Part;
use super::separation::lanes;

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
///
/// The velocities are those of mid-step, the places half a step older: seen from there, ∇u is
/// ∇u + ½ Δt (∇u)², and a flow without divergence seems to have ½ Δt tr (∇u)². So that much is taken
/// off. Left in, water that is strained gives up energy and volume in proportion to Δt.
///
/// Factors of a neighbour are those of its [`Flow`]; its share in the diffusion is 1 but for `FADED`;
/// for `RENORMALISED` 2 ψ - r·∇ψ stands in place of ψ.
pub(super) struct Continuity<'a, const DIFFUSION: u8, const CORRECTED: bool> {
    pub fluid: &'a Fluid,
    pub factors: &'a [Factors],
    /// R ∇ψ, x and y, of the fluid: for `RENORMALISED` alone.
    pub slants: &'a [Factors],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    pub part: &'a mut Part,
    /// The part's rows of the strain ...
    pub strain: &'a mut [[f64; 2]],
    /// ... of the rates of change of density ...
    pub rate: &'a mut [f64],
    /// ... of the sums of g times the neighbours' shares in the diffusion ...
    pub shares: &'a mut [f64],
    /// ... and of tr (∇u)² at the last strain, 1/s².
    pub turning: &'a mut [f64],
    pub work: &'a Workspace,
    pub support_radius: f64,
    /// See [`super::correction::first_row_share`].
    pub first_row: f64,
    pub bodies: usize,
    /// δ h c0 / R.
    pub diffusion: f64,
    /// What is wanted, and leads the factors.
    pub flow: Flow,
    /// Length of the step, seconds.
    pub dt: f64,
    /// Whether the power of diffusion is wanted.
    pub sample: bool,
}

impl<const DIFFUSION: u8, const CORRECTED: bool> Task for Continuity<'_, DIFFUSION, CORRECTED> {
    /// With `sample` the tally has the power that diffusion takes out of the elastic energy.
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (factors, flow) = (self.factors, self.flow);
        let Part { clusters, held: pairs, tally, .. } = self.part;
        tally.powers.clear();
        tally.flow_entries += pairs.len();
        for (here, cluster) in clusters.clone().enumerate() {
            let (at, to) = (cluster * LANES, here * LANES);
            let x = lanes::<L>(&self.work.scaled_x, at);
            let y = lanes::<L>(&self.work.scaled_y, at);
            let mut sums = [[0.0; LANES]; 8];
            flow.add::<L>(&mut sums, (pairs, factors), here, 0);
            let mut diffusion = L::splat(0.0);
            if DIFFUSION != OFF {
                // Σ g (ψ_i - ψ_j), shares of the neighbours included.
                let (smoothed, share) = flow.diffusion();
                if flow.sharing {
                    self.shares[to..to + LANES].copy_from_slice(&sums[share]);
                }
                let (smoothed, share) = (L::load(&sums[smoothed]), lanes::<L>(self.shares, to));
                let own = lanes::<L>(self.diffused, at);
                let two = L::splat(2.0);
                diffusion = if DIFFUSION == RENORMALISED {
                    let plain = (own * two).mul_sub(share, smoothed);
                    let slants = self.slants;
                    let sums =
                        L::call(Product::<4> { pairs, factors: slants, cluster: here, group: 0 });
                    let own_x = lanes::<L>(&self.work.gradient_x, at);
                    let own_y = lanes::<L>(&self.work.gradient_y, at);
                    // Less (∇_i + ∇_j)·(r_i - r_j).
                    let near_x = x.mul_sub(share, L::load(&sums[2]));
                    let near_y = y.mul_sub(share, L::load(&sums[3]));
                    let slant = own_x.mul_add(near_x, own_y * near_y);
                    let slant = x.mul_add(L::load(&sums[0]), slant);
                    plain - y.mul_add(L::load(&sums[1]), slant)
                } else {
                    own.mul_sub(share, smoothed) * two
                };
            }
            for group in 1..=self.bodies {
                if !pairs.group(here, group).0.is_empty() {
                    flow.add::<L>(&mut sums, (pairs, factors), here, group);
                }
            }
            let near_x = lanes::<L>(&self.work.concentration_x, at);
            let near_y = lanes::<L>(&self.work.concentration_y, at);
            let vx = lanes::<L>(&self.fluid.vx, at);
            let vy = lanes::<L>(&self.fluid.vy, at);
            let (u, v) = (L::load(&sums[0]), L::load(&sums[1]));
            // Σ g (u_i - u_j) Δ
            let ux = vx.mul_sub(near_x, x.mul_sub(u, L::load(&sums[2])));
            let wy = vy.mul_sub(near_y, y.mul_sub(v, L::load(&sums[3])));
            let divergence = if CORRECTED {
                let xx = lanes::<L>(&self.work.correction_xx, at);
                let xy = lanes::<L>(&self.work.correction_xy, at);
                let yy = lanes::<L>(&self.work.correction_yy, at);
                let aslant = if flow.strained {
                    let uy = vx.mul_sub(near_y, y.mul_sub(u, L::load(&sums[4])));
                    let wx = vy.mul_sub(near_x, x.mul_sub(v, L::load(&sums[5])));
                    // Of the gradient itself, not of the share of it that the balance takes.
                    let share =
                        surface_share(lanes::<L>(&self.work.completeness, at), self.first_row);
                    let minus = L::splat(-1.0).div(share);
                    let [u_x, u_y] = [xx.mul_add(ux, xy * uy), xy.mul_add(ux, yy * uy)];
                    let [v_x, v_y] = [xx.mul_add(wx, xy * wy), xy.mul_add(wx, yy * wy)];
                    let squares = u_x.mul_add(u_x, v_y * v_y);
                    let crossed = u_y * v_x;
                    store(self.turning, to, (squares + crossed + crossed) * minus * minus);
                    let minus_half = L::splat(0.5 * self.support_radius) * minus;
                    let stretch = ((u_x - v_y) * minus_half * L::splat(0.5)).to_array();
                    let shear = ((u_y + v_x) * minus_half).to_array();
                    for lane in 0..LANES {
                        self.strain[to + lane] = [stretch[lane], shear[lane]];
                    }
                    uy + wx
                } else {
                    let crossed = y.mul_add(u, x.mul_sub(v, L::load(&sums[4])));
                    vx.mul_add(near_y, vy.mul_sub(near_x, crossed))
                };
                xx.mul_add(ux, yy * wy) + xy * aslant
            } else {
                ux + wy
            };
            let mut diffusion = diffusion * L::splat(self.diffusion);
            if DIFFUSION == FADED {
                diffusion = diffusion * lanes(&self.work.diffused_share, at);
            }
            let divergence = if CORRECTED {
                lanes::<L>(self.turning, to).mul_add(L::splat(0.5 * self.dt), divergence)
            } else {
                divergence
            };
            let density = lanes::<L>(&self.fluid.density, at);
            store(self.rate, to, density.mul_add(divergence, diffusion));
            if self.sample {
                // dE/dt = Σ m p/ρ² dρ/dt, by diffusion alone.
                let mass = lanes::<L>(&self.fluid.mass, at);
                let share = mass * lanes(&self.work.pressure, at);
                tally.powers.push((share * diffusion).div(density * density).sum());
            }
        }
    }
}
