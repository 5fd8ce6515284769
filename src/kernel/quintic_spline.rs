//! The quintic B-spline.

use super::Kernel;
use crate::math::simd::Vector;

/// w(q) = (1 - q)⁵₊ - 6 (⅔ - q)⁵₊ + 15 (⅓ - q)⁵₊, C = 15309/(478π), h = R/3 (Morris et al. 1997,
/// in truncated powers, so that no branch is left).
#[derive(Debug, Clone, Copy)]
pub struct QuinticSpline;

/// (edge - q)₊ and its fourth power.
#[inline(always)]
fn truncated<V: Vector>(edge: f64, q: V) -> (V, V) {
    let base = (V::splat(edge) - q).max(V::splat(0.0));
    let square = base * base;
    (base, square * square)
}

/// outer - 6 middle + 15 inner.
#[inline(always)]
fn combined<V: Vector>(outer: V, middle: V, inner: V) -> V {
    inner.mul_add(V::splat(15.0), middle.mul_add(V::splat(-6.0), outer))
}

impl Kernel for QuinticSpline {
    const SMOOTHING_LENGTH_RATIO: f64 = 1.0 / 3.0;
    const SLOPE_FACTOR: f64 = -5.0;

    fn normalisation() -> f64 {
        15309.0 / (478.0 * std::f64::consts::PI)
    }

    #[inline(always)]
    fn shape<V: Vector>(s: V, inverse_q: V) -> V {
        let q = s * inverse_q;
        let (outer, outer_4) = truncated(1.0, q);
        let (middle, middle_4) = truncated(2.0 / 3.0, q);
        let (inner, inner_4) = truncated(1.0 / 3.0, q);
        combined(outer * outer_4, middle * middle_4, inner * inner_4)
    }

    #[inline(always)]
    fn slope_over_q<V: Vector>(_: V, [q, inverse_q]: [V; 2]) -> V {
        let (_, outer) = truncated(1.0, q);
        let (_, middle) = truncated(2.0 / 3.0, q);
        let (_, inner) = truncated(1.0 / 3.0, q);
        combined(outer, middle, inner) * inverse_q
    }
}
