//! What a pair loop reads of a neighbour: one cache line.

use crate::kernel::KernelChoice;

/// One neighbour, fluid or ghost, packed into a cache line and scaled for the pair loops.
///
/// Slots: see the associated constants.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Record(pub [f64; 8]);

impl Record {
    /// x over the support radius R.
    pub const X: usize = 0;
    /// y over R.
    pub const Y: usize = 1;
    /// Horizontal velocity, m/s.
    pub const VX: usize = 2;
    /// Vertical velocity, m/s.
    pub const VY: usize = 3;
    /// Volume times C/R³ and the kernel's slope factor: turns what the kernel gives for w'(q)/q
    /// times a scaled distance into ∇W V.
    pub const WEIGHT: usize = 4;
    /// Pressure times correction, Pa, xx component; the pressure itself where the
    /// scheme has no corrections.
    pub const PRESSURE: usize = 5;
    /// Its xy component.
    pub const PRESSURE_XY: usize = 6;
    /// Its yy component.
    pub const PRESSURE_YY: usize = 7;
}

/// Factors between physical and packed values for a kernel and its support radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaling {
    /// R, metres.
    pub support_radius: f64,
    /// 1/R.
    pub inverse_radius: f64,
    /// C/R³ times the kernel's slope factor: volume to [`Record::WEIGHT`].
    pub weight_per_volume: f64,
    /// [`Record::WEIGHT`] to volume times C/R², the factor of w(q) in W V.
    pub shape_per_weight: f64,
}

impl Scaling {
    /// For a kernel of the support radius R, metres.
    pub fn new(kernel: KernelChoice, support_radius: f64) -> Scaling {
        Scaling {
            support_radius,
            inverse_radius: 1.0 / support_radius,
            weight_per_volume: kernel.normalisation() * kernel.slope_factor()
                / support_radius.powi(3),
            shape_per_weight: support_radius / kernel.slope_factor(),
        }
    }
}
