//! Sums of terms over the pairs that were weighed.

use super::part::Part;
use super::{Near, Values};
use crate::math::simd::{LANES, Lanes, Task, dispatch};
use crate::pairs::fields::Here;
use crate::pairs::geometry::Pair;
use crate::pairs::precision::Other;
use crate::pairs::record::Record;
use crate::pairs::term::{Eight, Sum, Term};

impl Near {
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

struct Sums<'a, T, R, F> {
    near: &'a Near,
    part: &'a Part,
    images_alone: bool,
    terms: T,
    values: R,
    close: &'a F,
}

impl<const N: usize, T, R, F> Task for Sums<'_, T, R, F>
where
    T: Term<Total = [Eight; N]>,
    R: Values,
    F: Fn(usize, [f64; N]) -> R::Value,
{
    type Output = ();

    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // Iterators take longer here.
    fn run<L: Lanes>(mut self) {
        let (near, records, terms) = (self.near, &*self.near.records, self.terms);
        for (place, cluster) in self.part.clusters.clone().enumerate() {
            let (entries, slopes) = self.part.listed(place, self.images_alone);
            if self.images_alone && entries.is_empty() {
                continue;
            }
            let here = Here::new(cluster, place);
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
                let value = (self.close)(cluster * LANES + lane, own);
                self.values.put(place * LANES + lane, value);
            }
        }
    }
}

impl Near {
    /// Sums terms over the neighbours of every particle, and writes what `close` makes of the sums.
    pub fn sum<const N: usize, R: Values>(
        &self,
        terms: impl Term<Total = [Eight; N]> + Sync,
        values: R,
        close: impl Fn(usize, [f64; N]) -> R::Value + Sync,
    ) {
        self.team.read(&self.parts, values, &|part, values| {
            let (near, close) = (self, &close);
            dispatch(self.path, Sums { near, part, images_alone: false, terms, values, close });
        });
    }

    /// Visits the pairs of the water with its images in order, for terms without sums.
    pub fn over_images(&self, terms: impl Term<Total = [Eight; 0]>) {
        for part in &self.parts {
            let (near, values, close) = (self, (), &|_, _: [f64; 0]| ());
            dispatch(self.path, Sums { near, part, images_alone: true, terms, values, close });
        }
    }
}
