//! The cubic B-spline.

use super::Kernel;
use crate::math::simd::Vector;

/// w(q) = (1 - q)³₊ - 4 (½ - q)³₊, C = 80/(7π), h = R/2 (Monaghan & Lattanzio 1985, in truncated
/// powers, so that no branch is left). Liang et al. 2017 use it.
#[derive(Debug, Clone, Copy)]
pub struct CubicSpline;

impl Kernel for CubicSpline {
    const SMOOTHING_LENGTH_RATIO: f64 = 0.5;
    const SLOPE_FACTOR: f64 = -3.0;

    fn normalisation() -> f64 {
        80.0 / (7.0 * std::f64::consts::PI)
    }

    #[inline(always)]
    fn shape<V: Vector>(s: V, inverse_q: V) -> V {
        let q = s * inverse_q;
        let outer = (V::splat(1.0) - q).max(V::splat(0.0));
        let inner = (V::splat(0.5) - q).max(V::splat(0.0));
        (inner * inner * inner).mul_add(V::splat(-4.0), outer * outer * outer)
    }

    #[inline(always)]
    fn slope_over_q<V: Vector>(_: V, [q, inverse_q]: [V; 2]) -> V {
        let outer = (V::splat(1.0) - q).max(V::splat(0.0));
        let inner = (V::splat(0.5) - q).max(V::splat(0.0));
        (inner * inner).mul_add(V::splat(-4.0), outer * outer) * inverse_q
    }
}
