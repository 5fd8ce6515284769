//! Wendland C4: w(q) = (1 - q)⁶ (1 + 6 q + 35/3 q²).

use super::Kernel;
use crate::math::simd::Vector;

/// w(q) = (1 - q)⁶ (1 + 6 q + 35/3 q²), C = 9/π (Wendland 1995; Dehnen & Aly 2012, Table 1).
///
/// Narrower than Wendland C2 of the same support, so it wants a larger one. h = 0.437 R gives it
/// C2's width over h: by the standard deviation, as Dehnen & Aly measure (2.171 against 1.897).
#[derive(Debug, Clone, Copy)]
pub struct WendlandC4;

impl Kernel for WendlandC4 {
    const SMOOTHING_LENGTH_RATIO: f64 = 0.437;
    const SLOPE_FACTOR: f64 = -56.0 / 3.0;

    fn normalisation() -> f64 {
        9.0 / std::f64::consts::PI
    }

    #[inline(always)]
    fn shape<V: Vector>(s: V, inverse_q: V) -> V {
        let (one, q) = (V::splat(1.0), s * inverse_q);
        let t = (one - q).max(V::splat(0.0));
        let t2 = t * t;
        let rest = q.mul_add(V::splat(35.0 / 3.0), V::splat(6.0)).mul_add(q, one);
        t2 * t2 * t2 * rest
    }

    #[inline(always)]
    fn slope_over_q<V: Vector>(_: V, [q, _]: [V; 2]) -> V {
        let one = V::splat(1.0);
        let t = (one - q).max(V::splat(0.0));
        let t2 = t * t;
        t2 * t2 * t * q.mul_add(V::splat(5.0), one)
    }
}
