//! What a pass over velocities sums of each neighbour. Sums of differences follow from it.
//!
//! ```text
//! Σ g (u_i - u_j) Δ = u_i Σ g Δ - (r_i Σ g u_j - Σ g u_j r_j)
//! ```

use super::factors::Factors;
use super::held::{Added, HeldPairs, Product};
use super::term::Eight;
use crate::math::simd::{LANES, Lanes};

/// The sums that a continuity pass needs. Each record starts with the numbers for them, and the
/// pass sums no others. First come u, v, u x and v y. Then comes u y + v x, as one number, or as
/// two for the strain rate. Last come the neighbour's share times ψ, and its share.
#[derive(Debug, Clone, Copy)]
pub struct Flow {
    /// Whether gradients are corrected: u y and v x are then needed too.
    pub corrected: bool,
    /// Whether the next full step needs the strain rate: u y and v x separately. Only with
    /// corrected gradients.
    pub strained: bool,
    /// Whether density diffuses.
    pub diffusing: bool,
    /// Whether the sum of the shares is still unknown: in the first pass of a full step.
    pub sharing: bool,
}

impl Flow {
    /// Number of the velocities' numbers.
    #[inline(always)]
    fn velocities(self) -> usize {
        4 + usize::from(self.corrected) + usize::from(self.strained)
    }

    /// Number of a fluid particle's numbers.
    #[inline(always)]
    fn all(self) -> usize {
        let of_diffusion = if self.diffusing { 1 + usize::from(self.sharing) } else { 0 };
        self.velocities() + of_diffusion
    }

    /// The numbers of eight neighbours: their velocities and places, share times ψ, share.
    #[inline(always)]
    pub fn numbers<L: Lanes>(self, [u, v]: [L; 2], [x, y]: [L; 2], diffusion: [L; 2]) -> [L; 8] {
        let [smoothed, share] = diffusion;
        let (aslant_u, aslant_v) = (u * y, v * x);
        let [fifth, sixth, seventh, eighth] = if !self.corrected {
            [smoothed, share, share, share]
        } else if self.strained {
            [aslant_u, aslant_v, smoothed, share]
        } else {
            [aslant_u + aslant_v, smoothed, share, share]
        };
        [u, v, u * x, v * y, fifth, sixth, seventh, eighth]
    }

    /// Adds the sums over a cluster's pairs with a group: the fluid, 0, or a body's ghosts, of
    /// which only velocities are summed.
    #[inline(always)]
    pub(super) fn add<L: Lanes>(
        self,
        sums: &mut [[f64; LANES]; 8],
        (pairs, factors): (&HeldPairs, &[Factors]),
        cluster: usize,
        group: usize,
    ) {
        macro_rules! add {
            ($count:literal) => {{
                let product = Product::<$count> { pairs, factors, cluster, group };
                L::call(Added { product, sums });
            }};
        }
        match if group == 0 { self.all() } else { self.velocities() } {
            4 => add!(4),
            5 => add!(5),
            6 => add!(6),
            7 => add!(7),
            _ => add!(8),
        }
    }
}

/// The particle's own part in sums of differences.
#[derive(Clone, Copy)]
pub struct Own<D> {
    /// Its place over R.
    pub place: [D; 2],
    /// Its velocity, m/s.
    pub velocity: [D; 2],
    /// Σ g Δ over all its neighbours.
    pub gradient: [D; 2],
}

/// Sums over all neighbours of eight particles.
pub struct FlowSums {
    flow: Flow,
    sums: [Eight; 8],
}

impl FlowSums {
    pub(super) fn new(flow: Flow, sums: [Eight; 8]) -> FlowSums {
        FlowSums { flow, sums }
    }

    #[inline(always)]
    fn number<D: Lanes>(&self, n: usize) -> D {
        D::load(&self.sums[n])
    }

    /// Σ g (u_i - u_j) Δ_x and Σ g (v_i - v_j) Δ_y.
    #[inline(always)]
    pub fn along<D: Lanes>(&self, own: &Own<D>) -> [D; 2] {
        let Own { place: [x, y], velocity: [vx, vy], gradient: [gx, gy] } = *own;
        let (u, v) = (self.number::<D>(0), self.number::<D>(1));
        [vx.mul_sub(gx, x.mul_sub(u, self.number(2))), vy.mul_sub(gy, y.mul_sub(v, self.number(3)))]
    }

    /// Σ g (u_i - u_j) Δ_y and Σ g (v_i - v_j) Δ_x, if the strain rate is needed.
    #[inline(always)]
    pub fn across<D: Lanes>(&self, own: &Own<D>) -> [D; 2] {
        let Own { place: [x, y], velocity: [vx, vy], gradient: [gx, gy] } = *own;
        let (u, v) = (self.number::<D>(0), self.number::<D>(1));
        [vx.mul_sub(gy, y.mul_sub(u, self.number(4))), vy.mul_sub(gx, x.mul_sub(v, self.number(5)))]
    }

    /// The sum of both, in either form, if gradients are corrected.
    #[inline(always)]
    pub fn aslant<D: Lanes>(&self, own: &Own<D>) -> D {
        if self.flow.strained {
            let [u_y, v_x] = self.across(own);
            return u_y + v_x;
        }
        let Own { place: [x, y], velocity: [vx, vy], gradient: [gx, gy] } = *own;
        let (u, v) = (self.number::<D>(0), self.number::<D>(1));
        let crossed = y.mul_add(u, x.mul_sub(v, self.number(4)));
        vx.mul_add(gy, vy.mul_sub(gx, crossed))
    }

    /// Σ g s_j ψ_j over the water, s the share in the diffusion.
    #[inline(always)]
    pub fn smoothed<D: Lanes>(&self) -> D {
        self.number(self.flow.velocities())
    }

    /// Σ g s_j, if it is needed.
    #[inline(always)]
    pub fn shares<D: Lanes>(&self) -> Option<D> {
        if self.flow.sharing { Some(self.number(self.flow.velocities() + 1)) } else { None }
    }
}
