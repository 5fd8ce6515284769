//! From the water to the ghosts: one interpolation at every mirror point, and its results.

use std::marker::PhantomData;
use std::ops::Range;

use super::ghost_part::GhostPart;
use super::ghosts::{Ghosts, Site};
use super::giving::Giving;
use super::image::Image;
use super::rules::{ExchangeRules, GhostGravity, targets};
use super::sums::{Cover, KernelWeights, Means, Near, Water, Weigh};
use super::waterline::Waterline;
use super::{InterpolatorChoice, with_interpolator};
use crate::body::BodyMotion;
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::math::team::{self, Team};
use crate::pairs::{PointSet, Strips, build_pair_list};
use crate::with_kernel;

/// The ghosts' side of a step: neighbour lists of their targets, weights, means.
#[derive(Debug, Clone)]
pub struct Exchange {
    pub(super) rules: ExchangeRules,
    pub(super) waterlines: Vec<Waterline>,
    /// Share of each face point's half disc that other walls leave open; of the bed, 1.
    pub(super) complete: Vec<f64>,
    pub(super) half_plane: Vec<f64>,
    pub(super) team: Team,
    /// Lists and weights, cut for the team.
    pub(super) parts: Vec<GhostPart>,
    /// The targets for which the lists were made.
    places: [Vec<f64>; 2],
    /// Blocks with ghosts that have water in reach, at the last [`Exchange::fill`].
    pub(super) counting: Vec<u32>,
    /// Room for the motions that [`Exchange::weigh_face`] assumes.
    pub(super) motions: Vec<BodyMotion>,
    pub(super) images: Vec<Image>,
    pub(super) scale: Vec<[f64; LANES]>,
    /// Above one half where a simpler method had to be used.
    pub(super) fallen: Vec<[f64; LANES]>,
    /// Number of filled ghosts with values of a simpler method.
    pub(super) fallbacks: u64,
    pub(super) means: Vec<Means>,
    pub(super) wetness: Vec<f64>,
    /// Change of each ghost's pressure per acceleration of its wall, Pa/(m/s²), times its
    /// correction: xx, xy, yy.
    pub(super) responses: Vec<[f64; 3]>,
    /// Bodies that give their work back to the water.
    pub(super) giving: Vec<Giving>,
}

impl Exchange {
    /// An exchange without data of the water.
    pub fn new(rules: ExchangeRules, ghosts: &Ghosts) -> Exchange {
        let half_plane =
            (0..=256).map(|k| rules.kernel.half_plane_fraction(f64::from(k) / 256.0)).collect();
        let targets = ghosts.target_x.len();
        let ExchangeRules { kernel, spacing, scaling, .. } = rules;
        let waterline = |plane| Waterline::of(kernel, spacing, scaling.support_radius, plane);
        let waterlines = ghosts.bodies.iter().map(|body| waterline(body.plane)).collect();
        let mut exchange = Exchange {
            rules,
            waterlines,
            complete: vec![1.0; targets],
            half_plane,
            team: Team::default(),
            parts: vec![GhostPart::default()],
            places: Default::default(),
            counting: Vec::with_capacity(ghosts.len() / LANES),
            motions: Vec::with_capacity(ghosts.bodies.len()),
            images: vec![Image::default(); ghosts.len() / LANES],
            scale: vec![[0.0; LANES]; targets / LANES],
            fallen: vec![[0.0; LANES]; targets / LANES],
            fallbacks: 0,
            means: vec![Means::default(); targets / LANES],
            wetness: vec![0.0; targets],
            responses: vec![[0.0; 3]; ghosts.len()],
            giving: Giving::all(&rules, ghosts),
        };
        if rules.bed_between_walls {
            exchange.complete_walls(ghosts);
        }
        exchange
    }

    /// Hands over a team of threads, which is used from the next [`Exchange::rebuild`] on.
    pub fn take_on(&mut self, team: &Team) {
        self.parts = vec![GhostPart::default(); team.parts()];
        self.team = team.clone();
    }

    /// Responses of the ghosts to their wall's acceleration, from the last [`Exchange::fill`].
    pub fn responses(&self) -> &[[f64; 3]] {
        &self.responses
    }

    /// Number of counting ghosts with values of a simpler method, at the last [`Exchange::fill`].
    pub fn fallbacks(&self) -> u64 {
        self.fallbacks
    }

    /// Images of all blocks.
    pub fn images(&self) -> &[Image] {
        &self.images
    }

    /// Number of target-to-fluid pairs in the lists.
    pub fn pairs(&self) -> u64 {
        let entries = self.parts.iter().map(|part| part.list.len());
        (LANES * entries.sum::<usize>()) as u64
    }

