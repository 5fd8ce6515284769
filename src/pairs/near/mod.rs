//! The water at one instant with its images: pairs that are listed and weighed again in every step.
//!
//! [`Pairs`](super::Pairs) has lists that last for many steps. [`Near`] has lists without a margin,
//! and the slope of every pair in double precision. A [`Term`](super::Term) reads its pairs as in
//! any other pass. But Δ is in metres, and g, which is -F, in 1/m²: g Δ = V_j ∇_iW_ij.
//! any other pass, but Δ is in metres and g = F's negative in 1/m²: g Δ = V_j ∇_iW_ij.

mod average;
mod each;
mod part;
mod rows;
mod sums;
mod values;
mod weigh;

use std::ops::Range;

use super::fluid::{Fluid, reorder};
use super::pair_list::{PointSet, build_pair_list};
use super::record::Record;
use super::strips::Strips;
use crate::kernel::KernelChoice;
use crate::math::simd::{LANES, SimdPath};
use crate::math::team::{Team, cut};
use part::Part;
pub use rows::{Blocks, Coupling};
pub use values::{Field, Values};
pub use weigh::Moments;

/// The neighbourhood of all particles at one instant. Points are the water, padding without volume,
/// and the images.
#[derive(Debug)]
pub struct Near {
    path: SimdPath,
    kernel: KernelChoice,
    /// Kernel's support radius, metres.
    radius: f64,
    /// Width of the strips, metres.
    width: f64,
    /// Number of the water's particles.
    water: usize,
    /// x and y of the points, metres.
    pub places: [Vec<f64>; 2],
    /// Their volumes, m².
    pub volume: Vec<f64>,
    /// The particle that each point is or is the image of.
    pub original: Vec<u32>,
    /// The points' records for pair loops, with places in metres and volumes as weights. The scheme
    /// fills in velocities and pressures.
    pub records: Vec<Record>,
    strips: Strips,
    image_strips: Strips,
    team: Team,
    parts: Vec<Part>,
    /// The points, cut into as many parts.
    cuts: Vec<Range<usize>>,
    order: Vec<u32>,
    /// 0, 1, 2, ...: images of equal height keep their order.
    ties: Vec<u32>,
    scratch: Vec<f64>,
    /// Places to be sorted.
    ahead: [Vec<f64>; 2],
}

impl Near {
    /// No points yet, for a kernel with its support radius and a particle spacing, metres.
    pub fn new(path: SimdPath, kernel: KernelChoice, radius: f64, spacing: f64) -> Near {
        Near {
            path,
            kernel,
            radius,
            width: Strips::width(spacing),
            water: 0,
            places: Default::default(),
            volume: Vec::new(),
            original: Vec::new(),
            records: Vec::new(),
            strips: Strips::default(),
            image_strips: Strips::default(),
            team: Team::default(),
            parts: vec![Part::default()],
            cuts: vec![Range::default()],
            order: Vec::new(),
            ties: Vec::new(),
            scratch: Vec::new(),
            ahead: Default::default(),
        }
    }

    /// Sets the team, which is used from the next [`Near::list`] on.
    pub fn take_on(&mut self, team: &Team) {
        self.parts.resize_with(team.parts(), Part::default);
        self.cuts.resize(team.parts(), Range::default());
        self.team = team.clone();
    }

    /// Sorts the particles, and those fields of them that are not empty, by their places after
    /// `time`, seconds. So neighbours lie close together.
    pub fn sort<const N: usize>(
        &mut self,
        fluid: &mut Fluid,
        fields: [&mut Vec<f64>; N],
        time: f64,
    ) {
        let Near { strips, ahead: [x, y], order, scratch, width, .. } = self;
        let n = fluid.len();
        for (ahead, place, velocity) in
            [(&mut *x, &fluid.x, &fluid.vx), (&mut *y, &fluid.y, &fluid.vy)]
        {
            ahead.clear();
            ahead.extend(place.iter().zip(velocity).take(n).map(|(r, u)| r + time * u));
        }
        strips.renew(x, y, &fluid.id[..n], *width, order);
        fluid.reorder(order, scratch);
        for field in fields.into_iter().filter(|field| !field.is_empty()) {
            reorder(field, order, scratch);
        }
    }

