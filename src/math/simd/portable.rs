//! Lanes in plain Rust, for processors without AVX2.

use std::ops::{Add, AddAssign, Mul, Sub};

use super::vector::{DOUBLE_LN_2, DOUBLE_ROUNDING, RSQRT_MAGIC, SINGLE_LN_2, SINGLE_ROUNDING};
use super::{LANES, Lanes, Task, Vector};

/// The start of 1/√x in single precision.
const SINGLE_RSQRT_MAGIC: u32 = 0x5F37_59DF;

/// Eight values in an array; products and sums are rounded separately.
#[derive(Clone, Copy)]
pub(super) struct Portable([f64; LANES]);

/// Eight values of single precision.
#[derive(Clone, Copy)]
pub(super) struct Single([f32; LANES]);

/// Runs a task in plain Rust.
#[inline(never)]
pub(super) fn run<T: Task>(task: T) -> T::Output {
    task.run::<Portable>()
}

// Plain loops. In the longest tasks iterators are not inlined, unless the whole program is
// optimised at once. The tasks then take thirty times as long.

/// A function of each of eight values.
#[inline(always)]
fn each<A: Copy, B: Copy + Default>(values: &[A; LANES], f: impl Fn(A) -> B) -> [B; LANES] {
    let mut found = [B::default(); LANES];
    let mut k = 0;
    while k < LANES {
        found[k] = f(values[k]);
        k += 1;
    }
    found
}

/// Whether any of eight values is below its bound.
#[inline(always)]
fn any_less<A: Copy + PartialOrd>(values: &[A; LANES], bounds: &[A; LANES]) -> bool {
    let (mut any, mut k) = (false, 0);
    while k < LANES {
        any |= values[k] < bounds[k];
        k += 1;
    }
    any
}

macro_rules! vector {
    ($Name:ident, $real:ty, $turns:literal, $digits:literal, $magic:expr, $rounding:expr, $ln_2:expr$(, $rsqrt:path)?) => {
        impl $Name {
            #[inline(always)]
            fn zip(mut self, other: Self, f: impl Fn($real, $real) -> $real) -> Self {
                let mut k = 0;
                while k < LANES {
                    self.0[k] = f(self.0[k], other.0[k]);
                    k += 1;
                }
                self
            }
        }

        impl Add for $Name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                self.zip(other, |a, b| a + b)
            }
        }

        impl Sub for $Name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                self.zip(other, |a, b| a - b)
            }
        }

        impl Mul for $Name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                self.zip(other, |a, b| a * b)
            }
        }

        impl AddAssign for $Name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl Vector for $Name {
            type Wide = Portable;

            const TURNS: usize = $turns;
            const ROUNDING: f64 = $rounding;
            const LN_2: [f64; 2] = $ln_2;

            #[inline(always)]
            fn load(values: &[f64; LANES]) -> Self {
                $Name(each(values, |value| value as $real))
            }
            #[inline(always)]
            fn store_single(self, values: &mut [f32; LANES]) {
                *values = each(&self.0, |value| value as f32);
            }
            #[inline(always)]
            fn widened(self) -> Portable {
                Portable(each(&self.0, f64::from))
            }
            #[inline(always)]
            fn any_less(self, bound: Self) -> bool {
                any_less(&self.0, &bound.0)
            }
            #[inline(always)]
            fn splat(value: f64) -> Self {
                $Name([value as $real; LANES])
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
                $Name(each(&self.0, <$real>::sqrt))
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
                $Name(each(&self.0, |x| <$real>::from_bits($magic - (x.to_bits() >> 1))))
            }
            #[inline(always)]
            fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
                let mut values = otherwise;
                let mut k = 0;
                while k < LANES {
                    values.0[k] = if self.0[k] < bound.0[k] { if_less.0[k] } else { values.0[k] };
                    k += 1;
                }
                values
            }
            #[inline(always)]
            fn power_of_two(self) -> Self {
                let one = <$real>::to_bits(1.0);
                $Name(each(&self.0, |x| {
                    <$real>::from_bits((x.to_bits() << $digits).wrapping_add(one))
                }))
            }
            $(
                #[inline(always)]
                fn rsqrt(self) -> Self {
                    $rsqrt(self)
                }
            )?
        }
    };
}

vector!(Portable, f64, 1, 52, RSQRT_MAGIC as u64, DOUBLE_ROUNDING, DOUBLE_LN_2);
vector!(Single, f32, 2, 23, SINGLE_RSQRT_MAGIC, SINGLE_ROUNDING, SINGLE_LN_2, single_rsqrt);

/// `1 / sqrt(x)` in single precision: to 1e-5, then to a unit or two in the last place.
#[inline(always)]
fn single_rsqrt(x: Single) -> Single {
    let y = x.rsqrt_guess();
    let e = (x * y).negated_mul_add(y, Single::splat(1.0));
    let slope = e.mul_add(Single::splat(0.375), Single::splat(0.5));
    let y = (y * e).mul_add(slope, y);
    let e = (x * y).negated_mul_add(y, Single::splat(1.0));
    (y * e).mul_add(Single::splat(0.5), y)
}

impl Lanes for Portable {
    type Single = Single;

    #[inline(always)]
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self {
        Portable(each(at, |at| values[at as usize]))
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; LANES]) {
        *values = self.0;
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        Portable(each(values, f64::from))
    }
    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        run(task)
    }
}
