//! Ghosts that neither take energy from the water nor add any: those of a bed, or of a wall with a
//! crest.
//!
//! A ghost has the pressure p_g = Σ_k w_k p_k of the water around its mirror point. Its pressure
//! does the work -p_g D_g per second on the water,
//!
//! ```text
//! D_g = V_g Σ_i V_i u_i · L_g ∇W_ig
//! ```
//! where D_g is the rate at which water flows into the ghost. This work comes from the water, so it
//! is given back: volume D_g is taken from the water around the mirror point, w_k D_g from each
//! particle. In the continuity equation this replaces the ghosts' velocities.
//!
//! At a straight face both are alike. At an edge the flow is no mirror image of itself. There the
//! ghosts' velocities take energy as the water comes, and make as much again as it goes. But water
//! that goes over a crest does not come back. Then water before the wall seems to flow into the
//! ghosts under the top, its pressure falls, and its particles crowd.
//!
//! At a bed beside a moving wall velocities are relative to the wall: see `alongside.rs`. At the
//! edge of the water they are relative to the water's own: see `smooth.rs`.

use std::marker::PhantomData;

use super::alongside::{Alongside, WALLS};
use super::ghosts::Ghosts;
use super::image::Image;
use super::rules::ExchangeRules;
use super::smooth::Smooth;
use crate::body::{BodyMotion, Place};
use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::pairs::{HeldWeights, PairList, PointSet, Record, build_pair_list};
use crate::with_kernel;

/// The water around the ghosts of one body themselves (not around their mirror points).
#[derive(Debug, Clone)]
pub(super) struct Giving {
    /// The body.
    pub place: Place,
    /// The first of its blocks.
    first: usize,
    /// The share of its work that it gives back. For the rest its ghosts have velocities.
    pub share: f64,
    list: PairList,
    /// V_g V_i L_g ∇W_ig of its blocks, along x and up, m.
    fluxes: [HeldWeights; 2],
    /// Velocities beside moving walls; only for a bed.
    pub alongside: Option<Alongside>,
    pub smooth: Smooth,
}

impl Giving {
    /// The bodies that give back: a bed that is not level, and a wall with a crest and what is
    /// behind it.
    pub fn all(rules: &ExchangeRules, ghosts: &Ghosts) -> Vec<Giving> {
        let bed = rules.conservative_bed && ghosts.profile.is_some();
        let wall = rules.conservative_crest && ghosts.crest.is_some();
        let behind = wall && ghosts.keeps_behind();
        let all = [(Place::Bed, bed), (Place::Right, wall), (Place::Behind, behind)];
        let of = |(place, _): (Place, bool)| Giving {
            place,
            first: ghosts.bodies[place.number()].ghosts.start / LANES,
            share: 1.0,
            list: PairList::default(),
            fluxes: Default::default(),
            alongside: (place == Place::Bed).then(Alongside::default),
            smooth: Smooth::default(),
        };
        all.into_iter().filter(|(_, gives)| *gives).map(of).collect()
    }

    /// Lists the fluid around every ghost; `offset` is the body's, and the set's reach in metres.
    pub fn rebuild(
        &mut self,
        path: SimdPath,
        rules: &ExchangeRules,
        (ghosts, offset): (&Ghosts, f64),
        fluid: &PointSet<'_>,
    ) {
        if self.place == Place::Bed {
            self.smooth.prepare(path, rules, ghosts);
        }
        let own = ghosts.bodies[self.place.number()].ghosts.clone();
        let x: Vec<f64> = ghosts.x[own.clone()].iter().map(|x| x + offset).collect();
        build_pair_list(path, &x, &ghosts.y[own], &[*fluid], &mut self.list);
        self.fluxes.iter_mut().for_each(|flux| flux.make_room(&self.list));
    }

