//! Loops over whole fields of the water.

use super::momentum::store;
use super::separation::{all_lanes, lanes};
use crate::math::simd::{LANES, Lanes, Task};

/// values += dt · rates.
pub(super) struct Advance<'a, const N: usize> {
    pub fields: [(&'a mut [f64], &'a [f64]); N],
    pub dt: f64,
}

impl<const N: usize> Task for Advance<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let dt = L::splat(self.dt);
        for (values, rates) in self.fields {
            let (blocks, rest) = values.as_chunks_mut::<LANES>();
            for (block, values) in blocks.iter_mut().enumerate() {
                let at = block * LANES;
                (L::load(values) + dt * lanes::<L>(rates, at)).store(values);
            }
            let first = blocks.len() * LANES;
            for (value, rate) in rest.iter_mut().zip(&rates[first..]) {
                *value += self.dt * rate;
            }
        }
    }
}

/// How far from `from` to `to` each value is: 0 at `from` and below it, 1 at `to` and above.
pub(super) struct Ramp<'a> {
    pub values: &'a [f64],
    pub from: f64,
    pub to: f64,
    /// As long, whole vectors.
    pub shares: &'a mut [f64],
}

impl Task for Ramp<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for at in (0..self.shares.len()).step_by(LANES) {
            let inside = lanes::<L>(self.values, at) - L::splat(self.from);
            let share = inside.div(L::splat(self.to - self.from));
            store(self.shares, at, share.max(L::splat(0.0)).min(L::splat(1.0)));
        }
    }
}

/// places + a · velocities + b · accelerations.
pub(super) struct Extrapolate<'a> {
    pub ahead: &'a mut [f64],
    pub places: &'a [f64],
    pub velocities: &'a [f64],
    pub accelerations: &'a [f64],
    /// a, s, and b, s².
    pub factors: [f64; 2],
}

impl Task for Extrapolate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (a, b) = (L::splat(self.factors[0]), L::splat(self.factors[1]));
        for at in (0..self.ahead.len()).step_by(LANES) {
            let [place, velocity, acceleration] =
                all_lanes::<L, 3>([self.places, self.velocities, self.accelerations], at);
            store(self.ahead, at, place + a * velocity + b * acceleration);
        }
    }
}
