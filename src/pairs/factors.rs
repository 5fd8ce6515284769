//! The numbers of a neighbour that held passes sum.

use crate::math::simd::Lanes;

/// Numbers of a neighbour, one cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub struct Factors(pub [f64; 8]);

impl Factors {
    /// For a pressure times its correction, P, at a place r: P_xx, P_xy, P_yy, (P r)_x, (P r)_y.
    #[inline(always)]
    pub fn of_pressure<D: Lanes>([xx, xy, yy]: [D; 3], [x, y]: [D; 2]) -> [D; 8] {
        let nothing = D::splat(0.0);
        [xx, xy, yy, xx * x + xy * y, xy * x + yy * y, nothing, nothing, nothing]
    }
}

impl AsMut<[f64; 8]> for Factors {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64; 8] {
        &mut self.0
    }
}
