//! The precision of pair terms: what a pair loop computes in, and how it reads its particles.

use serde::{Deserialize, Serialize};

use crate::math::simd::{LANES, Lanes, Pairs};
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
    type In<L: Lanes>: Pairs;
    /// What is read of a neighbour.
    type Neighbour: Neighbour;
}

/// What a pair loop reads of neighbours, one or two at once.
pub(super) trait Neighbour: Copy {
    /// Eight places: x and y, each as one or two numbers.
    fn places<L: Lanes, V: Pairs>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2];
    /// From these neighbours to eight places, over R.
    fn apart<V: Pairs>(these: [&Self; 2], places: [[V; 2]; 2]) -> [V; 2];
    /// Velocities, m/s.
    fn velocity<V: Pairs>(these: [&Self; 2]) -> [V; 2];
    /// See [`Record::WEIGHT`].
    fn weight<V: Pairs>(these: [&Self; 2]) -> V;
    /// Whether there is a weight at all.
    fn counts(&self) -> bool;
    /// Pressure times correction, Pa: xx, xy, yy.
    fn pressure<V: Pairs>(these: [&Self; 2]) -> [V; 3];
    /// Their strain, given that of all water and their numbers.
    fn strain<V: Pairs>(these: [&Self; 2], all: &[[f64; 2]], numbers: [u32; 2]) -> [V; 2];
    /// What density diffusion smooths of them, given that of all water and their numbers, kg/m³.
    fn diffused<V: Pairs>(these: [&Self; 2], all: &[f64], numbers: [u32; 2]) -> V;
    /// The same of eight particles, given the rest density, kg/m³.
    fn own_diffused<V: Pairs>(values: &[f64; LANES], rest: f64) -> V;
}

/// Double precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct Double;

impl Pairing for Double {
    type In<L: Lanes> = L;
    type Neighbour = Record;
}

/// A number of each of two records.
#[inline(always)]
fn slot<V: Pairs>([a, b]: [&Record; 2], slot: usize) -> V {
    V::of_neighbours([a.0[slot], b.0[slot]])
}

impl Neighbour for Record {
    #[inline(always)]
    fn places<L: Lanes, V: Pairs>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let zero = V::splat(0.0);
        [[V::of_particles(x), zero], [V::of_particles(y), zero]]
    }
    #[inline(always)]
    fn apart<V: Pairs>(these: [&Self; 2], [[x, _], [y, _]]: [[V; 2]; 2]) -> [V; 2] {
        [x - slot(these, Record::X), y - slot(these, Record::Y)]
    }
    #[inline(always)]
    fn velocity<V: Pairs>(these: [&Self; 2]) -> [V; 2] {
        [slot(these, Record::VX), slot(these, Record::VY)]
    }
    #[inline(always)]
    fn weight<V: Pairs>(these: [&Self; 2]) -> V {
        slot(these, Record::WEIGHT)
    }
    #[inline(always)]
    fn counts(&self) -> bool {
        self.0[Record::WEIGHT] != 0.0
    }
    #[inline(always)]
    fn pressure<V: Pairs>(these: [&Self; 2]) -> [V; 3] {
        [
            slot(these, Record::PRESSURE),
            slot(these, Record::PRESSURE_XY),
            slot(these, Record::PRESSURE_YY),
        ]
    }
    #[inline(always)]
    fn strain<V: Pairs>(_: [&Self; 2], all: &[[f64; 2]], [a, b]: [u32; 2]) -> [V; 2] {
        let (a, b) = (all[a as usize], all[b as usize]);
        [V::of_neighbours([a[0], b[0]]), V::of_neighbours([a[1], b[1]])]
    }
    #[inline(always)]
    fn diffused<V: Pairs>(_: [&Self; 2], all: &[f64], [a, b]: [u32; 2]) -> V {
        V::of_neighbours([all[a as usize], all[b as usize]])
    }
    #[inline(always)]
    fn own_diffused<V: Pairs>(values: &[f64; LANES], _: f64) -> V {
        V::of_particles(values)
    }
}

/// Single precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct Single;

impl Pairing for Single {
    type In<L: Lanes> = L::Single;
    type Neighbour = SingleRecord;
}

/// A number of each of two records.
#[inline(always)]
fn single<const SLOT: usize, V: Pairs>([a, b]: [&SingleRecord; 2]) -> V {
    V::out_of::<SLOT>([&a.0, &b.0])
}

impl Neighbour for SingleRecord {
    #[inline(always)]
    fn places<L: Lanes, V: Pairs>(x: &[f64; LANES], y: &[f64; LANES]) -> [[V; 2]; 2] {
        let [x, x_rest] = split(L::load(x));
        let [y, y_rest] = split(L::load(y));
        [
            [V::of_particles(&x.to_array()), V::of_particles(&x_rest.to_array())],
            [V::of_particles(&y.to_array()), V::of_particles(&y_rest.to_array())],
        ]
    }
    #[inline(always)]
    fn apart<V: Pairs>(these: [&Self; 2], [x, y]: [[V; 2]; 2]) -> [V; 2] {
        let dx = x[0] - single::<{ Record::X }, V>(these);
        let dy = y[0] - single::<{ Record::Y }, V>(these);
        [
            dx + (x[1] - single::<{ Self::X_REST }, V>(these)),
            dy + (y[1] - single::<{ Self::Y_REST }, V>(these)),
        ]
    }
    #[inline(always)]
    fn velocity<V: Pairs>(these: [&Self; 2]) -> [V; 2] {
        [single::<{ Record::VX }, V>(these), single::<{ Record::VY }, V>(these)]
    }
    #[inline(always)]
    fn weight<V: Pairs>(these: [&Self; 2]) -> V {
        single::<{ Record::WEIGHT }, V>(these)
    }
    #[inline(always)]
    fn counts(&self) -> bool {
        self.0[Record::WEIGHT] != 0.0
    }
    #[inline(always)]
    fn pressure<V: Pairs>(these: [&Self; 2]) -> [V; 3] {
        [
            single::<{ Record::PRESSURE }, V>(these),
            single::<{ Record::PRESSURE_XY }, V>(these),
            single::<{ Record::PRESSURE_YY }, V>(these),
        ]
    }
    #[inline(always)]
    fn strain<V: Pairs>(these: [&Self; 2], _: &[[f64; 2]], _: [u32; 2]) -> [V; 2] {
        [single::<{ Self::STRETCH }, V>(these), single::<{ Self::SHEAR }, V>(these)]
    }
    #[inline(always)]
    fn diffused<V: Pairs>(these: [&Self; 2], _: &[f64], _: [u32; 2]) -> V {
        single::<{ Self::DIFFUSED }, V>(these)
    }
    #[inline(always)]
    fn own_diffused<V: Pairs>(values: &[f64; LANES], rest: f64) -> V {
        let mut above = *values;
        for value in &mut above {
            *value -= rest;
        }
        V::of_particles(&above)
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
            let double: [L; 2] = Record::apart([&record; 2], Record::places::<L, L>(&x, &x));
            let single = SingleRecord::new::<L>(&record, [0.0; 2], 0.0);
            let places = SingleRecord::places::<L, L::Single>(&x, &x);
            let of: [L::Single; 2] = SingleRecord::apart([&single; 2], places);
            let both = L::Single::whole(of[0].add_to(L::Single::nothing()));
            let at_once = L::Single::NEIGHBOURS as f64;
            (double[0].to_array(), both.map(|sum| sum / at_once))
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
