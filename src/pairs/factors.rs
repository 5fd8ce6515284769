//! The numbers of a neighbour that held passes sum.

/// Numbers of a neighbour, one cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub struct Factors(pub [f64; 8]);

impl AsMut<[f64; 8]> for Factors {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64; 8] {
        &mut self.0
    }
}
