//! Eight-lane vectors of `f64`, with the instruction set chosen at run time.
//!
//! A hot loop is a [`Task`], written once against [`Lanes`]; [`dispatch`] compiles it for every
//! [`SimdPath`] and runs the chosen one, so that one binary serves every node of a cluster.
//! All operations are correctly rounded, so AVX-512 and AVX2 give the same bits on any processor.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;
#[cfg(target_arch = "x86_64")]
mod single;

use std::ops::{Add, AddAssign, Mul, Sub};

use serde::{Deserialize, Serialize};

/// Number of lanes of every vector.
pub const LANES: usize = 8;

/// Start of 1/√x: the bits of x, halved and taken from this, have about the right exponent.
const RSQRT_MAGIC: i64 = 0x5FE6_EB50_C7B5_37A9;

/// Adding and taking away 1.5·2^52 rounds to an integer.
const DOUBLE_ROUNDING: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts, the first of few enough digits for exact products.
const DOUBLE_LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// The start of 1/√x in single precision ...
const SINGLE_RSQRT_MAGIC: i32 = 0x5F37_59DF;
/// ... where 1.5·2^23 rounds to integers ...
const SINGLE_ROUNDING: f64 = 12_582_912.0;
/// ... and ln 2 has a part of a few digits, to be multiplied without rounding.
const SINGLE_LN_2: [f64; 2] = [0.693_359_375, -2.121_944_400_546_9e-4];

/// An instruction set for the hot loops. AVX-512 and AVX2 give the same bits; the portable path
/// has no fused multiply-add and differs in rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SimdPath {
    /// Plain Rust.
    Portable,
    /// 256-bit vectors with fused multiply-add.
    Avx2,
    /// 512-bit vectors.
    Avx512,
}

impl SimdPath {
    /// The widest that this processor has.
    pub fn widest() -> SimdPath {
        [SimdPath::Avx512, SimdPath::Avx2]
            .into_iter()
            .find(|path| path.is_supported())
            .unwrap_or(SimdPath::Portable)
    }

    /// Whether this processor has the instructions.
    pub fn is_supported(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return match self {
            SimdPath::Portable => true,
            SimdPath::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            SimdPath::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("fma")
            }
        };
        #[cfg(not(target_arch = "x86_64"))]
        return self == SimdPath::Portable;
    }

    /// The name used in files.
    pub fn name(self) -> &'static str {
        match self {
            SimdPath::Portable => "portable",
            SimdPath::Avx2 => "avx2",
            SimdPath::Avx512 => "avx512",
        }
    }
}

