//! Vectors of pair loops.

use super::{LANES, Lanes, Vector};

/// Pairs of eight particles with one neighbour, or with two at once. Where a method takes numbers of
/// two neighbours and there is one at once, the first counts.
pub trait Pairs: Vector {
    /// Neighbours at once: one or two.
    const NEIGHBOURS: usize = 1;
    /// Turns that a loop takes to visit neighbours, with sums of their own: in single precision every
    /// other neighbour is summed apart, on every path, so that vectors of any length give the same bits.
    const TURNS: usize = 1;

    /// Sums in double precision.
    type Sum: Copy;

    /// A number of each particle.
    fn of_particles(numbers: &[f64; LANES]) -> Self;
    /// A number of each neighbour.
    #[inline(always)]
    fn of_neighbours([number, _]: [f64; 2]) -> Self {
        Self::splat(number)
    }
    /// A number of each neighbour, out of sixteen.
    #[inline(always)]
    fn out_of<const SLOT: usize>(numbers: [&[f32; 16]; 2]) -> Self {
        Self::of_neighbours([f64::from(numbers[0][SLOT]), f64::from(numbers[1][SLOT])])
    }
    /// The pairs with one neighbour of each vector, or with that of the first.
    #[inline(always)]
    fn picked([vector, _]: [&Self; 2], _neighbours: [usize; 2]) -> Self {
        *vector
    }
    /// Whether `self < bound` for any of the particles: a bit for each neighbour.
    fn reached(self, bound: Self) -> u64;
    /// Writes the pairs in single precision, neighbour by neighbour.
    fn store_singles<S: AsMut<[f32; LANES]>>(self, into: &mut [S]);
    /// Nothing, as a sum.
    fn nothing() -> Self::Sum;
    /// Adds the pairs to a sum, each neighbour's to its own.
    fn add_to(self, sum: Self::Sum) -> Self::Sum;
    /// A sum over all neighbours.
    fn whole(sum: Self::Sum) -> [f64; LANES];
}

impl<L: Lanes> Pairs for L {
    type Sum = L;

    #[inline(always)]
    fn of_particles(numbers: &[f64; LANES]) -> Self {
        L::load(numbers)
    }
    #[inline(always)]
    fn reached(self, bound: Self) -> u64 {
        u64::from(self.any_less(bound))
    }
    #[inline(always)]
    fn store_singles<S: AsMut<[f32; LANES]>>(self, into: &mut [S]) {
        self.store_single(into[0].as_mut());
    }
    #[inline(always)]
    fn nothing() -> L {
        L::splat(0.0)
    }
    #[inline(always)]
    fn add_to(self, sum: L) -> L {
        sum + self
    }
    #[inline(always)]
    fn whole(sum: L) -> [f64; LANES] {
        sum.to_array()
    }
}
