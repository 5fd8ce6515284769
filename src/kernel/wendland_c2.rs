//! Wendland C2: w(q) = (1 - q)⁴ (1 + 4 q).

use super::Kernel;
use crate::math::simd::Vector;

/// w(q) = (1 - q)⁴ (1 + 4 q), C = 7/π, h = R/2 (Wendland 1995; Dehnen & Aly 2012).
///
/// Does not clump particles at large support: the default.
#[derive(Debug, Clone, Copy)]
pub struct WendlandC2;

impl Kernel for WendlandC2 {
    const SMOOTHING_LENGTH_RATIO: f64 = 0.5;
    const SLOPE_FACTOR: f64 = -20.0;

    fn normalisation() -> f64 {
        7.0 / std::f64::consts::PI
    }

    #[inline(always)]
    fn shape<V: Vector>(s: V, inverse_q: V) -> V {
        let q = s * inverse_q;
        let t = (V::splat(1.0) - q).max(V::splat(0.0));
        let t2 = t * t;
        t2 * t2 * q.mul_add(V::splat(4.0), V::splat(1.0))
    }

    #[inline(always)]
    fn slope_over_q<V: Vector>(_: V, [q, _]: [V; 2]) -> V {
        let t = (V::splat(1.0) - q).max(V::splat(0.0));
        t * t * t
    }
}
