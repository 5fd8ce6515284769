//! Lanes in one 512-bit register.

use std::arch::x86_64::*;

use super::avx2::Single;
use super::registers::{arithmetic, operators};
use super::vector::RSQRT_MAGIC;
use super::{LANES, Lanes, Task, Vector};

/// Eight values in a register.
#[derive(Clone, Copy)]
pub(super) struct Avx512(pub(super) __m512d);

/// Compiles and runs a task with AVX-512.
///
/// # Safety
/// The processor must have the features named below.
#[inline(never)]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
pub(super) unsafe fn run<T: Task>(task: T) -> T::Output {
    task.run::<Avx512>()
}

// `Avx512` only exists inside `run`, whose caller has checked the processor's features. That is what every
// reason below builds on.

operators!(Avx512 [0]: _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd);

impl Vector for Avx512 {
    type Wide = Self;

    arithmetic!([0]:
        _mm512_sqrt_pd, _mm512_div_pd, _mm512_min_pd, _mm512_max_pd,
        _mm512_fmadd_pd, _mm512_fmsub_pd, _mm512_fnmadd_pd
    );

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Avx512(unsafe { _mm512_set1_pd(value) })
    }
    #[inline(always)]
    fn rsqrt_guess(self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Avx512(unsafe {
            let half = _mm512_srli_epi64::<1>(_mm512_castpd_si512(self.0));
            _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_set1_epi64(RSQRT_MAGIC), half))
        })
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Avx512(unsafe {
            let less = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, bound.0);
            _mm512_mask_blend_pd(less, otherwise.0, if_less.0)
        })
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        Avx512(unsafe {
            let shifted = _mm512_slli_epi64::<52>(_mm512_castpd_si512(self.0));
            _mm512_castsi512_pd(_mm512_add_epi64(shifted, _mm512_set1_epi64(1023 << 52)))
        })
    }
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to all values that are read.
        Avx512(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn store_single(self, values: &mut [f32; LANES]) {
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe { _mm256_storeu_ps(values.as_mut_ptr(), _mm512_cvtpd_ps(self.0)) }
    }
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        // SAFETY: the processor has these instructions wherever a value of this type exists.
        unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, bound.0) != 0 }
    }
    #[inline(always)]
    fn widened(self) -> Self {
        self
    }
}

impl Lanes for Avx512 {
    type Single = Single;

    #[inline(always)]
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self {
        let last = at.iter().fold(0, |last, &at| last.max(at));
        assert!((last as usize) < values.len());
        // SAFETY: all places lie inside, below 2^31 as no larger array is made.
        unsafe {
            let at = _mm256_loadu_si256(at.as_ptr().cast());
            Avx512(_mm512_i32gather_pd::<8>(at, values.as_ptr()))
        }
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; LANES]) {
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe { _mm512_storeu_pd(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn store_records<R: AsMut<[f64; 8]>>(numbers: [Self; 8], records: &mut [R; LANES]) {
        let [a, b, c, d, e, f, g, h] = numbers;
        let (a, b, c, d, e, f, g, h) = (a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0);
        // Quarters of a vector: even ones of two, odd ones of two.
        const EVEN: i32 = 0b10_00_10_00;
        const ODD: i32 = 0b11_01_11_01;
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to room for all values that are written.
        unsafe {
            // Pairs of numbers of the records 0, 2, 4, 6, then of 1, 3, 5, 7.
            let low = [
                _mm512_unpacklo_pd(a, b),
                _mm512_unpacklo_pd(c, d),
                _mm512_unpacklo_pd(e, f),
                _mm512_unpacklo_pd(g, h),
            ];
            let high = [
                _mm512_unpackhi_pd(a, b),
                _mm512_unpackhi_pd(c, d),
                _mm512_unpackhi_pd(e, f),
                _mm512_unpackhi_pd(g, h),
            ];
            for (odd, [ab, cd, ef, gh]) in [low, high].into_iter().enumerate() {
                let (near, far) =
                    (_mm512_shuffle_f64x2::<EVEN>(ab, cd), _mm512_shuffle_f64x2::<EVEN>(ef, gh));
                let (first, third) = (
                    _mm512_shuffle_f64x2::<EVEN>(near, far),
                    _mm512_shuffle_f64x2::<ODD>(near, far),
                );
                let (near, far) =
                    (_mm512_shuffle_f64x2::<ODD>(ab, cd), _mm512_shuffle_f64x2::<ODD>(ef, gh));
                let (second, fourth) = (
                    _mm512_shuffle_f64x2::<EVEN>(near, far),
                    _mm512_shuffle_f64x2::<ODD>(near, far),
                );
                for (k, record) in [first, second, third, fourth].into_iter().enumerate() {
                    _mm512_storeu_pd(records[2 * k + odd].as_mut().as_mut_ptr(), record);
                }
            }
        }
    }
    #[inline(always)]
    fn load_single(values: &[f32; LANES]) -> Self {
        // SAFETY: the processor has these instructions wherever a value of this type exists; the
        // reference leads to all values that are read.
        Avx512(unsafe { _mm512_cvtps_pd(_mm256_loadu_ps(values.as_ptr())) })
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
