//! Pairs in single precision in a 512-bit register: what `precision = "f32"` runs on with AVX-512.

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Mul, Sub};

use super::avx512::Avx512;
use super::vector::{SINGLE_LN_2, SINGLE_ROUNDING};
use super::{LANES, Lanes, Pairs, Vector};

/// Pairs with one neighbour, then those with another.
#[derive(Clone, Copy)]
pub(super) struct Sixteen(__m512);

// SAFETY of every block below: `Sixteen` only exists inside `avx512::run`, whose caller has checked the
// processor's features; loads and stores go through whole arrays.

impl Add for Sixteen {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Sixteen(unsafe { _mm512_add_ps(self.0, other.0) })
    }
}

impl Sub for Sixteen {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Sixteen(unsafe { _mm512_sub_ps(self.0, other.0) })
    }
}

impl Mul for Sixteen {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Sixteen(unsafe { _mm512_mul_ps(self.0, other.0) })
    }
}

impl AddAssign for Sixteen {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Vector for Sixteen {
    const QUICK_ROOTS: bool = true;
    const ROUNDING: f64 = SINGLE_ROUNDING;
    const LN_2: [f64; 2] = SINGLE_LN_2;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Sixteen(unsafe { _mm512_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Sixteen(unsafe { _mm512_fmadd_ps(self.0, factor.0, addend.0) })
    }
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        Sixteen(unsafe { _mm512_fmsub_ps(self.0, factor.0, subtrahend.0) })
    }
    #[inline(always)]
    fn negated_mul_add(self, factor: Self, addend: Self) -> Self {
        Sixteen(unsafe { _mm512_fnmadd_ps(self.0, factor.0, addend.0) })
    }
    #[inline(always)]
    fn div(self, divisor: Self) -> Self {
        Sixteen(unsafe { _mm512_div_ps(self.0, divisor.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Sixteen(unsafe { _mm512_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Sixteen(unsafe { _mm512_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Sixteen(unsafe { _mm512_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn select_less(self, bound: Self, if_less: Self, otherwise: Self) -> Self {
        Sixteen(unsafe {
            let less = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, bound.0);
            _mm512_mask_blend_ps(less, otherwise.0, if_less.0)
        })
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Sixteen(unsafe {
            let shifted = _mm512_slli_epi32::<23>(_mm512_castps_si512(self.0));
            _mm512_castsi512_ps(_mm512_add_epi32(shifted, _mm512_set1_epi32(127 << 23)))
        })
    }
}

/// The pairs with the second neighbour.
const SECOND: __mmask16 = 0xFF00;

impl Sixteen {
    /// The pairs with one of the neighbours.
    #[inline(always)]
    fn half(&self, neighbour: usize) -> __m256 {
        let halves: *const __m256 = std::ptr::from_ref(self).cast();
        unsafe { *halves.add(neighbour % 2) }
    }

    #[inline(always)]
    fn widened(self) -> [Avx512; 2] {
        unsafe {
            let first = _mm512_castps512_ps256(self.0);
            let second = _mm512_extractf32x8_ps::<1>(self.0);
            [Avx512(_mm512_cvtps_pd(first)), Avx512(_mm512_cvtps_pd(second))]
        }
    }

    #[inline(always)]
    fn of_halves(first: __m256, second: __m256) -> Self {
        Sixteen(unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(first), second) })
    }
}

impl Pairs for Sixteen {
    const NEIGHBOURS: usize = 2;
    /// Of the first neighbours, of the second ones.
    type Sum = [Avx512; 2];

    #[inline(always)]
    fn of_particles(numbers: &[f64; LANES]) -> Self {
        let half = unsafe { _mm512_cvtpd_ps(_mm512_loadu_pd(numbers.as_ptr())) };
        Sixteen::of_halves(half, half)
    }
    #[inline(always)]
    fn of_neighbours([first, second]: [f64; 2]) -> Self {
        let (first, second) = (Self::splat(first), Self::splat(second));
        Sixteen(unsafe { _mm512_mask_blend_ps(SECOND, first.0, second.0) })
    }
    #[inline(always)]
    fn out_of<const SLOT: usize>([first, second]: [&[f32; 16]; 2]) -> Self {
        unsafe {
            let first = _mm512_loadu_ps(first.as_ptr());
            let second = _mm512_loadu_ps(second.as_ptr());
            let slot = _mm512_set1_epi32(SLOT as i32);
            // Slots of the second count from 16.
            let slots = _mm512_mask_set1_epi32(slot, SECOND, 16 + SLOT as i32);
            Sixteen(_mm512_permutex2var_ps(first, slots, second))
        }
    }
    #[inline(always)]
    fn picked([first, second]: [&Self; 2], neighbours: [usize; 2]) -> Self {
        Sixteen::of_halves(first.half(neighbours[0]), second.half(neighbours[1]))
    }
    #[inline(always)]
    fn reached(self, bound: Self) -> u64 {
        let less = unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, bound.0) };
        u64::from(less & 0x00FF != 0) | u64::from(less & 0xFF00 != 0) << 1
    }
    #[inline(always)]
    fn store_singles<S: AsMut<[f32; LANES]>>(self, into: &mut [S]) {
        let [first, second] = into.first_chunk_mut().unwrap();
        unsafe {
            _mm256_storeu_ps(first.as_mut().as_mut_ptr(), self.half(0));
            _mm256_storeu_ps(second.as_mut().as_mut_ptr(), self.half(1));
        }
    }
    #[inline(always)]
    fn nothing() -> [Avx512; 2] {
        [Avx512::splat(0.0); 2]
    }
    #[inline(always)]
    fn add_to(self, [first, second]: [Avx512; 2]) -> [Avx512; 2] {
        let [more_first, more_second] = self.widened();
        [first + more_first, second + more_second]
    }
    #[inline(always)]
    fn whole([first, second]: [Avx512; 2]) -> [f64; LANES] {
        (first + second).to_array()
    }
}
