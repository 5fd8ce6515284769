//! Lanes in 256-bit registers, with fused multiply-add: two for double precision, one for single.

use std::arch::x86_64::*;

use super::registers::{arithmetic, operators};
use super::vector::{RSQRT_MAGIC, SINGLE_LN_2, SINGLE_ROUNDING};
use super::{LANES, Lanes, Task, Vector};

/// Eight values in two registers.
#[derive(Clone, Copy)]
pub(super) struct Avx2(pub(super) __m256d, pub(super) __m256d);

/// Eight values of single precision in one register: what `precision = "f32"` runs on.
#[derive(Clone, Copy)]
pub(super) struct Single(__m256);

/// Compiles and runs a task with AVX2.
///
/// # Safety
/// The processor must have the features named below.
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn run<T: Task>(task: T) -> T::Output {
    task.run::<Avx2>()
}

// `Avx2` only exists inside `run`, `Single` there or inside `avx512::run`, whose callers have checked the
// processor's features. That is what every reason below builds on.

operators!(Avx2 [0, 1]: _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd);

impl Vector for Avx2 {
    type Wide = Self;

    arithmetic!([0, 1]:
        _mm256_sqrt_pd, _mm256_div_pd, _mm256_min_pd, _mm256_max_pd,
        _mm256_fmadd_pd, _mm256_fmsub_pd, _mm256_fnmadd_pd
    );

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        let lanes = unsafe { _mm256_set1_pd(value) };
        Avx2(lanes, lanes)
    }
    #[inline(always)]
    fn rsqrt_guess(self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
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
        // SAFETY: the processor has these instructions wherever a value of this type exists.
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
        // SAFETY: the processor has these instructions wherever a value of this type exists.
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
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to all values that are read.
        unsafe { Avx2(_mm256_loadu_pd(at), _mm256_loadu_pd(at.add(4))) }
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        let at = values.as_mut_ptr();
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe {
            _mm_storeu_ps(at, _mm256_cvtpd_ps(self.0));
            _mm_storeu_ps(at.add(4), _mm256_cvtpd_ps(self.1));
        }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
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
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe {
            _mm256_storeu_pd(at, self.0);
            _mm256_storeu_pd(at.add(4), self.1);
        }
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        let at = values.as_ptr();
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to all values that are read.
        unsafe { Avx2(_mm256_cvtps_pd(_mm_loadu_ps(at)), _mm256_cvtps_pd(_mm_loadu_ps(at.add(4)))) }
    }
    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: a value of this type exists only where the processor has all that `run` is compiled for.
        unsafe { run(task) }
    }
    #[inline(always)]
    fn prefetch<T>(value: &T, ahead: usize) {
        // SAFETY: a hint, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(value).wrapping_add(ahead).cast()) }
    }
}

operators!(Single [0]: _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps);

impl Vector for Single {
    type Wide = Avx2;

    const TURNS: usize = 2;
    const QUICK_ROOTS: bool = true;
    const ROUNDING: f64 = SINGLE_ROUNDING;
    const LN_2: [f64; 2] = SINGLE_LN_2;

    arithmetic!([0]:
        _mm256_sqrt_ps, _mm256_div_ps, _mm256_min_ps, _mm256_max_ps,
        _mm256_fmadd_ps, _mm256_fmsub_ps, _mm256_fnmadd_ps
    );

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Single(unsafe { _mm256_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Single(unsafe {
            let less = _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0);
            _mm256_blendv_ps(otherwise.0, if_less.0, less)
        })
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Single(unsafe {
            let shifted = _mm256_slli_epi32::<23>(_mm256_castps_si256(self.0));
            _mm256_castsi256_ps(_mm256_add_epi32(shifted, _mm256_set1_epi32(127 << 23)))
        })
    }
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        let at = values.as_ptr();
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to all values that are read.
        unsafe {
            let low = _mm256_cvtpd_ps(_mm256_loadu_pd(at));
            let high = _mm256_cvtpd_ps(_mm256_loadu_pd(at.add(4)));
            Single(_mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high))
        }
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe { _mm256_storeu_ps(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, bound.0)) != 0 }
    }
    #[inline(always)]
    fn widened(self) -> Avx2 {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        unsafe {
            let low = _mm256_castps256_ps128(self.0);
            let high = _mm256_extractf128_ps::<1>(self.0);
            Avx2(_mm256_cvtps_pd(low), _mm256_cvtps_pd(high))
        }
    }
}
