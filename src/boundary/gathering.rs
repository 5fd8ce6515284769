//! Some weighted means alone, with weights that are already known, and what is to come of them.

use super::exchange::Exchange;
use super::ghost_part::GhostPart;
use super::ghosts::Ghosts;
use super::image::{Image, Mirror, Press};
use super::sums::Means;
use crate::body::BodyMotion;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::math::team::First;
use crate::pairs::{Factors, Flow};

/// Where some means stand among all.
type Places<const N: usize> = fn(&mut Means) -> [&mut [f64; LANES]; N];

/// Some means alone, with the weights at hand: of `N` fields of the water.
struct Gather<'a, const N: usize> {
    part: &'a GhostPart,
    /// Some of the part's blocks.
    blocks: &'a [u32],
    scale: &'a [[f64; LANES]],
    /// The part's.
    means: &'a mut [Means],
    fields: [&'a [f64]; N],
    /// Where they belong.
    places: Places<N>,
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
struct Renewed<'a> {
    /// Blocks that count.
    blocks: &'a [u32],
    /// The block that images, means and numbers begin with.
    first: usize,
    images: &'a mut [Image],
    means: &'a [Means],
    /// The ghosts' numbers as neighbours.
    factors: &'a mut [Factors],
}

impl Exchange {
    /// Interpolates the velocities anew, with the weights at hand, for the continuity equation, and puts
    /// them into the numbers that ghosts have as neighbours. There walls are smooth whatever the slip (De
    /// Leffe et al. 2011): a tangential velocity turned round at the wall would be compression that no
    /// force does work on. `water` holds the fluid's velocities along x and y.
    pub fn refresh_velocities(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        water: [&[f64]; 2],
        (flow, factors): (Flow, &mut [Factors]),
    ) {
        let places: Places<2> = |means| [&mut means.vx, &mut means.vy];
        self.renew(path, (water, places), factors, &|renewed| {
            let Renewed { blocks, first, images, means, factors } = renewed;
            let factors = Some((flow, factors));
            dispatch(path, Mirror { blocks, first, images, means, ghosts, bodies, factors });
        });
    }

    /// Interpolates the pressures anew, with the weights, wetness and corrections at hand and the
    /// ghosts where they were, and puts them into the numbers that ghosts have as neighbours.
    pub fn refresh_pressures(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        pressure: &[f64],
        factors: &mut [Factors],
    ) {
        let rules = self.rules;
        let places: Places<1> = |means| [&mut means.pressure];
        self.renew(path, ([pressure], places), factors, &|renewed| {
            let Renewed { blocks, first, images, means, factors } = renewed;
            let factors = Some(factors);
            dispatch(path, Press { blocks, first, images, means, ghosts, bodies, rules, factors });
        });
    }

    /// Means of some fields of the water at the ghosts that count, with the weights at hand, and where they
    /// belong; then all that comes of them.
    fn renew<const N: usize>(
        &mut self,
        path: SimdPath,
        (fields, places): ([&[f64]; N], Places<N>),
        factors: &mut [Factors],
        make: &(impl Fn(Renewed<'_>) + Sync),
    ) {
        let Exchange { team, parts, counting, scale, means, images, .. } = self;
        let (scale, counting) = (&scale[..], &counting[..]);
        let rows = (&mut means[..], (First(images, 1), First(factors, LANES)));
        team.share(parts, rows, &|part, (means, (First(images, _), First(factors, _)))| {
            let (blocks, first) = (part.among(counting), part.blocks.start);
            dispatch(path, Gather { part, blocks, scale, means, fields, places });
            make(Renewed { blocks, first, images, means, factors });
        });
    }
}
