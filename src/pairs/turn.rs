//! Passes over all particles in turn, that change their fields in place.

use super::fields::Here;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};

/// What is done with particles in turn.
pub trait InTurn {
    /// Does it with eight particles, and adds what is summed over all of them.
    fn at<D: Lanes>(&mut self, here: Here, sum: &mut D);
}

struct OneByOne<'a, W> {
    particles: usize,
    work: &'a mut W,
}

impl<W: InTurn> Task for OneByOne<'_, W> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut sum = L::splat(0.0);
        for cluster in 0..self.particles.div_ceil(LANES) {
            self.work.at::<L>(Here::new(cluster, cluster), &mut sum);
        }
        sum.sum()
    }
}

/// Goes through so many particles; returns the sum.
pub fn in_turn(path: SimdPath, particles: usize, work: &mut impl InTurn) -> f64 {
    dispatch(path, OneByOne { particles, work })
}
