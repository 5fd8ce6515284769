//! The precision of pair terms: what a pair loop computes in, and how it reads its particles.

use serde::{Deserialize, Serialize};

use crate::math::simd::{LANES, Lanes};
use crate::particles::{Record, SingleRecord, split};

/// Precision of the momentum pass's pair terms; state and sums outside of it are always f64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// Double precision throughout.
    F64,
    /// Single precision: distances, kernel, viscosity, the sums over one cluster's neighbours.
    F32,
}

/// A precision of pair terms.
pub(super) trait Pairing: Copy + 'static {
    /// What pair terms are computed in.
    type In<L: Lanes>: Lanes;
    /// What is read of a neighbour.
    type Neighbour: Neighbour;
}

/// What a pair loop reads of a neighbour.
pub(super) trait Neighbour: Copy {
    /// Eight places: x and y, each as one or two numbers.
    fn places<V: Lanes>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2];
    /// From this neighbour to eight places, over R.
    fn apart<V: Lanes>(&self, places: [[V; 2]; 2]) -> [V; 2];
    /// Velocity, m/s.
    fn velocity<V: Lanes>(&self) -> [V; 2];
    /// See [`Record::WEIGHT`].
    fn weight<V: Lanes>(&self) -> V;
    /// Whether there is a weight at all.
    fn counts(&self) -> bool;
    /// Pressure times correction, Pa: xx, xy, yy.
    fn pressure<V: Lanes>(&self) -> [V; 3];
    /// Its strain, given that of double precision.
    fn strain<V: Lanes>(&self, strain: &[f64; 2]) -> [V; 2];
}

/// Double precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct Double;

impl Pairing for Double {
    type In<L: Lanes> = L;
    type Neighbour = Record;
}

impl Neighbour for Record {
    #[inline(always)]
    fn places<V: Lanes>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let zero = V::splat(0.0);
        [[V::load(x), zero], [V::load(y), zero]]
    }
    #[inline(always)]
    fn apart<V: Lanes>(&self, [[x, _], [y, _]]: [[V; 2]; 2]) -> [V; 2] {
        [x - V::splat(self.0[Record::X]), y - V::splat(self.0[Record::Y])]
    }
    #[inline(always)]
    fn velocity<V: Lanes>(&self) -> [V; 2] {
        [V::splat(self.0[Record::VX]), V::splat(self.0[Record::VY])]
    }
    #[inline(always)]
    fn weight<V: Lanes>(&self) -> V {
        V::splat(self.0[Record::WEIGHT])
    }
    #[inline(always)]
    fn counts(&self) -> bool {
        self.0[Record::WEIGHT] != 0.0
    }
    #[inline(always)]
    fn pressure<V: Lanes>(&self) -> [V; 3] {
        let of = |slot: usize| V::splat(self.0[slot]);
        [of(Record::PRESSURE), of(Record::PRESSURE_XY), of(Record::PRESSURE_YY)]
    }
    #[inline(always)]
    fn strain<V: Lanes>(&self, strain: &[f64; 2]) -> [V; 2] {
        [V::splat(strain[0]), V::splat(strain[1])]
    }
}

/// Single precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct Single;

impl Pairing for Single {
    type In<L: Lanes> = L::Single;
    type Neighbour = SingleRecord;
}

impl Neighbour for SingleRecord {
    #[inline(always)]
    fn places<V: Lanes>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let halves = |places: &[f64; LANES]| {
            let mut halves = [[0.0; LANES]; 2];
            for lane in 0..LANES {
                [halves[0][lane], halves[1][lane]] = split(places[lane]);
            }
            [V::load_single(&halves[0]), V::load_single(&halves[1])]
        };
        [halves(x), halves(y)]
    }
    #[inline(always)]
    fn apart<V: Lanes>(&self, [x, y]: [[V; 2]; 2]) -> [V; 2] {
        let of = |place: [V; 2], of: &[f32; 2]| {
            (place[0] - V::splat_single(of[0])) + (place[1] - V::splat_single(of[1]))
        };
        [of(x, &self.x), of(y, &self.y)]
    }
    #[inline(always)]
    fn velocity<V: Lanes>(&self) -> [V; 2] {
        [V::splat_single(self.velocity[0]), V::splat_single(self.velocity[1])]
    }
    #[inline(always)]
    fn weight<V: Lanes>(&self) -> V {
        V::splat_single(self.weight)
    }
    #[inline(always)]
    fn counts(&self) -> bool {
        self.weight != 0.0
    }
    #[inline(always)]
    fn pressure<V: Lanes>(&self) -> [V; 3] {
        let of = |part: usize| V::splat_single(self.pressure[part]);
        [of(0), of(1), of(2)]
    }
    #[inline(always)]
    fn strain<V: Lanes>(&self, _: &[f64; 2]) -> [V; 2] {
        [V::splat_single(self.strain[0]), V::splat_single(self.strain[1])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::{SimdPath, Task, dispatch};

    /// Distances far from the origin, in both precisions.
    struct Apart(Record, [f64; LANES]);

    impl Task for Apart {
        type Output = [[f64; LANES]; 2];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let Apart(record, x) = self;
            let double = record.apart::<L>(Record::places(&x, &x))[0].to_array();
            struct InSingle(SingleRecord, [f64; LANES]);
            impl Task for InSingle {
                type Output = [f64; LANES];
                #[inline(always)]
                fn run<V: Lanes>(self) -> Self::Output {
                    self.0.apart::<V>(SingleRecord::places(&self.1, &self.1))[0].to_array()
                }
            }
            [double, L::Single::call(InSingle(SingleRecord::new(&record, [0.0; 2]), x))]
        }
    }

    #[test]
    fn distances_in_single_precision_lose_nothing_far_from_the_origin() {
        let x: [f64; LANES] = std::array::from_fn(|k| 813.654_321 + 0.123_456_7 * k as f64);
        let mut record = Record::default();
        record.0[Record::X] = 813.987_654_3;
        for path in [SimdPath::Portable, SimdPath::widest()] {
            let [double, single] = dispatch(path, Apart(record, x));
            for (double, single) in double.iter().zip(single) {
                assert!(
                    (double - single).abs() < 1e-7 * double.abs().max(0.03),
                    "{double} {single}"
                );
            }
        }
    }
}
