//! Means of some fields with weights that are already known, and the ghosts' values from them.

use super::exchange::Exchange;
use super::ghost_part::GhostPart;
use super::ghosts::Ghosts;
use super::image::{Image, Mirror, Press};
use super::sums::Means;
use crate::body::BodyMotion;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::math::team::First;
use crate::pairs::{Factors, Flow};

/// Selects the means of some fields.
type Places<const N: usize> = fn(&mut Means) -> [&mut [f64; LANES]; N];

/// Finds the means of `N` fields of the water, with the present weights.
struct Gather<'a, const N: usize> {
    part: &'a GhostPart,
    /// Some of the part's blocks.
    blocks: &'a [u32],
    scale: &'a [[f64; LANES]],
    /// The part's means.
    means: &'a mut [Means],
    fields: [&'a [f64]; N],
    /// Where the results belong.
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

/// New means at the ghosts of a part, for the values to be made from them.
struct Renewed<'a> {
    /// Blocks of ghosts that count.
    blocks: &'a [u32],
    /// The first block of images, means and numbers.
    first: usize,
    images: &'a mut [Image],
    means: &'a [Means],
    /// The ghosts' numbers as neighbours.
    factors: &'a mut [Factors],
}

impl Exchange {
    /// Interpolates the velocities again for the continuity equation, with the present weights.
    /// They go into the ghosts' numbers as neighbours. Here walls are smooth for any slip (De Leffe
    /// et al. 2011): a tangential velocity reversed at the wall would be a compression on which no
    /// force does work. `water` holds the fluid's velocities along x and y.
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

    /// Interpolates the pressures again, with the present weights, wetness, corrections and places
    /// of the ghosts. They go into the ghosts' numbers as neighbours.
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

    /// Finds means of some fields of the water at the ghosts that count, with the present weights.
    /// `make` then finds what depends on them.
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