    /// Finds the flow of water into its ghosts, at the blocks that count. The records are those of
    /// the water, and of the ghosts alone.
    pub fn find(
        &mut self,
        path: SimdPath,
        rules: &ExchangeRules,
        (ghosts, bodies): (&Ghosts, &[BodyMotion]),
        (counting, images): (&[u32], &[Image]),
        records: [&[Record]; 2],
    ) {
        let weight_per_volume = rules.scaling.weight_per_volume;
        let reach = rules.scaling.support_radius;
        let blocks = self.blocks(counting);
        let walls = WALLS
            .map(|place| ghosts.bodies[place.number()].plane.moved(bodies[place.number()].offset));
        if let Some(alongside) = &mut self.alongside {
            alongside.find((ghosts, &walls), bodies[0].offset, reach, blocks);
        }
        with_kernel!(rules.kernel, K => dispatch(path, Flux::<K> {
            blocks,
            first: self.first,
            list: &self.list,
            fluxes: &mut self.fluxes,
            images,
            records,
            weight_per_volume,
            kernel: PhantomData,
        }));
        if !self.smooth.is_on() {
            return;
        }
        let weight = rules.surface_density * rules.gravity;
        for &block in blocks {
            let row = block as usize;
            let volume = weights(records[1], row).map(|weight| weight / weight_per_volume);
            let head = images[row].pressure.map(|pressure| pressure / weight);
            let fluxes = self.fluxes.each_ref().map(|flux| flux.of(row).1);
            self.smooth.find(row, (ghosts, &walls, reach), (fluxes, [&volume, &head]));
        }
    }

    /// Its blocks of those that count.
    pub fn blocks<'a>(&self, counting: &'a [u32]) -> &'a [u32] {
        let before = |end: usize| counting.partition_point(|&block| (block as usize) < end);
        &counting[before(self.first)..before(self.first + self.list.clusters())]
    }

    /// For a block, by its number among all: the water around, and V_g V_i L_g ∇W_ig along x and
    /// up, m.
    pub fn fluxes_of(&self, block: usize) -> [(&[u32], &[[f64; LANES]]); 2] {
        self.fluxes.each_ref().map(|flux| flux.of(block - self.first))
    }

    /// The velocity U at a block, m/s, which velocities are taken relative to.
    #[inline(always)]
    pub fn beside<L: Lanes>(&self, block: usize, bodies: &[BodyMotion]) -> [L; 2] {
        let still = [L::splat(0.0); 2];
        self.alongside.as_ref().map_or(still, |it| it.velocity(block - self.first, bodies))
    }
}

/// Weights of a block of ghosts.
fn weights(ghosts: &[Record], block: usize) -> [f64; LANES] {
    std::array::from_fn(|lane| ghosts[block * LANES + lane].0[Record::WEIGHT])
}

/// Finds V_g V_i L_g ∇W_ig at some blocks.
struct Flux<'a, K> {
    list: &'a PairList,
    fluxes: &'a mut [HeldWeights; 2],
    blocks: &'a [u32],
    /// The block at which lists and fluxes begin.
    first: usize,
    images: &'a [Image],
    /// Of the water, and of the ghosts alone.
    records: [&'a [Record]; 2],
    weight_per_volume: f64,
    kernel: PhantomData<K>,
}

impl<K: Kernel> Task for Flux<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Flux { list, fluxes: [along, up], blocks, first, images, .. } = self;
        let [water, ghosts] = self.records;
        let mut end = 0;
        for &block in blocks {
            let row = block as usize - first;
            let image = &images[block as usize];
            let [x, y] = [L::load(&image.place[0]), L::load(&image.place[1])];
            let [xx, xy, yy] = [0, 1, 2].map(|part| L::load(&image.correction[part]));
            let volume =
                L::load(&weights(ghosts, block as usize)) * L::splat(1.0 / self.weight_per_volume);
            along.take(row, list.group(row, 0), [x, y], water, end);
            end = up.take(row, list.group(row, 0), [x, y], water, end);
            let (entries, along) = along.room(row);
            let (_, up) = up.room(row);
            for ((&i, along), up) in entries.iter().zip(along).zip(up) {
                let record = &water[i as usize].0;
                let (dx, dy) = (L::splat(record[Record::X]) - x, L::splat(record[Record::Y]) - y);
                let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                let inverse = s.rsqrt();
                let slope = K::slope_over_q(s, [s * inverse, inverse]);
                let slope = slope * L::splat(record[Record::WEIGHT]) * volume;
                (slope * xx.mul_add(dx, xy * dy)).store(along);
                (slope * xy.mul_add(dx, yy * dy)).store(up);
            }
        }
    }
}
