//! The truncated Gaussian of Huang et al. 2019.

use super::Kernel;
use crate::math::simd::Vector;

/// w(q) = e^{-9 q²} - e^{-9}, h = R/3 (Huang et al. 2019, Eq. 7 with the cut-off δ = 3 h; its
/// integral in closed form, where the paper prints the integral itself).
#[derive(Debug, Clone, Copy)]
pub struct Gaussian;

const CUTOFF_OVER_H_SQUARED: f64 = 9.0;

impl Kernel for Gaussian {
    const SMOOTHING_LENGTH_RATIO: f64 = 1.0 / 3.0;
    const SLOPE_FACTOR: f64 = -2.0 * CUTOFF_OVER_H_SQUARED;

    fn normalisation() -> f64 {
        // 2π ∫ q (e^{-9 q²} - e^{-9}) dq = π ((1 - e^{-9})/9 - e^{-9})
        let tail = libm::exp(-CUTOFF_OVER_H_SQUARED);
        1.0 / (std::f64::consts::PI * ((1.0 - tail) / CUTOFF_OVER_H_SQUARED - tail))
    }

    #[inline(always)]
    fn shape<V: Vector>(s: V, _inverse_q: V) -> V {
        let tail = 1.234_098_040_866_795_6e-4; // e^{-9}
        let inside = s.min(V::splat(1.0));
        (inside * V::splat(-CUTOFF_OVER_H_SQUARED)).exp() - V::splat(tail)
    }

    #[inline(always)]
    fn slope_over_q<V: Vector>(s: V, _: [V; 2]) -> V {
        let inside = s.min(V::splat(1.0));
        let bell = (inside * V::splat(-CUTOFF_OVER_H_SQUARED)).exp();
        s.select_less(V::splat(1.0), bell, V::splat(0.0))
    }
}
