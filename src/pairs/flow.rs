//! The numbers of a neighbour that a pass over velocities sums, and the sums of differences that they
//! make: Σ g (u_i - u_j) Δ = u_i Σ g Δ - (r_i Σ g u_j - Σ g u_j r_j).

use super::factors::Factors;
use super::held::{Added, HeldPairs, Product};
use super::term::Eight;
use crate::math::simd::{LANES, Lanes};

/// What a continuity pass wants: each record begins with the numbers for it, and the pass sums no
/// others. First u, v, u x and v y; then u y + v x, in one number or, for the strain, in two; then
/// the neighbour's share times ψ, and its share.
#[derive(Debug, Clone, Copy)]
pub struct Flow {
    /// Gradients are corrected: u y and v x count, too.
    pub corrected: bool,
    /// The strain is wanted, by the full step that comes next: u y and v x apart. Only where
    /// gradients are corrected.
    pub strained: bool,
    /// Density diffuses.
    pub diffusing: bool,
    /// The sum of the shares is not yet known: it is that of the first pass since the full step.
    pub sharing: bool,
}

impl Flow {
    /// How many numbers there are of velocities.
    #[inline(always)]
    fn velocities(self) -> usize {
        4 + usize::from(self.corrected) + usize::from(self.strained)
    }

    /// How many numbers there are of fluid.
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

    /// Adds the sums over a cluster's pairs with a group: the fluid, 0, or a body's ghosts, of which
    /// velocities alone count.
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

/// What a particle itself has to do with sums of differences.
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

    /// Σ g (u_i - u_j) Δ_y and Σ g (v_i - v_j) Δ_x: of a flow whose strain is wanted.
    #[inline(always)]
    pub fn across<D: Lanes>(&self, own: &Own<D>) -> [D; 2] {
        let Own { place: [x, y], velocity: [vx, vy], gradient: [gx, gy] } = *own;
        let (u, v) = (self.number::<D>(0), self.number::<D>(1));
        [vx.mul_sub(gy, y.mul_sub(u, self.number(4))), vy.mul_sub(gx, x.mul_sub(v, self.number(5)))]
    }

    /// The sum of both, whether they are summed apart or as one: of a flow that is corrected.
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

    /// Σ g s_j, where it is wanted.
    #[inline(always)]
    pub fn shares<D: Lanes>(&self) -> Option<D> {
        if self.flow.sharing { Some(self.number(self.flow.velocities() + 1)) } else { None }
    }
}