    /// Lists the fluid around every target; `reach` in metres.
    pub fn rebuild(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        fluid: (&Strips, &[f64], &[f64]),
        reach: f64,
    ) {
        let (strips, x, y) = fluid;
        let Exchange { rules, team, parts, places, .. } = self;
        let [target_x, target_y] = places;
        target_x.clone_from(&ghosts.target_x);
        target_y.clone_from(&ghosts.target_y);
        if rules.interpolator.at_ghost() {
            target_x[..ghosts.len()].copy_from_slice(&ghosts.x);
            target_y[..ghosts.len()].copy_from_slice(&ghosts.y);
        }
        for (k, x) in target_x.iter_mut().enumerate() {
            *x += bodies[ghosts.target_body[k / LANES] as usize].offset;
        }
        let bounds = PointSet::EVERYWHERE;
        let set = PointSet { strips, x, y, offset: 0.0, first: 0, reach, bounds };
        for giving in &mut self.giving {
            let offset = bodies[giving.place.number()].offset;
            giving.rebuild(path, rules, (ghosts, offset), &set);
        }
        let targets = [&*target_x, &*target_y];
        let ranges = team::cut(target_x.len() / LANES, parts.len());
        for (part, range) in parts.iter_mut().zip(ranges) {
            part.blocks = range;
        }
        team.share(parts, (), &|part, ()| {
            let lanes = part.blocks.start * LANES..part.blocks.end * LANES;
            let [x, y] = targets.map(|places| &places[lanes.clone()]);
            build_pair_list(path, x, y, &[set], &mut part.list);
            part.held.make_room(&part.list);
        });
    }

    /// Finds the weights at all mirror points and the wetness of all face points.
    pub fn weigh(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        water: Water<'_>,
    ) {
        let blocks = 0..ghosts.len() / LANES;
        self.weigh_blocks(path, (ghosts, bodies), water, blocks, self.rules.interpolator);
        let Exchange { rules, team, parts, wetness, .. } = self;
        let (rules, faces) = (*rules, ghosts.len() / LANES..ghosts.target_x.len() / LANES);
        team.share(parts, &mut wetness[..], &|part, coverage| {
            let targets =
                targets(&rules, (&part.list, &part.blocks), (ghosts, bodies, water), &faces);
            with_kernel!(rules.kernel, K => {
                dispatch(path, Cover::<K> { targets, coverage, kernel: PhantomData });
            });
        });
        self.wet_faces(ghosts, bodies);
    }

    /// Weights and means at some blocks of targets.
    pub(super) fn weigh_blocks(
        &mut self,
        path: SimdPath,
        (ghosts, bodies): (&Ghosts, &[BodyMotion]),
        water: Water<'_>,
        blocks: Range<usize>,
        interpolator: InterpolatorChoice,
    ) {
        let Exchange { rules, team, parts, scale, fallen, means, .. } = self;
        let rules = *rules;
        let rows = ([&mut scale[..], &mut fallen[..]], &mut means[..]);
        team.share(parts, rows, &|part, ([scale, fallen], means)| {
            let GhostPart { blocks: own, list, held, .. } = part;
            let targets = targets(&rules, (list, own), (ghosts, bodies, water), &blocks);
            dispatch(path, Near { targets: targets.clone(), held });
            if interpolator.from_kernel() {
                let targets = targets.clone();
                with_kernel!(rules.kernel, K => dispatch(path, KernelWeights::<K> {
                    targets,
                    held,
                    kernel: PhantomData,
                }));
            }
            with_interpolator!(interpolator, interpolator => {
                dispatch(path, Weigh { interpolator, targets, held, scale, fallen, means });
            });
        });
    }

    /// Vector from the place at which the water's mean pressure holds to a ghost, metres.
    pub(super) fn lever(&self, ghosts: &Ghosts, g: usize, motion: &BodyMotion) -> [f64; 2] {
        let (means, lane) = (&self.means[g / LANES], g % LANES);
        let anchor = if self.rules.ghost_gravity != GhostGravity::AtMirror {
            [means.x[lane], means.y[lane]]
        } else {
            [ghosts.target_x[g] + motion.offset, ghosts.target_y[g]]
        };
        [ghosts.x[g] + motion.offset - anchor[0], ghosts.y[g] - anchor[1]]
    }

    /// Density of the water around a ghost's mirror point, kg/m³.
    pub(super) fn density(&self, g: usize) -> f64 {
        let rules = &self.rules;
        let mean = self.means[g / LANES].pressure[g % LANES];
        rules.surface_density + mean / (rules.sound_speed * rules.sound_speed)
    }

    /// The share of a ghost that counts.
    pub(super) fn wet_share_of(&self, ghosts: &Ghosts, body: usize, g: usize) -> f64 {
        match ghosts.face[g] {
            Site::ALWAYS_WET => 1.0,
            face => self.wet_share(body, face as usize),
        }
    }
}
