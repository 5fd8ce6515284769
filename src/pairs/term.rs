//! Terms of an equation, and their sums over a particle's neighbours.

use super::fields::Here;
use super::geometry::Pair;
use super::precision::{Neighbour, Other};
use crate::math::simd::{LANES, Lanes, Vector};

/// A value for each of eight particles.
pub type Eight = [f64; LANES];

/// The values of several sums.
#[inline(always)]
pub fn loaded<D: Lanes, const N: usize>(sums: &[Eight; N]) -> [D; N] {
    let mut values = [D::splat(0.0); N];
    for n in 0..N {
        values[n] = D::load(&sums[n]);
    }
    values
}

/// The contribution of each pair to a sum of its particle. It is written for one particle and one
/// neighbour. Numbers `R` hold the values of several pairs.
pub trait Term: Copy {
    /// Its data of the particle itself.
    type Own<R: Vector>: Copy;
    /// The sum, while pairs add to it.
    type Sum<R: Vector>: Sum<Total = Self::Total>;
    /// The sum over all pairs.
    type Total: Copy;

    /// Reads the particle itself.
    fn own<R: Vector, N: Neighbour>(&self, here: Here) -> Self::Own<R>;
    /// Adds the contribution of one pair.
    fn add<R: Vector, N: Neighbour>(
        &self,
        own: &Self::Own<R>,
        pair: &Pair<R>,
        other: Other<'_, N>,
        sum: &mut Self::Sum<R>,
    );
}

/// Sums that grow pair by pair.
pub trait Sum: Copy {
    /// The sum of eight particles over all pairs.
    type Total: Copy;
    /// No pair yet.
    fn nothing() -> Self;
    /// The total of two sums to which pairs were added in turns; of the first alone if there were
    /// no turns.
    fn total(turns: &[Self; 2]) -> Self::Total;
}

impl<R: Vector, const N: usize> Sum for [R; N] {
    type Total = [Eight; N];

    #[inline(always)]
    fn nothing() -> Self {
        [R::splat(0.0); N]
    }
    #[inline(always)]
    fn total([even, odd]: &[Self; 2]) -> [Eight; N] {
        let mut total = [[0.0; LANES]; N];
        for n in 0..N {
            total[n] = whole::<R>(even[n].widened(), odd[n].widened());
        }
        total
    }
}

/// Sums in double precision for any precision of the pairs.
#[derive(Clone, Copy)]
pub(super) struct Exact<R: Vector, const N: usize>([R::Wide; N]);

impl<R: Vector, const N: usize> Exact<R, N> {
    #[inline(always)]
    pub fn add(&mut self, values: [R; N]) {
        for (sum, value) in self.0.iter_mut().zip(values) {
            *sum += value.widened();
        }
    }
}

impl<R: Vector, const N: usize> Sum for Exact<R, N> {
    type Total = [Eight; N];

    #[inline(always)]
    fn nothing() -> Self {
        Exact([R::Wide::splat(0.0); N])
    }
    #[inline(always)]
    fn total([even, odd]: &[Self; 2]) -> [Eight; N] {
        std::array::from_fn(|n| whole::<R>(even.0[n], odd.0[n]))
    }
}

#[inline(always)]
fn whole<R: Vector>(even: R::Wide, odd: R::Wide) -> Eight {
    if R::TURNS > 1 { (even + odd).to_array() } else { even.to_array() }
}

/// A term that is included or left out. If it is left out, its sum is zero and it costs nothing.
#[derive(Clone, Copy)]
pub struct If<const COUNTS: bool, T>(pub T);

impl<const COUNTS: bool, T: Term> Term for If<COUNTS, T> {
    type Own<R: Vector> = Option<T::Own<R>>;
    type Sum<R: Vector> = T::Sum<R>;
    type Total = T::Total;

    #[inline(always)]
    fn own<R: Vector, N: Neighbour>(&self, here: Here) -> Option<T::Own<R>> {
        if COUNTS { Some(self.0.own::<R, N>(here)) } else { None }
    }
    #[inline(always)]
    fn add<R: Vector, N: Neighbour>(
        &self,
        own: &Option<T::Own<R>>,
        pair: &Pair<R>,
        other: Other<'_, N>,
        sum: &mut T::Sum<R>,
    ) {
        if COUNTS && let Some(own) = own {
            self.0.add(own, pair, other, sum);
        }
    }
}

/// Several terms together are a term.
macro_rules! terms {
    ($($Term:ident $at:tt),+) => {
        impl<$($Term: Term),+> Term for ($($Term,)+) {
            type Own<R: Vector> = ($($Term::Own<R>,)+);
            type Sum<R: Vector> = ($($Term::Sum<R>,)+);
            type Total = ($($Term::Total,)+);

            #[inline(always)]
            fn own<R: Vector, N: Neighbour>(&self, here: Here) -> Self::Own<R> {
                ($(self.$at.own::<R, N>(here),)+)
            }
            #[inline(always)]
            fn add<R: Vector, N: Neighbour>(
                &self,
                own: &Self::Own<R>,
                pair: &Pair<R>,
                other: Other<'_, N>,
                sum: &mut Self::Sum<R>,
            ) {
                $(self.$at.add(&own.$at, pair, other, &mut sum.$at);)+
            }
        }

        impl<$($Term: Sum),+> Sum for ($($Term,)+) {
            type Total = ($($Term::Total,)+);

            #[inline(always)]
            fn nothing() -> Self {
                ($($Term::nothing(),)+)
            }
            #[inline(always)]
            fn total([even, odd]: &[Self; 2]) -> Self::Total {
                ($($Term::total(&[even.$at, odd.$at]),)+)
            }
        }
    };
}

terms!(A 0);
terms!(A 0, B 1);
terms!(A 0, B 1, C 2);
terms!(A 0, B 1, C 2, D 3);
