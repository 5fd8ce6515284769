//! Fields of the water, eight particles at a time.

use std::ops::Range;

use super::record::Record;
use crate::math::simd::{LANES, Lanes, Task, Vector};

/// Eight particles that are computed together. Fields have all the water; rows have only the
/// particles of the present part.
#[derive(Debug, Clone, Copy)]
pub struct Here {
    /// The first of them in the fields.
    at: usize,
    /// The first of them in the rows.
    to: usize,
    /// Their list of neighbours.
    pub(super) list: usize,
}

impl Here {
    #[inline(always)]
    pub(super) fn new(cluster: usize, list: usize) -> Here {
        Here { at: cluster * LANES, to: list * LANES, list }
    }

    /// Their values of a field, one by one.
    #[inline(always)]
    pub fn eight<T>(self, field: &[T]) -> &[T; LANES] {
        field[self.at..self.at + LANES].first_chunk().unwrap()
    }

    /// Number of their cluster.
    #[inline(always)]
    pub(super) fn cluster(self) -> u32 {
        (self.at / LANES) as u32
    }

    /// Their numbers. Those of padding are beyond the last particle's number.
    #[inline(always)]
    pub fn numbers(self) -> Range<usize> {
        self.at..self.at + LANES
    }

    /// Changes two values of each of them, given its number.
    #[inline(always)]
    pub fn change<D: Lanes>(
        self,
        values: [D; 2],
        change: impl Fn(usize, [f64; 2]) -> [f64; 2],
    ) -> [D; 2] {
        let [mut first, mut second] = D::to_arrays(values);
        for lane in 0..LANES {
            [first[lane], second[lane]] = change(self.at + lane, [first[lane], second[lane]]);
        }
        [D::load(&first), D::load(&second)]
    }

    /// Their values of a field.
    #[inline(always)]
    pub fn of<R: Vector>(self, field: &[f64]) -> R {
        R::load(self.eight(field))
    }

    /// Their values of several fields.
    #[inline(always)]
    pub fn all<R: Vector, const N: usize>(self, fields: [&[f64]; N]) -> [R; N] {
        let mut values = [R::splat(0.0); N];
        for n in 0..N {
            values[n] = self.of(fields[n]);
        }
        values
    }

    /// Their two numbers in a field of pairs of numbers.
    #[inline(always)]
    pub fn both<R: Vector>(self, field: &[[f64; 2]]) -> [R; 2] {
        let (mut first, mut second) = ([0.0; LANES], [0.0; LANES]);
        for (lane, numbers) in self.eight(field).iter().enumerate() {
            [first[lane], second[lane]] = *numbers;
        }
        [R::load(&first), R::load(&second)]
    }

    /// Some of the numbers in their records: see [`Record`].
    #[inline(always)]
    pub fn slots<R: Vector, const N: usize>(self, records: &[Record], slots: [usize; N]) -> [R; N] {
        let mut values = [R::splat(0.0); N];
        for n in 0..N {
            let mut eight = [0.0; LANES];
            for (value, record) in eight.iter_mut().zip(self.eight(records)) {
                *value = record.0[slots[n]];
            }
            values[n] = R::load(&eight);
        }
        values
    }

    /// Their values in the rows.
    #[inline(always)]
    pub fn in_rows<R: Vector>(self, rows: &[f64]) -> R {
        R::load(rows[self.to..self.to + LANES].first_chunk().unwrap())
    }

    /// Their values in the rows, one by one.
    #[inline(always)]
    pub fn eight_in_rows<T>(self, rows: &mut [T]) -> &mut [T; LANES] {
        rows[self.to..self.to + LANES].first_chunk_mut().unwrap()
    }

    /// Writes their values to the rows.
    #[inline(always)]
    pub fn put<D: Lanes>(self, rows: &mut [f64], value: D) {
        store(rows, self.to, value);
    }

    /// Writes the values of those that are not padding to the rows; there are `all` particles.
    #[inline(always)]
    pub fn put_within<D: Lanes>(self, all: usize, rows: &mut [f64], value: D) {
        if self.at + LANES <= all {
            return self.put(rows, value);
        }
        let values = value.to_array();
        let count = all.saturating_sub(self.at);
        rows[self.to..self.to + count].copy_from_slice(&values[..count]);
    }

    /// Writes eight numbers for each of them to rows.
    #[inline(always)]
    pub fn put_numbers<D: Lanes, N: AsMut<[f64; 8]>>(self, rows: &mut [N], numbers: [D; 8]) {
        D::store_records(numbers, rows[self.to..self.to + LANES].first_chunk_mut().unwrap());
    }

    /// Writes their two numbers to rows of pairs of numbers.
    #[inline(always)]
    pub fn put_both<D: Lanes>(self, rows: &mut [[f64; 2]], [first, second]: [D; 2]) {
        let (first, second) = (first.to_array(), second.to_array());
        for lane in 0..LANES {
            rows[self.to + lane] = [first[lane], second[lane]];
        }
    }
}

/// Eight values of a field in a vector.
#[inline(always)]
fn lanes<L: Lanes>(field: &[f64], at: usize) -> L {
    L::load(field[at..at + LANES].first_chunk().unwrap())
}

/// Eight values of each field. (A map over the array would become a function of its own, compiled
/// without the path's instructions.)
#[inline(always)]
fn all_lanes<L: Lanes, const N: usize>(fields: [&[f64]; N], at: usize) -> [L; N] {
    let mut values = [L::splat(0.0); N];
    for n in 0..N {
        values[n] = lanes(fields[n], at);
    }
    values
}

/// Writes eight values of a field.
#[inline(always)]
fn store<L: Lanes>(field: &mut [f64], at: usize, value: L) {
    value.store(field[at..at + LANES].first_chunk_mut().unwrap());
}

/// Position of each value between `from` and `to`: 0 at `from` and below, 1 at `to` and above.
pub struct Ramp<'a> {
    /// The values.
    pub values: &'a [f64],
    /// See above.
    pub from: f64,
    /// See above.
    pub to: f64,
    /// The results, in whole vectors.
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
pub struct Extrapolate<'a> {
    /// The result, metres.
    pub ahead: &'a mut [f64],
    /// Metres.
    pub places: &'a [f64],
    /// m/s.
    pub velocities: &'a [f64],
    /// m/s².
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
