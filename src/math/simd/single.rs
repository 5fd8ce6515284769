//! Eight values of single precision in a 256-bit register: what `precision = "f32"` runs on.

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Mul, Sub};

use super::avx2::Avx2;
use super::vector::{SINGLE_LN_2, SINGLE_ROUNDING};
use super::{LANES, Vector};

/// Eight values in a register.
#[derive(Clone, Copy)]
pub(super) struct Single(__m256);

// SAFETY of every block below: `Single` only exists inside `avx2::run` or `avx512::run`, whose caller has checked the
// processor's features; loads and stores go through whole arrays.

impl Add for Single {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Single(unsafe { _mm256_add_ps(self.0, other.0) })
    }
}

impl Sub for Single {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Single(unsafe { _mm256_sub_ps(self.0, other.0) })
    }
}

impl Mul for Single {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Single(unsafe { _mm256_mul_ps(self.0, other.0) })
    }
}

impl AddAssign for Single {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Vector for Single {
    type Wide = Avx2;

    const TURNS: usize = 2;
    const QUICK_ROOTS: bool = true;
    const ROUNDING: f64 = SINGLE_ROUNDING;
    const LN_2: [f64; 2] = SINGLE_LN_2;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Single(unsafe { _mm256_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Single(unsafe { _mm256_fmadd_ps(self.0, factor.0, addend.0) })
    }
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        Single(unsafe { _mm256_fmsub_ps(self.0, factor.0, subtrahend.0) })
    }
    #[inline(always)]
    fn negated_mul_add(self, factor: Self, addend: Self) -> Self {
        Single(unsafe { _mm256_fnmadd_ps(self.0, factor.0, addend.0) })
    }
    #[inline(always)]
    fn div(self, divisor: Self) -> Self {
        Single(unsafe { _mm256_div_ps(self.0, divisor.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Single(unsafe { _mm256_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Single(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Single(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        Single(unsafe {
            let less = _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0);
            _mm256_blendv_ps(otherwise.0, if_less.0, less)
        })
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Single(unsafe {
            let shifted = _mm256_slli_epi32::<23>(_mm256_castps_si256(self.0));
            _mm256_castsi256_ps(_mm256_add_epi32(shifted, _mm256_set1_epi32(127 << 23)))
        })
    }
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        let at = values.as_ptr();
        unsafe {
            let low = _mm256_cvtpd_ps(_mm256_loadu_pd(at));
            let high = _mm256_cvtpd_ps(_mm256_loadu_pd(at.add(4)));
            Single(_mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high))
        }
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        unsafe { _mm256_storeu_ps(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0)) != 0 }
    }
    #[inline(always)]
    fn widened(self) -> Avx2 {
        unsafe {
            let low = _mm256_castps256_ps128(self.0);
            let high = _mm256_extractf128_ps::<1>(self.0);
            Avx2(_mm256_cvtps_pd(low), _mm256_cvtps_pd(high))
        }
    }
}