/// Eight values that are computed together, of double precision or, as [`Lanes::Single`], of single
/// precision; arrays of `f64` are then rounded on loading.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + AddAssign
{
    /// Lanes of single precision on the same path.
    type Single: Lanes;
    /// Adding and taking this away rounds to an integer.
    const ROUNDING: f64 = DOUBLE_ROUNDING;
    /// ln 2 in two parts, the first of few enough digits for exact products.
    const LN_2: [f64; 2] = DOUBLE_LN_2;

    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    /// The same value of single precision in every lane.
    fn splat_single(value: f32) -> Self;
    /// Reads eight values.
    fn load(values: &[f64; LANES]) -> Self;
    /// The values at eight places.
    ///
    /// # Panics
    /// One of them lies outside.
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self;
    /// Writes eight values.
    fn store(self, values: &mut [f64; LANES]);
    /// Writes eight records of eight numbers: `numbers[n]` has number n of each of them.
    #[inline(always)]
    fn store_records<R: AsMut<[f64; 8]>>(numbers: [Self; 8], records: &mut [R; LANES]) {
        let mut columns = [[0.0; LANES]; 8];
        for (number, column) in numbers.into_iter().zip(&mut columns) {
            number.store(column);
        }
        for (lane, record) in records.iter_mut().enumerate() {
            for (column, number) in columns.iter().zip(record.as_mut()) {
                *number = column[lane];
            }
        }
    }
    /// Reads eight values in single precision.
    fn load_single(values: &[f32; LANES]) -> Self;
    /// Writes eight values, rounded to single precision.
    fn store_single(self, values: &mut [f32; LANES]);
    /// `self * factor + addend`, fused where the path has it.
    fn mul_add(self, factor: Self, addend: Self) -> Self;
    /// `self * factor - subtrahend`, fused likewise.
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self;
    /// `addend - self * factor`, fused likewise.
    fn negated_mul_add(self, factor: Self, addend: Self) -> Self;
    /// `self / divisor`.
    fn div(self, divisor: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// The smaller of each pair.
    fn min(self, other: Self) -> Self;
    /// The larger of each pair.
    fn max(self, other: Self) -> Self;
    /// `1 / sqrt(self)` to 3.5 %, from its bits; a start for refinement.
    fn rsqrt_guess(self) -> Self;
    /// `if_less` where `self < bound`, else `otherwise`.
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self;
    /// Runs a task of the same path as a function of its own, so that its registers are its own.
    fn call<T: Task>(task: T) -> T::Output;
    /// Sends for the value that lies so many values after one in memory, if there is any.
    #[inline(always)]
    fn prefetch<T>(value: &T, ahead: usize) {
        let _ = (value, ahead);
    }
    /// Whether `self < bound` in any lane.
    fn any_less(self, bound: Self) -> bool;
    /// 2^n, where `self` is n + [`Lanes::ROUNDING`] for an integer n that 2^n allows.
    fn power_of_two(self) -> Self;

    /// `1 / sqrt(self)` to about 1e-15, for any positive normal number. Products and sums alone:
    /// they overlap where a square root and a division would queue.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        // With e = 1 - x y², 1/√x = y (1 + e/2 + 3 e²/8 + 5 e³/16 + ...): two terms of it, then three.
        let y = self.rsqrt_guess();
        let e = (self * y).negated_mul_add(y, Self::splat(1.0));
        let slope = e.mul_add(Self::splat(0.375), Self::splat(0.5));
        let y = (y * e).mul_add(slope, y);
        let e = (self * y).negated_mul_add(y, Self::splat(1.0));
        let slope = e.mul_add(Self::splat(0.3125), Self::splat(0.375));
        let slope = e.mul_add(slope, Self::splat(0.5));
        (y * e).mul_add(slope, y)
    }

    /// e^self to a few units in the last place, for arguments from -700 to 700 (-80 to 80 in single
    /// precision).
    #[inline(always)]
    fn exp(self) -> Self {
        let [high, low] = Self::LN_2;
        let rounding = Self::splat(Self::ROUNDING);
        let shifted = self.mul_add(Self::splat(std::f64::consts::LOG2_E), rounding);
        let n = shifted - rounding;
        let rest = n.mul_add(Self::splat(-high), self);
        let rest = n.mul_add(Self::splat(-low), rest);
        // Taylor to x^12 on |x| < 0.35: remainder below 2e-16.
        let mut sum = Self::splat(1.0 / 479_001_600.0);
        for factorial in [
            39_916_800.0,
            3_628_800.0,
            362_880.0,
            40_320.0,
            5_040.0,
            720.0,
            120.0,
            24.0,
            6.0,
            2.0,
            1.0,
            1.0,
        ] {
            sum = sum.mul_add(rest, Self::splat(1.0 / factorial));
        }
        sum * shifted.power_of_two()
    }

    /// The eight values as an array.
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        self.store(&mut values);
        values
    }

    /// Their sum, always in the same order.
    #[inline(always)]
    fn sum(self) -> f64 {
        let v = self.to_array();
        ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]))
    }
}

/// `1 / sqrt(x)` in single precision: to 1e-5, then to a unit or two in the last place.
#[inline(always)]
fn single_rsqrt<L: Lanes>(x: L) -> L {
    let y = x.rsqrt_guess();
    let e = (x * y).negated_mul_add(y, L::splat(1.0));
    let slope = e.mul_add(L::splat(0.375), L::splat(0.5));
    let y = (y * e).mul_add(slope, y);
    let e = (x * y).negated_mul_add(y, L::splat(1.0));
    (y * e).mul_add(L::splat(0.5), y)
}

