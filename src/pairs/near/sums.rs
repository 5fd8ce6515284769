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
    pub(super) fn pair<L: Lanes>(
        [x, y]: [L; 2],
        Record(record): &Record,
        slope: &Eight,
    ) -> Pair<L> {
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

impl<const N: usize, T, F> Task for Sums<'_, T, F>
where
    T: Term<Total = [Eight; N]>,
    F: FnMut(usize, [f64; N]),
{
    type Output = ();

    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // Iterators take longer here.
    fn run<L: Lanes>(mut self) {
        let (near, records, terms) = (self.near, &*self.near.records, self.terms);
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
                let record = &records[e as usize];
                let pair = Near::pair(places, record, slope);
                terms.add(&own, &pair, Other { record, number: e as usize }, &mut sum);
            }
            let sums = T::Sum::<L>::total(&[sum, T::Sum::<L>::nothing()]);
            for lane in 0..LANES.min(near.water - cluster * LANES) {
                let mut own = [0.0; N];
                for n in 0..N {
                    own[n] = sums[n][lane];
                }
                (self.close)(cluster * LANES + lane, own);
            }
        }
    }
}

impl Near {
    /// Sums terms over the neighbours of every particle and hands its sums to `close`.
    pub fn sum<const N: usize>(
        &self,
        terms: impl Term<Total = [Eight; N]>,
        close: impl FnMut(usize, [f64; N]),
    ) {
        dispatch(self.path, Sums { near: self, images_alone: false, terms, close });
    }

    /// Shows terms that sum nothing the pairs of the water with its images.
    pub fn over_images(&self, terms: impl Term<Total = [Eight; 0]>) {
        dispatch(
            self.path,
            Sums { near: self, images_alone: true, terms, close: |_, _: [f64; 0]| () },
        );
    }
}
