//! The precision of pair terms: the type of the numbers, and how particles are read.

use serde::{Deserialize, Serialize};

use crate::math::simd::{LANES, Lanes, Vector};

use super::fields::Here;
use super::record::{Record, SingleRecord, split};

/// Precision of the momentum pass's pair terms; state and sums outside of it are always f64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// Double precision throughout.
    F64,
    /// Single precision: distances, kernel, viscosity, the sums over one cluster's neighbours.
    F32,
}

/// A neighbour in a pair.
#[derive(Clone, Copy)]
pub struct Other<'a, N> {
    /// Its record.
    pub(super) record: &'a N,
    /// Its number among the water and the ghosts.
    pub number: usize,
}

impl<N: Neighbour> Other<'_, N> {
    /// Velocity, m/s.
    #[inline(always)]
    pub fn velocity<V: Vector>(self) -> [V; 2] {
        [self.slot(Record::VX), self.slot(Record::VY)]
    }
    /// Pressure times correction, Pa: xx, xy, yy.
    #[inline(always)]
    pub fn pressure<V: Vector>(self) -> [V; 3] {
        [
            self.slot(Record::PRESSURE),
            self.slot(Record::PRESSURE_XY),
            self.slot(Record::PRESSURE_YY),
        ]
    }
    #[inline(always)]
    fn slot<V: Vector>(self, slot: usize) -> V {
        V::splat(self.record.slot(slot))
    }
    /// Its strain rate, from that of all water.
    #[inline(always)]
    pub fn strain<V: Vector>(self, all: &[[f64; 2]]) -> [V; 2] {
        self.record.strain(all, self.number)
    }
    /// Its value of the field that density diffusion smooths, from that of all water, kg/m³.
    #[inline(always)]
    pub fn diffused<V: Vector>(self, all: &[f64]) -> V {
        self.record.diffused(all, self.number)
    }
}

/// The data of a neighbour for pair loops, in the precision of the pair.
pub trait Neighbour: Copy {
    /// The type of its pairs' numbers.
    type In<L: Lanes>: Vector;
    /// Eight places: x and y, each as one or two numbers.
    fn places<L: Lanes, V: Vector>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2];
    /// Difference of eight places and this neighbour's place, over R.
    fn apart<V: Vector>(&self, places: [[V; 2]; 2]) -> [V; 2];
    /// A number of the record: see [`Record`].
    fn slot(&self, slot: usize) -> f64;
    /// Its strain rate, from that of all water and its number.
    fn strain<V: Vector>(&self, all: &[[f64; 2]], number: usize) -> [V; 2];
    /// Its value of the field that density diffusion smooths, from that of all water and its
    /// number, kg/m³.
    fn diffused<V: Vector>(&self, all: &[f64], number: usize) -> V;
    /// The same of eight particles, given the rest density, kg/m³.
    fn own_diffused<V: Vector>(here: Here, all: &[f64], rest: f64) -> V;
    /// Whether it counts: a ghost without a weight does not.
    #[inline(always)]
    fn counts(&self) -> bool {
        self.slot(Record::WEIGHT) != 0.0
    }
}

impl Neighbour for Record {
    type In<L: Lanes> = L;

    #[inline(always)]
    fn places<L: Lanes, V: Vector>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let zero = V::splat(0.0);
        [[V::load(x), zero], [V::load(y), zero]]
    }
    #[inline(always)]
    fn apart<V: Vector>(&self, [[x, _], [y, _]]: [[V; 2]; 2]) -> [V; 2] {
        [x - V::splat(self.0[Record::X]), y - V::splat(self.0[Record::Y])]
    }
    #[inline(always)]
    fn strain<V: Vector>(&self, all: &[[f64; 2]], number: usize) -> [V; 2] {
        let [stretch, shear] = all[number];
        [V::splat(stretch), V::splat(shear)]
    }
    #[inline(always)]
    fn diffused<V: Vector>(&self, all: &[f64], number: usize) -> V {
        V::splat(all[number])
    }
    #[inline(always)]
    fn own_diffused<V: Vector>(here: Here, all: &[f64], _: f64) -> V {
        here.of(all)
    }
    #[inline(always)]
    fn slot(&self, slot: usize) -> f64 {
        self.0[slot]
    }
}

impl Neighbour for SingleRecord {
    type In<L: Lanes> = L::Single;

    #[inline(always)]
    fn places<L: Lanes, V: Vector>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let [x, x_rest] = split(L::load(x));
        let [y, y_rest] = split(L::load(y));
        [
            [V::load(&x.to_array()), V::load(&x_rest.to_array())],
            [V::load(&y.to_array()), V::load(&y_rest.to_array())],
        ]
    }
    #[inline(always)]
    fn apart<V: Vector>(&self, [x, y]: [[V; 2]; 2]) -> [V; 2] {
        let dx = x[0] - V::splat(self.slot(Record::X));
        let dy = y[0] - V::splat(self.slot(Record::Y));
        [
            dx + (x[1] - V::splat(self.slot(Self::X_REST))),
            dy + (y[1] - V::splat(self.slot(Self::Y_REST))),
        ]
    }
    #[inline(always)]
    fn strain<V: Vector>(&self, _: &[[f64; 2]], _: usize) -> [V; 2] {
        [V::splat(self.slot(Self::STRETCH)), V::splat(self.slot(Self::SHEAR))]
    }
    #[inline(always)]
    fn diffused<V: Vector>(&self, _: &[f64], _: usize) -> V {
        V::splat(self.slot(Self::DIFFUSED))
    }
    #[inline(always)]
    fn own_diffused<V: Vector>(here: Here, all: &[f64], rest: f64) -> V {
        let mut above = *here.eight(all);
        for value in &mut above {
            *value -= rest;
        }
        V::load(&above)
    }
    #[inline(always)]
    fn slot(&self, slot: usize) -> f64 {
        f64::from(self.0[slot])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::{SimdPath, Task, dispatch};

    /// Distances far from the origin, in both precisions.
    struct Apart(Record, [f64; LANES]);

    impl Task for Apart {
        type Output = ([f64; LANES], [f64; LANES]);
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let Apart(record, x) = self;
            let double: [L; 2] = record.apart(Record::places::<L, L>(&x, &x));
            let single = SingleRecord::new::<L>(&record, [0.0; 2], 0.0);
            let places = SingleRecord::places::<L, L::Single>(&x, &x);
            let of: [L::Single; 2] = single.apart(places);
            (double[0].to_array(), of[0].widened().to_array())
        }
    }

    #[test]
    fn distances_in_single_precision_lose_nothing_far_from_the_origin() {
        let x: [f64; LANES] = std::array::from_fn(|k| 813.654_321 + 0.123_456_7 * k as f64);
        let mut record = Record::default();
        record.0[Record::X] = 813.987_654_3;
        for path in [SimdPath::Portable, SimdPath::widest()] {
            let (double, single) = dispatch(path, Apart(record, x));
            for (double, single) in double.iter().zip(single) {
                assert!(
                    (double - single).abs() < 1e-7 * double.abs().max(0.03),
                    "{double} {single}"
                );
            }
        }
    }
}
