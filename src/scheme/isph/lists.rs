//! Who is near whom: the water and its images in strips, and one list for every eight particles.

use super::Isph;
use super::images::{Point, Points};
use super::state::Operators;
use crate::math::simd::{LANES, Lanes};
use crate::pairs::reorder;
use crate::pairs::{PairList, PointSet, Strips, build_pair_list};

/// What a pair loop reads of a point: one cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub(super) struct Numbers {
    /// Place, m.
    pub place: [f64; 2],
    /// Velocity, m/s, or another vector of that kind.
    pub velocity: [f64; 2],
    /// p L, or the strain of the velocity: symmetric tensors by xx, xy, yy.
    pub tensor: [f64; 3],
    /// m².
    pub volume: f64,
}

/// The neighbourhood of all particles in the middle of a step.
#[derive(Debug, Default)]
pub(super) struct Near {
    pub strips: Strips,
    pub image_strips: Strips,
    pub points: Points,
    /// The water and then its images, of every eight particles.
    pub pairs: PairList,
    /// F of every entry with the eight.
    pub weights: Vec<[f64; LANES]>,
    order: Vec<u32>,
    /// 0, 1, 2, ...: images of one height keep their order.
    ties: Vec<u32>,
    scratch: Vec<f64>,
    /// Places to be sorted.
    ahead: [Vec<f64>; 2],
}

impl Near {
    /// The lists, with operators that belong to them.
    pub fn lists<'a>(&'a self, operators: &'a Operators) -> Lists<'a> {
        Lists {
            pairs: &self.pairs,
            weights: &self.weights,
            points: &self.points,
            sway: &operators.sway,
            correction: &operators.correction,
        }
    }
}

/// Lists of neighbours, one for every eight particles, with what belongs to them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lists<'a> {
    pub pairs: &'a PairList,
    /// F of each of the eight with every entry; zero out of reach.
    pub weights: &'a [[f64; LANES]],
    pub points: &'a Points,
    /// Σ F Δ.
    pub sway: &'a [[f64; 2]],
    /// L.
    pub correction: &'a [[f64; 3]],
}

impl<'a> Lists<'a> {
    /// Where the eight lie.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, cluster: usize) -> [L; 2] {
        [load(&self.points.x, cluster), load(&self.points.y, cluster)]
    }

    /// Their entries: points, with the weights of each.
    #[inline(always)]
    pub fn of(&self, cluster: usize) -> (&'a [u32], &'a [[f64; LANES]]) {
        let range = self.pairs.range(cluster);
        (&self.pairs.entries()[range.clone()], &self.weights[range])
    }

    /// The images among them.
    #[inline(always)]
    pub fn images_of(&self, cluster: usize) -> (&'a [u32], &'a [[f64; LANES]]) {
        let near = self.pairs.group(cluster, 1);
        (near, &self.weights[self.pairs.start(cluster, 1)..][..near.len()])
    }
}

/// Values of the eight, of a field that is padded to whole vectors.
#[inline(always)]
pub(super) fn load<L: Lanes>(field: &[f64], cluster: usize) -> L {
    L::load(field[cluster * LANES..].first_chunk().unwrap())
}

impl Isph {
    /// Puts the particles into the order of the places that they will have in the middle of the
    /// step, so that eight in a row lie close together.
    pub(super) fn sort(&mut self, dt: f64) {
        let (fluid, carried) = (&mut self.fluid, &mut self.carried);
        let Near { strips, ahead: [x, y], order, scratch, .. } = &mut self.near;
        let n = fluid.len();
        for (ahead, place, velocity) in
            [(&mut *x, &fluid.x, &fluid.vx), (&mut *y, &fluid.y, &fluid.vy)]
        {
            ahead.clear();
            ahead.extend(place.iter().zip(velocity).take(n).map(|(r, u)| r + 0.5 * dt * u));
        }
        strips.renew(x, y, &fluid.id[..n], Strips::width(self.options.spacing), order);
        fluid.reorder(order, scratch);
        for field in [
            &mut carried.pressure,
            &mut carried.older_pressure,
            &mut carried.aim,
            &mut carried.response,
        ] {
            if !field.is_empty() {
                reorder(field, order, scratch);
            }
        }
    }

    /// Sorts the images and lists the neighbours of every eight particles.
    pub(super) fn list_neighbours(&mut self) {
        let (n, padded) = (self.fluid.len(), self.fluid.padded_len());
        let (water, images) = self.loose.split_at(n);
        let Near { strips, image_strips, points, pairs, order, ties, ahead: [x, y], .. } =
            &mut self.near;
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        x.clear();
        y.clear();
        for Point { place: [px, py], .. } in images {
            x.push(*px);
            y.push(*py);
            let [left, right, bottom, top] = bounds;
            bounds = [left.min(*px), right.max(*px), bottom.min(*py), top.max(*py)];
        }
        ties.extend(ties.len() as u32..images.len() as u32);
        let width = Strips::width(self.options.spacing);
        image_strips.renew(x, y, &ties[..images.len()], width, order);
        points.clear();
        water.iter().for_each(|point| points.push(point));
        for _ in n..padded {
            points.push(&Point { volume: 0.0, ..water[n - 1] });
        }
        order.iter().for_each(|&k| points.push(&images[k as usize]));
        let set = |strips, range: std::ops::Range<usize>, bounds| PointSet {
            strips,
            x: &points.x[range.clone()],
            y: &points.y[range.clone()],
            offset: 0.0,
            first: range.start as u32,
            reach: self.options.support_radius,
            bounds,
        };
        let sets = [
            set(strips, 0..n, PointSet::EVERYWHERE),
            set(image_strips, padded..points.len(), bounds),
        ];
        build_pair_list(self.path, &points.x[..padded], &points.y[..padded], &sets, pairs);
        self.numbers.clear();
        self.numbers.extend((0..points.len()).map(|e| Numbers {
            place: [points.x[e], points.y[e]],
            volume: points.volume[e],
            ..Numbers::default()
        }));
    }
}
