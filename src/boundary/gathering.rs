//! Some weighted means alone, with weights that are already known, and what is to come of them.

use super::ghost_part::GhostPart;
use super::image::Image;
use super::sums::Means;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::Factors;

/// Where some means stand among all.
pub(super) type Places<const N: usize> = fn(&mut Means) -> [&mut [f64; LANES]; N];

/// Some means alone, with the weights at hand: of `N` fields of the water.
pub(super) struct Gather<'a, const N: usize> {
    pub part: &'a GhostPart,
    /// Some of the part's blocks.
    pub blocks: &'a [u32],
    pub scale: &'a [[f64; LANES]],
    /// The part's.
    pub means: &'a mut [Means],
    pub fields: [&'a [f64]; N],
    /// Where they belong.
    pub places: Places<N>,
}

impl<const N: usize> Task for Gather<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for &block in self.blocks {
            let (block, row) = (block as usize, block as usize - self.part.blocks.start);
            let sums = self.part.held.sums::<L, N>(row, self.fields);
            let scale = L::load(&self.scale[block]);
            let means = (self.places)(&mut self.means[row]);
            for n in 0..N {
                (sums[n] * scale).store(means[n]);
            }
        }
    }
}

/// New means at the ghosts of a part, and what is to come of them.
pub(super) struct Renewed<'a> {
    /// Blocks that count.
    pub blocks: &'a [u32],
    /// The block that images, means and numbers begin with.
    pub first: usize,
    pub images: &'a mut [Image],
    pub means: &'a [Means],
    /// The ghosts' numbers as neighbours.
    pub factors: &'a mut [Factors],
}
