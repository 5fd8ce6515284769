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

/// Lists of neighbours, one for every eight particles, with what belongs to them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lists<'a> {
    /// The water and then its images.
    pub pairs: &'a PairList,
    /// F of each of the eight with every entry; zero out of reach.
    pub weights: &'a [[f64; LANES]],
    /// Places of the particles, padded to whole vectors, m.
    pub places: [&'a [f64]; 2],
    /// Σ F Δ.
    pub sway: &'a [[f64; 2]],
    /// L.
    pub correction: &'a [[f64; 3]],
}

impl<'a> Lists<'a> {
    pub fn new(
        pairs: &'a PairList,
        weights: &'a [[f64; LANES]],
        points: &'a Points,
        operators: &'a Operators,
    ) -> Lists<'a> {
        let padded = LANES * pairs.clusters();
        Lists {
            pairs,
            weights,
            places: [&points.x[..padded], &points.y[..padded]],
            sway: &operators.sway,
            correction: &operators.correction,
        }
    }

    /// Where the eight lie.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, cluster: usize) -> [L; 2] {
        let [x, y] = self.places;
        [load(x, cluster), load(y, cluster)]
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

/// Vectors of the eight; those past the last particle repeat it.
#[inline(always)]
pub(super) fn own<L: Lanes>(field: &[[f64; 2]], cluster: usize) -> [L; 2] {
    let mut values = [[0.0; LANES]; 2];
    for lane in 0..LANES {
        let [x, y] = field[(cluster * LANES + lane).min(field.len() - 1)];
        (values[0][lane], values[1][lane]) = (x, y);
    }
    [L::load(&values[0]), L::load(&values[1])]
}

impl Isph {
    /// Puts the particles into the order of the places that they will have in the middle of the
    /// step, so that eight in a row lie close together.
    pub(super) fn sort(&mut self, dt: f64) {
        let n = self.fluid.len();
        let fluid = &self.fluid;
        let [x, y] = &mut self.ahead;
        for (ahead, place, velocity) in [(x, &fluid.x, &fluid.vx), (y, &fluid.y, &fluid.vy)] {
            ahead.clear();
            ahead.extend(place.iter().zip(velocity).take(n).map(|(r, u)| r + 0.5 * dt * u));
        }
        let width = Strips::width(self.options.spacing);
        let [x, y] = &self.ahead;
        let mut order = std::mem::take(&mut self.order);
        self.strips.renew(x, y, &self.fluid.id[..n], width, &mut order);
        self.fluid.reorder(&order, &mut self.scratch);
        let carried = &mut self.carried;
        for field in [
            &mut carried.pressure,
            &mut carried.older_pressure,
            &mut carried.aim,
            &mut carried.response,
        ] {
            if !field.is_empty() {
                reorder(field, &order, &mut self.scratch);
            }
        }
        self.order = order;
    }

    /// Sorts the images and lists the neighbours of every eight particles.
    pub(super) fn list_neighbours(&mut self) {
        let (n, padded) = (self.fluid.len(), self.fluid.padded_len());
        let (water, images) = self.loose.split_at(n);
        let [x, y] = &mut self.ahead;
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        x.clear();
        y.clear();
        for Point { place: [px, py], .. } in images {
            x.push(*px);
            y.push(*py);
            let [left, right, bottom, top] = bounds;
            bounds = [left.min(*px), right.max(*px), bottom.min(*py), top.max(*py)];
        }
        let width = Strips::width(self.options.spacing);
        self.ties.extend(self.ties.len() as u32..images.len() as u32);
        self.image_strips.renew(x, y, &self.ties[..images.len()], width, &mut self.order);
        let points = &mut self.points;
        points.clear();
        water.iter().for_each(|point| points.push(point));
        for _ in n..padded {
            points.push(&Point { volume: 0.0, ..water[n - 1] });
        }
        self.order.iter().for_each(|&k| points.push(&images[k as usize]));
        let (all, reach) = (points.len(), self.options.support_radius);
        let sets = [
            PointSet {
                strips: &self.strips,
                x: &points.x[..n],
                y: &points.y[..n],
                offset: 0.0,
                first: 0,
                reach,
                bounds: PointSet::EVERYWHERE,
            },
            PointSet {
                strips: &self.image_strips,
                x: &points.x[padded..all],
                y: &points.y[padded..all],
                offset: 0.0,
                first: padded as u32,
                reach,
                bounds,
            },
        ];
        let (x, y) = (&points.x[..padded], &points.y[..padded]);
        build_pair_list(self.path, x, y, &sets, &mut self.pairs);
        self.numbers.clear();
        self.numbers.extend((0..all).map(|e| Numbers {
            place: [points.x[e], points.y[e]],
            volume: points.volume[e],
            ..Numbers::default()
        }));
    }

    /// The lists with what belongs to them.
    pub(super) fn lists(&self) -> Lists<'_> {
        Lists::new(&self.pairs, &self.weights, &self.points, &self.operators)
    }
}
