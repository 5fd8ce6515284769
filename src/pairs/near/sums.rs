//! Sums of terms over the pairs that were weighed.

use super::Near;
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::fields::Here;
use crate::pairs::geometry::Pair;
use crate::pairs::precision::Other;
use crate::pairs::record::Record;
use crate::pairs::term::{Eight, Sum, Term};

impl Near {
    /// The pairs of eight particles: the whole list, or the images alone.
    #[inline(always)]
    fn listed(&self, cluster: usize, images_alone: bool) -> (&[u32], &[Eight]) {
        let mut range = self.list.range(cluster);
        if images_alone {
            range.start = self.list.start(cluster, 1);
        }
        (&self.list.entries()[range.clone()], &self.slopes[range])
    }

    /// Eight places.
    #[inline(always)]
    pub(super) fn eight<L: Lanes>(&self, here: Here) -> [L; 2] {
        here.all([&self.places[0], &self.places[1]])
    }

    /// The pairs of eight places with a point.
    #[inline(always)]
    pub(super) fn pair<L: Lanes>(&self, [x, y]: [L; 2], e: u32, slope: &Eight) -> Pair<L> {
        let record = &self.records[e as usize].0;
        let (dx, dy) = (x - L::splat(record[Record::X]), y - L::splat(record[Record::Y]));
        Pair::weighed(dx, dy, L::load(slope))
    }
}

struct Sums<'a, T, F> {
    near: &'a Near,
    images_alone: bool,
    terms: T,
    close: F,
}

impl<T: Term, F: FnMut(usize, T::Total)> Task for Sums<'_, T, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let (near, terms) = (self.near, self.terms);
        for cluster in 0..near.list.clusters() {
            let (entries, slopes) = near.listed(cluster, self.images_alone);
            if self.images_alone && entries.is_empty() {
                continue;
            }
            let here = Here::new(cluster, cluster);
            let places = near.eight::<L>(here);
            let own = terms.own::<L, Record>(here);
            let mut sum = T::Sum::<L>::nothing();
            for (&e, slope) in entries.iter().zip(slopes) {
                let pair = near.pair(places, e, slope);
                let other = Other { record: &near.records[e as usize], number: e as usize };
                terms.add(&own, &pair, other, &mut sum);
            }
            (self.close)(cluster, T::Sum::<L>::total(&[sum, T::Sum::<L>::nothing()]));
        }
    }
}

impl Near {
    /// Sums terms over the neighbours of every particle and hands its sums to `close`.
    pub fn sum<const N: usize>(
        &self,
        terms: impl Term<Total = [Eight; N]>,
        mut close: impl FnMut(usize, [f64; N]),
    ) {
        let close = |cluster: usize, sums: [Eight; N]| {
            for lane in 0..LANES.min(self.water - cluster * LANES) {
                let mut own = [0.0; N];
                for n in 0..N {
                    own[n] = sums[n][lane];
                }
                close(cluster * LANES + lane, own);
            }
        };
        dispatch(self.path, Sums { near: self, images_alone: false, terms, close });
    }

    /// Shows terms the pairs of the water with its images.
    pub fn over_images(&self, terms: impl Term) {
        dispatch(self.path, Sums { near: self, images_alone: true, terms, close: |_, _| {} });
    }
}
