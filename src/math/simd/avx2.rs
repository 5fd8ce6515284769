//! Lanes in two 256-bit registers, with fused multiply-add.

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Mul, Sub};

use super::single::Single;
use super::vector::RSQRT_MAGIC;
use super::{LANES, Lanes, Task, Vector};

/// Eight values in two registers.
#[derive(Clone, Copy)]
pub(super) struct Avx2(pub(super) __m256d, pub(super) __m256d);

/// Compiles and runs a task with AVX2.
///
/// # Safety
/// The processor must have the features named below.
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn run<T: Task>(task: T) -> T::Output {
    task.run::<Avx2>()
}

// SAFETY of every block below: `Avx2` only exists inside `run`, whose caller has checked the
// processor's features; loads and stores go through references to whole arrays.

impl Add for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        unsafe { Avx2(_mm256_add_pd(self.0, other.0), _mm256_add_pd(self.1, other.1)) }
    }
}

impl Sub for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        unsafe { Avx2(_mm256_sub_pd(self.0, other.0), _mm256_sub_pd(self.1, other.1)) }
    }
}

impl Mul for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        unsafe { Avx2(_mm256_mul_pd(self.0, other.0), _mm256_mul_pd(self.1, other.1)) }
    }
}

impl AddAssign for Avx2 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Vector for Avx2 {
    type Wide = Self;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        let lanes = unsafe { _mm256_set1_pd(value) };
        Avx2(lanes, lanes)
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        unsafe {
            Avx2(
                _mm256_fmadd_pd(self.0, factor.0, addend.0),
                _mm256_fmadd_pd(self.1, factor.1, addend.1),
            )
        }
    }
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        unsafe {
            Avx2(
                _mm256_fmsub_pd(self.0, factor.0, subtrahend.0),
                _mm256_fmsub_pd(self.1, factor.1, subtrahend.1),
            )
        }
    }
    #[inline(always)]
    fn negated_mul_add(self, factor: Self, addend: Self) -> Self {
        unsafe {
            Avx2(
                _mm256_fnmadd_pd(self.0, factor.0, addend.0),
                _mm256_fnmadd_pd(self.1, factor.1, addend.1),
            )
        }
    }
    #[inline(always)]
    fn div(self, divisor: Self) -> Self {
        unsafe { Avx2(_mm256_div_pd(self.0, divisor.0), _mm256_div_pd(self.1, divisor.1)) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Avx2(_mm256_sqrt_pd(self.0), _mm256_sqrt_pd(self.1)) }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        unsafe { Avx2(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)) }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        unsafe { Avx2(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)) }
    }
    #[inline(always)]
    fn rsqrt_guess(self) -> Self {
        unsafe {
            let magic = _mm256_set1_epi64x(RSQRT_MAGIC);
            let low = _mm256_srli_epi64::<1>(_mm256_castpd_si256(self.0));
            let high = _mm256_srli_epi64::<1>(_mm256_castpd_si256(self.1));
            Avx2(
                _mm256_castsi256_pd(_mm256_sub_epi64(magic, low)),
                _mm256_castsi256_pd(_mm256_sub_epi64(magic, high)),
            )
        }
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        unsafe {
            let low = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, bound.0);
            let high = _mm256_cmp_pd::<_CMP_LT_OQ>(self.1, bound.1);
            Avx2(
                _mm256_blendv_pd(otherwise.0, if_less.0, low),
                _mm256_blendv_pd(otherwise.1, if_less.1, high),
            )
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        unsafe {
            let half = |v: __m256d| {
                let shifted = _mm256_slli_epi64::<52>(_mm256_castpd_si256(v));
                _mm256_castsi256_pd(_mm256_add_epi64(shifted, _mm256_set1_epi64x(1023 << 52)))
            };
            Avx2(half(self.0), half(self.1))
        }
    }
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        let at = values.as_ptr();
        unsafe { Avx2(_mm256_loadu_pd(at), _mm256_loadu_pd(at.add(4))) }
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        let at = values.as_mut_ptr();
        unsafe {
            _mm_storeu_ps(at, _mm256_cvtpd_ps(self.0));
            _mm_storeu_ps(at.add(4), _mm256_cvtpd_ps(self.1));
        }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        unsafe {
            let low = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, bound.0);
            let high = _mm256_cmp_pd::<_CMP_LT_OQ>(self.1, bound.1);
            _mm256_movemask_pd(_mm256_or_pd(low, high)) != 0
        }
    }
    #[inline(always)]
    fn widened(self) -> Self {
        self
    }
}

impl Lanes for Avx2 {
    type Single = Single;

    #[inline(always)]
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self {
        let last = at.iter().fold(0, |last, &at| last.max(at));
        assert!((last as usize) < values.len());
        // SAFETY: all places lie inside, below 2^31 as no larger array is made.
        unsafe {
            let low = _mm_loadu_si128(at.as_ptr().cast());
            let high = _mm_loadu_si128(at.as_ptr().add(4).cast());
            Avx2(
                _mm256_i32gather_pd::<8>(values.as_ptr(), low),
                _mm256_i32gather_pd::<8>(values.as_ptr(), high),
            )
        }
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; LANES]) {
        let at = values.as_mut_ptr();
        unsafe {
            _mm256_storeu_pd(at, self.0);
            _mm256_storeu_pd(at.add(4), self.1);
        }
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        let at = values.as_ptr();
        unsafe { Avx2(_mm256_cvtps_pd(_mm_loadu_ps(at)), _mm256_cvtps_pd(_mm_loadu_ps(at.add(4)))) }
    }
    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        unsafe { run(task) }
    }
    #[inline(always)]
    fn prefetch<T>(value: &T, ahead: usize) {
        // SAFETY: a hint, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(value).wrapping_add(ahead).cast()) }
    }
}