/// A loop that is compiled once per instruction set.
pub trait Task {
    /// What it returns.
    type Output;
    /// The loop itself; must be `#[inline(always)]`, like all that it calls in its hot part.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Runs a task with the instructions of `path`, or portably where the processor lacks them.
pub fn dispatch<T: Task>(path: SimdPath, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    {
        debug_assert!(path.is_supported());
        match path {
            // SAFETY: a path other than portable is only ever chosen after detection.
            SimdPath::Avx512 => return unsafe { avx512::run(task) },
            SimdPath::Avx2 => return unsafe { avx2::run(task) },
            SimdPath::Portable => {}
        }
    }
    let _ = path;
    portable::run(task)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Probe([f64; LANES]);

    impl Task for Probe {
        type Output = [[f64; LANES]; 3];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let x = L::load(&self.0);
            let negative = x * L::splat(-3.0);
            [x.rsqrt().to_array(), negative.exp().to_array(), x.sqrt().div(x).to_array()]
        }
    }

    const INPUT: [f64; LANES] = [1e-12, 0.01, 0.3, 0.999, 1.0, 2.5, 77.0, 200.0];

    fn paths() -> impl Iterator<Item = SimdPath> {
        [SimdPath::Portable, SimdPath::Avx2, SimdPath::Avx512]
            .into_iter()
            .filter(|path| path.is_supported())
    }

    #[test]
    fn functions_match_the_standard_library_on_every_path() {
        for path in paths() {
            let [rsqrt, exp, ratio] = dispatch(path, Probe(INPUT));
            for (k, x) in INPUT.into_iter().enumerate() {
                let close = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * b.abs();
                assert!(close(rsqrt[k], 1.0 / x.sqrt(), 2e-15), "{path:?} rsqrt({x})");
                assert!(
                    close(exp[k], (-3.0 * x).exp(), 4e-16 * (4.0 + 3.0 * x)),
                    "{path:?} exp({x})"
                );
                assert!(close(ratio[k], x.sqrt() / x, 3e-16), "{path:?} sqrt/x({x})");
            }
        }
    }

    #[derive(Clone, Copy)]
    struct Row([f64; 8]);

    impl AsMut<[f64; 8]> for Row {
        fn as_mut(&mut self) -> &mut [f64; 8] {
            &mut self.0
        }
    }

    struct Transposed([[f64; LANES]; 8]);

    impl Task for Transposed {
        type Output = [Row; LANES];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let mut records = [Row([0.0; 8]); LANES];
            let mut numbers = [L::splat(0.0); 8];
            for (number, values) in numbers.iter_mut().zip(&self.0) {
                *number = L::load(values);
            }
            L::store_records(numbers, &mut records);
            records
        }
    }

    #[test]
    fn records_are_written_number_by_number() {
        let numbers: [[f64; LANES]; 8] =
            std::array::from_fn(|n| std::array::from_fn(|record| (10 * record + n) as f64));
        for path in paths() {
            for (record, stored) in dispatch(path, Transposed(numbers)).into_iter().enumerate() {
                assert_eq!(stored.0, std::array::from_fn(|n| (10 * record + n) as f64), "{path:?}");
            }
        }
    }

    struct SingleProbe([f64; LANES]);

    impl Task for SingleProbe {
        type Output = [[f64; LANES]; 3];
        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            L::Single::call(Probe(self.0))
        }
    }

    #[test]
    fn single_precision_is_good_to_its_last_digits_on_every_path() {
        for path in paths() {
            let [rsqrt, exp, ratio] = dispatch(path, SingleProbe(INPUT));
            for (k, x) in INPUT.map(|x| f64::from(x as f32)).into_iter().enumerate() {
                let close = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * b.abs();
                assert!(close(rsqrt[k], 1.0 / x.sqrt(), 3e-7), "{path:?} rsqrt({x})");
                if x < 25.0 {
                    let wrong = 1.2e-7 * (4.0 + 3.0 * x);
                    assert!(close(exp[k], (-3.0 * x).exp(), wrong), "{path:?} exp({x})");
                }
                assert!(close(ratio[k], 1.0 / x.sqrt(), 2e-7), "{path:?} sqrt/x({x})");
            }
        }
        if SimdPath::Avx512.is_supported() {
            let bits = |path| dispatch(path, SingleProbe(INPUT)).map(|row| row.map(f64::to_bits));
            assert_eq!(bits(SimdPath::Avx512), bits(SimdPath::Avx2));
        }
    }

    #[test]
    fn vector_paths_agree_to_the_bit() {
        if SimdPath::Avx512.is_supported() {
            let bits = |path| dispatch(path, Probe(INPUT)).map(|row| row.map(f64::to_bits));
            assert_eq!(bits(SimdPath::Avx512), bits(SimdPath::Avx2));
        }
    }
}
