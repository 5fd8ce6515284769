//! Eight lanes of single precision in one 256-bit register: what `precision = "f32"` runs on.

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Mul, Sub};

use super::{LANES, Lanes, SINGLE_RSQRT_MAGIC, Task, avx2, avx512};

/// Eight values in a register. The instructions are the same on both paths; `WIDE` ones have twice
/// the registers.
#[derive(Clone, Copy)]
pub(super) struct Single<const WIDE: bool>(__m256);

// SAFETY of every block below: `Single` only exists inside `avx2::run` and `avx512::run`, whose
// callers have checked the processor's features; loads and stores go through whole arrays.

impl<const WIDE: bool> Add for Single<WIDE> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Single(unsafe { _mm256_add_ps(self.0, other.0) })
    }
}

impl<const WIDE: bool> Sub for Single<WIDE> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Single(unsafe { _mm256_sub_ps(self.0, other.0) })
    }
}

impl<const WIDE: bool> Mul for Single<WIDE> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Single(unsafe { _mm256_mul_ps(self.0, other.0) })
    }
}

impl<const WIDE: bool> AddAssign for Single<WIDE> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const WIDE: bool> Lanes for Single<WIDE> {
    type Single = Self;
    const ROUNDING: f64 = super::SINGLE_ROUNDING;
    const LN_2: [f64; 2] = super::SINGLE_LN_2;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self::splat_single(value as f32)
    }
    #[inline(always)]
    fn splat_single(value: f32) -> Self {
        Single(unsafe { _mm256_set1_ps(value) })
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
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self {
        let mut gathered = [0.0; LANES];
        for (value, &at) in gathered.iter_mut().zip(at) {
            *value = values[at as usize];
        }
        Self::load(&gathered)
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; LANES]) {
        let at = values.as_mut_ptr();
        unsafe {
            _mm256_storeu_pd(at, _mm256_cvtps_pd(_mm256_castps256_ps128(self.0)));
            _mm256_storeu_pd(at.add(4), _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(self.0)));
        }
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        Single(unsafe { _mm256_loadu_ps(values.as_ptr()) })
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        unsafe { _mm256_storeu_ps(values.as_mut_ptr(), self.0) }
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
    fn rsqrt_guess(self) -> Self {
        Single(unsafe {
            let half = _mm256_srli_epi32::<1>(_mm256_castps_si256(self.0));
            _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_set1_epi32(SINGLE_RSQRT_MAGIC), half))
        })
    }
    #[inline(always)]
    fn rsqrt(self) -> Self {
        super::single_rsqrt(self)
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        Single(unsafe {
            let less = _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0);
            _mm256_blendv_ps(otherwise.0, if_less.0, less)
        })
    }
    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        unsafe { if WIDE { avx512::run_single(task) } else { avx2::run_single(task) } }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0)) != 0 }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Single(unsafe {
            let shifted = _mm256_slli_epi32::<23>(_mm256_castps_si256(self.0));
            _mm256_castsi256_ps(_mm256_add_epi32(shifted, _mm256_set1_epi32(127 << 23)))
        })
    }
}
