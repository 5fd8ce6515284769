//! Sums over the held pairs of eight particles, without distances or the kernel.

use std::ops::RangeInclusive;

use super::factors::Factors;
use super::fields::Here;
use super::flow::{Flow, FlowSums};
use super::geometry::Pair;
use super::held::{HeldPairs, Product, Slopes};
use super::parts::Tally;
use super::precision::{Neighbour, Other};
use super::record::Record;
use super::term::{Eight, Sum, Term, loaded};
use crate::math::simd::{LANES, Lanes, Task};

/// The held pairs of eight particles.
pub struct Held<'a, 'p> {
    pub(super) pairs: &'p HeldPairs,
    pub(super) near: &'a mut std::slice::Iter<'p, [Eight; 2]>,
    /// Sums over all particles.
    pub tally: &'a mut Tally,
    pub(super) here: Here,
}

impl Held<'_, '_> {
    /// Whether any ghosts of a body are in reach.
    #[inline(always)]
    pub fn reaches(&self, body: usize) -> bool {
        !self.pairs.group(self.here.list, body + 1).0.is_empty()
    }

    /// Σ V_j ∇W over the next body's ghosts that are in reach.
    #[inline(always)]
    pub fn next_gradient<D: Lanes>(&mut self) -> [D; 2] {
        let [x, y] = self.near.next().expect("as many as bodies are reached");
        [D::load(x), D::load(y)]
    }

    /// Σ g f over the water (group 0) or a body's ghosts (from 1 on), for the first numbers f of
    /// each neighbour.
    #[inline(always)]
    pub fn sum<D: Lanes, const N: usize>(&self, group: usize, factors: &[Factors]) -> [D; N] {
        let (pairs, cluster) = (self.pairs, self.here.list);
        loaded(&D::call(Product::<N> { pairs, factors, cluster, group }))
    }

    /// Sums of the flow over some groups: the water (0) and bodies' ghosts (from 1 on).
    #[inline(always)]
    pub fn flow<D: Lanes>(
        &self,
        flow: Flow,
        factors: &[Factors],
        groups: RangeInclusive<usize>,
    ) -> FlowSums {
        let mut sums = [[0.0; LANES]; 8];
        for group in groups {
            if group == 0 || self.reaches(group - 1) {
                flow.add::<D>(&mut sums, (self.pairs, factors), self.here.list, group);
            }
        }
        FlowSums::new(flow, sums)
    }

    /// Sums of terms over the water (group 0) or a body's ghosts (from 1 on), if any are in reach.
    /// Places are those of the records.
    #[inline(always)]
    pub fn terms<D: Lanes, T: Term>(
        &self,
        group: usize,
        places: [&[f64]; 2],
        records: &[Record],
        terms: T,
    ) -> Option<T::Total> {
        let (here, (entries, slopes)) = (self.here, self.pairs.group(self.here.list, group));
        if entries.is_empty() {
            return None;
        }
        Some(D::call(HeldGroup { here, places, records, terms, entries, slopes }))
    }
}

/// The loop over one group of held pairs.
struct HeldGroup<'a, T> {
    here: Here,
    places: [&'a [f64]; 2],
    records: &'a [Record],
    terms: T,
    entries: &'a [u32],
    slopes: &'a [Slopes],
}

impl<T: Term> Task for HeldGroup<'_, T> {
    type Output = T::Total;

    #[inline(always)]
    fn run<L: Lanes>(self) -> T::Total {
        let HeldGroup { here, places: [x, y], records, terms, entries, slopes } = self;
        let places = Record::places::<L, L>(here.eight(x), here.eight(y));
        let own = terms.own::<L, Record>(here);
        let mut sum = T::Sum::<L>::nothing();
        for (&j, slope) in entries.iter().zip(slopes) {
            let record = &records[j as usize];
            let [dx, dy] = record.apart(places);
            let pair = Pair::weighed(dx, dy, L::load_single(&slope.0));
            terms.add(&own, &pair, Other { record, number: j as usize }, &mut sum);
        }
        T::Sum::<L>::total(&[sum, T::Sum::<L>::nothing()])
    }
}
