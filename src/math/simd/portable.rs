//! Lanes in plain Rust, for processors without AVX2.

use std::ops::{Add, AddAssign, Mul, Sub};

use super::{LANES, Lanes, RSQRT_MAGIC, Task};

/// Eight values in an array; products and sums are rounded separately.
#[derive(Clone, Copy)]
pub(super) struct Portable([f64; LANES]);

/// Runs a task in plain Rust.
#[inline(never)]
pub(super) fn run<T: Task>(task: T) -> T::Output {
    task.run::<Portable>()
}

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut values = self.0;
        for (value, other) in values.iter_mut().zip(&other.0) {
            *value = f(*value, *other);
        }
        Portable(values)
    }
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl AddAssign for Portable {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Lanes for Portable {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Portable([value; LANES])
    }
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        Portable(*values)
    }
    #[inline(always)]
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self {
        Portable(at.map(|at| values[at as usize]))
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; LANES]) {
        *values = self.0;
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        Portable(values.map(f64::from))
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        *values = self.0.map(|value| value as f32);
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        self * factor - subtrahend
    }
    #[inline(always)]
    fn negated_mul_add(self, factor: Self, addend: Self) -> Self {
        addend - self * factor
    }
    #[inline(always)]
    fn div(self, divisor: Self) -> Self {
        self.zip(divisor, |a, b| a / b)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Portable(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn rsqrt_guess(self) -> Self {
        Portable(self.0.map(|x| f64::from_bits((RSQRT_MAGIC - (x.to_bits() >> 1) as i64) as u64)))
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        let mut values = otherwise.0;
        for (k, value) in values.iter_mut().enumerate() {
            *value = if self.0[k] < bound.0[k] { if_less.0[k] } else { *value };
        }
        Portable(values)
    }
    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        run(task)
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        (0..LANES).any(|k| self.0[k] < bound.0[k])
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Portable(self.0.map(|x| f64::from_bits((x.to_bits() << 52).wrapping_add(1023 << 52))))
    }
}
