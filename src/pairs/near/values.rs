//! Where passes write their results for each particle.

use crate::math::simd::LANES;
use crate::math::team::{First, Rows};

/// Values of the particles of a part.
pub trait Values: Rows {
    /// The value of a particle.
    type Value;
    /// Writes the value of the particle at this place in the part.
    fn put(&mut self, place: usize, value: Self::Value);
}

/// A value of every particle: eight to a cluster, fewer to the last.
pub struct Field<'a, T>(pub &'a mut [T]);

impl<T: Send> Rows for Field<'_, T> {
    fn split(self, first: usize, all: usize) -> (Self, Self) {
        let (First(front, _), First(back, _)) = First(self.0, LANES).split(first, all);
        (Field(front), Field(back))
    }
}

impl<T: Send> Values for Field<'_, T> {
    type Value = T;

    #[inline(always)]
    fn put(&mut self, place: usize, value: T) {
        self.0[place] = value;
    }
}

impl Values for () {
    type Value = ();

    #[inline(always)]
    fn put(&mut self, _: usize, (): ()) {}
}

impl<A: Values, B: Values> Values for (A, B) {
    type Value = (A::Value, B::Value);

    #[inline(always)]
    fn put(&mut self, place: usize, (a, b): (A::Value, B::Value)) {
        self.0.put(place, a);
        self.1.put(place, b);
    }
}