    /// Takes this many sorted particles and the images after them; `of` gives place, volume and
    /// original. Lists the neighbours of every particle. `all` is left in the order of the points.
    pub fn list<P: Copy>(
        &mut self,
        water: usize,
        all: &[P],
        points: &mut Vec<P>,
        of: impl Fn(&P) -> ([f64; 2], f64, u32),
    ) {
        let padded = water.next_multiple_of(LANES);
        self.water = water;
        let bounds = self.sort_images(all[water..].iter().map(|image| of(image).0));
        let Near { path, radius, places: [x, y], volume, original, records, .. } = self;
        points.clear();
        points.extend_from_slice(&all[..water]);
        points.extend(all[..water].last().into_iter().cycle().take(padded - water));
        points.extend(self.order.iter().map(|&k| all[water + k as usize]));
        [&mut *x, &mut *y, &mut *volume].into_iter().for_each(Vec::clear);
        original.clear();
        records.clear();
        for (e, ([px, py], of_volume, of_original)) in points.iter().map(of).enumerate() {
            let of_volume = if (water..padded).contains(&e) { 0.0 } else { of_volume };
            x.push(px);
            y.push(py);
            volume.push(of_volume);
            original.push(of_original);
            records.push(Record([px, py, 0.0, 0.0, of_volume, 0.0, 0.0, 0.0]));
        }
        let (strips, image_strips, count) = (&self.strips, &self.image_strips, x.len());
        let set = |strips, range: Range<usize>, bounds| PointSet {
            strips,
            x: &x[range.clone()],
            y: &y[range.clone()],
            offset: 0.0,
            first: range.start as u32,
            reach: *radius,
            bounds,
        };
        let sets =
            [set(strips, 0..water, PointSet::EVERYWHERE), set(image_strips, padded..count, bounds)];
        let ranges = cut(padded / LANES, self.parts.len()).zip(cut(count, self.cuts.len()));
        for ((part, points), (clusters, range)) in
            self.parts.iter_mut().zip(&mut self.cuts).zip(ranges)
        {
            (part.clusters, *points) = (clusters, range);
        }
        self.team.share(&mut self.parts, (), &|part, ()| {
            let lanes = part.lanes();
            build_pair_list(*path, &x[lanes.clone()], &y[lanes], &sets, &mut part.list);
        });
    }

    /// Sorts the places of images; returns their box.
    fn sort_images(&mut self, places: impl Iterator<Item = [f64; 2]>) -> [f64; 4] {
        let Near { image_strips, order, ties, ahead: [x, y], width, .. } = self;
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        x.clear();
        y.clear();
        for [px, py] in places {
            x.push(px);
            y.push(py);
            let [left, right, bottom, top] = bounds;
            bounds = [left.min(px), right.max(px), bottom.min(py), top.max(py)];
        }
        ties.extend(ties.len() as u32..x.len() as u32);
        image_strips.renew(x, y, &ties[..x.len()], *width, order);
        bounds
    }

    /// Points that are in reach of a particle, or nearly so, including itself.
    pub fn around(&self, particle: usize) -> &[u32] {
        let cluster = particle / LANES;
        let part = self.parts.partition_point(|part| part.clusters.end <= cluster);
        let Part { list, clusters, .. } = &self.parts[part];
        &list.entries()[list.range(cluster - clusters.start)]
    }

    /// Number of pairs of a pass.
    pub fn pairs(&self) -> usize {
        LANES * self.parts.iter().map(|part| part.list.len()).sum::<usize>()
    }
}
