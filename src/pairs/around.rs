//! Sums over the neighbours of eight particles whose geometry is not yet known.

use super::fields::Here;
use super::geometry::{CHUNK, Fill, Geometry};
use super::held::{AHEAD, HeldPairs, Slopes, prefetch_first_reached};
use super::pair_list::PairList;
use super::parts::Tally;
use super::precision::{Neighbour, Other};
use super::record::{Record, SingleRecord};
use super::term::{Eight, Exact, Sum, Term};
use crate::kernel::KernelChoice;
use crate::math::simd::{Lanes, Task, Vector};
use crate::with_kernel;

/// Records of the water and its ghosts, in the precision that pairs are computed in.
#[derive(Clone, Copy)]
pub enum Records<'a> {
    /// Double precision.
    Double(&'a [Record]),
    /// Single precision.
    Single(&'a [SingleRecord]),
}

/// The data of all particles and ghosts for full passes.
#[derive(Clone, Copy)]
pub struct Neighbours<'a> {
    /// The kernel.
    pub kernel: KernelChoice,
    /// x and y of the water over R.
    pub places: [&'a [f64]; 2],
    /// The water's records, then those of the ghosts.
    pub records: Records<'a>,
    /// How many bodies have ghosts.
    pub bodies: usize,
}

/// Sums over pairs.
pub struct Sums<T: Term> {
    /// Σ V_j ∇W.
    pub gradient: [Eight; 2],
    /// The sums of the terms.
    pub terms: T::Total,
    /// How many neighbours are in reach.
    count: usize,
}

/// The neighbours of eight particles: first the water, then the ghosts of one body after another.
/// Pairs in reach are held for the passes that follow.
pub struct Around<'a> {
    pub(super) neighbours: &'a Neighbours<'a>,
    pub(super) pairs: &'a PairList,
    pub(super) held: &'a mut HeldPairs,
    pub(super) near: &'a mut Vec<[Eight; 2]>,
    /// Sums over all particles.
    pub tally: &'a mut Tally,
    pub(super) here: Here,
}

impl Around<'_> {
    /// How many bodies have ghosts.
    pub fn bodies(&self) -> usize {
        self.neighbours.bodies
    }

    /// Sums over the water. Must be called first.
    #[inline(always)]
    pub fn water<D: Lanes, T: Term>(&mut self, terms: T) -> Sums<T> {
        let entries = self.pairs.group(self.here.list, 0);
        self.group::<D, T>(entries, terms)
    }

    /// Sums over a body's ghosts, if any are near. Must be called for each body in turn.
    #[inline(always)]
    pub fn ghosts<D: Lanes, T: Term>(&mut self, body: usize, terms: T) -> Option<Sums<T>> {
        let entries = self.pairs.group(self.here.list, body + 1);
        if entries.is_empty() {
            self.held.close(0);
            return None;
        }
        let sums = self.group::<D, T>(entries, terms);
        if sums.count > 0 {
            self.near.push(sums.gradient);
        }
        Some(sums)
    }

    #[inline(always)]
    fn group<D: Lanes, T: Term>(&mut self, entries: &[u32], terms: T) -> Sums<T> {
        let Neighbours { kernel, places, records, .. } = *self.neighbours;
        let (room, here) = (self.held.room(entries.len()), self.here);
        let sums = match records {
            Records::Double(records) => {
                D::call(Group { kernel, places, records, terms, entries, room, here })
            }
            Records::Single(records) => {
                D::call(Group { kernel, places, records, terms, entries, room, here })
            }
        };
        self.held.close(sums.count);
        sums
    }
}

/// The loop over one group of neighbours.
struct Group<'a, N, T> {
    kernel: KernelChoice,
    places: [&'a [f64]; 2],
    records: &'a [N],
    terms: T,
    /// The listed neighbours, and memory for those in reach.
    entries: &'a [u32],
    room: (&'a mut [u32], &'a mut [Slopes]),
    here: Here,
}

impl<N: Neighbour, T: Term> Task for Group<'_, N, T> {
    type Output = Sums<T>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Sums<T> {
        self.sums::<L, N::In<L>>()
    }
}

impl<N: Neighbour, T: Term> Group<'_, N, T> {
    #[inline(always)]
    fn sums<L: Lanes, R: Vector>(self) -> Sums<T> {
        let Group { kernel, places: [x, y], records, terms, entries, room, here } = self;
        let places = N::places::<L, R>(here.eight(x), here.eight(y));
        let own = terms.own::<R, N>(here);
        prefetch_first_reached::<L, _>(records, entries);
        let mut turns = [(Exact::<R, 2>::nothing(), T::Sum::<R>::nothing()); 2];
        let mut geometry = Geometry::new();
        let (held, slopes) = room;
        let mut count = 0;
        for chunk in entries.chunks(CHUNK) {
            let room = &mut geometry;
            // Only this depends on the kernel: a function of its own for each.
            let in_reach = with_kernel!(kernel, K => {
                L::call(Fill::<K, R, N>::new(room, places, chunk, records))
            });
            for (turn, kept) in turns.iter_mut().take(R::TURNS).enumerate() {
                // A copy stays in registers.
                let (mut gradient, mut sum) = *kept;
                let mut place = count + turn;
                for (number, pair) in geometry.visit(in_reach, turn) {
                    let j = chunk[number];
                    held[place] = j;
                    L::prefetch(&slopes[place], AHEAD);
                    pair.slope.store_single(&mut slopes[place].0);
                    place += R::TURNS;
                    let other = Other { record: &records[j as usize], number: j as usize };
                    gradient.add(pair.gradient());
                    terms.add(&own, &pair, other, &mut sum);
                }
                *kept = (gradient, sum);
            }
            count += in_reach.len();
        }
        let [(even_gradient, even), (odd_gradient, odd)] = turns;
        Sums {
            gradient: Exact::total(&[even_gradient, odd_gradient]),
            terms: T::Sum::<R>::total(&[even, odd]),
            count,
        }
    }
}
