//! The numbers of a neighbour that the continuity pass multiplies with the slopes.

use super::factors::Factors;
use super::held::{Added, HeldPairs, Product};
use crate::math::simd::{LANES, Lanes};

/// What a continuity pass wants: each record begins with the numbers for it, and the pass sums no
/// others. First u, v, u x and v y; then u y + v x, in one number or, for the strain, in two; then
/// the neighbour's share times ψ, and its share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flow {
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
    pub fn velocities(self) -> usize {
        4 + usize::from(self.corrected) + usize::from(self.strained)
    }

    /// Numbers of the share times ψ, and of the share, among all.
    #[inline(always)]
    pub fn diffusion(self) -> (usize, usize) {
        (self.velocities(), self.velocities() + 1)
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
    pub fn add<L: Lanes>(
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
