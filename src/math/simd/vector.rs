//! Arithmetic of vectors.

use std::ops::{Add, AddAssign, Mul, Sub};

use super::{LANES, Lanes};

/// Start of 1/√x: the bits of x, halved and subtracted from this, have about the right exponent.
pub(super) const RSQRT_MAGIC: i64 = 0x5FE6_EB50_C7B5_37A9;

/// Adding and subtracting 1.5·2^52 rounds to an integer.
pub(super) const DOUBLE_ROUNDING: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts. The first has few enough digits for exact products.
pub(super) const DOUBLE_LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// In single precision 1.5·2^23 rounds to integers ...
pub(super) const SINGLE_ROUNDING: f64 = 12_582_912.0;
/// ... and ln 2 has a part of a few digits, to be multiplied without rounding.
pub(super) const SINGLE_LN_2: [f64; 2] = [0.693_359_375, -2.121_944_400_546_9e-4];

/// Values that are computed together, of double or of single precision.
pub trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + AddAssign
{
    /// The same in double precision, for sums that must be exact.
    type Wide: Lanes;

    /// Number of sums that a loop over pairs keeps side by side, and adds to in turns. In single
    /// precision there are two: every other pair has sums of its own.
    const TURNS: usize = 1;
    /// Whether the processor's own roots and quotients take less time than a chain of products.
    /// They do in registers of single precision.
    const QUICK_ROOTS: bool = false;
    /// Adding and subtracting this rounds to an integer.
    const ROUNDING: f64 = DOUBLE_ROUNDING;
    /// ln 2 in two parts, the first of few enough digits for exact products.
    const LN_2: [f64; 2] = DOUBLE_LN_2;

    /// Eight values, rounded to this precision.
    fn load(values: &[f64; LANES]) -> Self;
    /// Writes eight values, rounded to single precision.
    fn store_single(self, values: &mut [f32; LANES]);
    /// The values in double precision.
    fn widened(self) -> Self::Wide;
    /// The sum of the values, in double precision, always in the same order.
    #[inline(always)]
    fn total(self) -> f64 {
        self.widened().sum()
    }
    /// Whether `self < bound` in any lane.
    fn any_less(self, bound: Self) -> bool;
    /// The same value everywhere.
    fn splat(value: f64) -> Self;
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
    /// `1 / sqrt(self)`: to 3.5 %, from its bits, as a start for refinement. It is exact if roots
    /// are quick.
    #[inline(always)]
    fn rsqrt_guess(self) -> Self {
        Self::splat(1.0).div(self.sqrt())
    }
    /// `if_less` where `self < bound`, else `otherwise`.
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self;
    /// 2^n, where `self` is n + [`Vector::ROUNDING`] for an integer n in the range of exponents.
    fn power_of_two(self) -> Self;

    /// `1 / sqrt(self)` to about 1e-15 (1e-7 in single precision), for any positive normal number.
    /// It only uses products and sums. They overlap, where a square root and a division would
    /// queue.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        if Self::QUICK_ROOTS {
            return self.rsqrt_guess();
        }
        // With e = 1 - x y², 1/√x = y (1 + e/2 + 3 e²/8 + 5 e³/16 + ...): first two of these terms,
        // then three.
        let y = self.rsqrt_guess();
        let e = (self * y).negated_mul_add(y, Self::splat(1.0));
        let slope = e.mul_add(Self::splat(0.375), Self::splat(0.5));
        let y = (y * e).mul_add(slope, y);
        let e = (self * y).negated_mul_add(y, Self::splat(1.0));
        let slope = e.mul_add(Self::splat(0.3125), Self::splat(0.375));
        let slope = e.mul_add(slope, Self::splat(0.5));
        (y * e).mul_add(slope, y)
    }

    /// √self and its inverse.
    #[inline(always)]
    fn roots(self) -> [Self; 2] {
        if Self::QUICK_ROOTS {
            let root = self.sqrt();
            return [root, Self::splat(1.0).div(root)];
        }
        let inverse = self.rsqrt();
        [self * inverse, inverse]
    }
    /// The number that [`Vector::over`] needs to divide by `self`, whose [roots](Vector::roots) are
    /// known.
    #[inline(always)]
    fn divisor(self, [_, inverse]: [Self; 2]) -> Self {
        if Self::QUICK_ROOTS { self } else { inverse * inverse }
    }
    /// `self` divided by the vector of this [`Vector::divisor`].
    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        if Self::QUICK_ROOTS { self.div(divisor) } else { self * divisor }
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
}
