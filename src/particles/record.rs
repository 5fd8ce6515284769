//! What a pair loop reads of a neighbour: one cache line.

use crate::kernel::KernelChoice;

/// One neighbour, fluid or ghost, packed into a cache line and scaled for the pair loops.
///
/// Slots: see the associated constants.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Record(pub [f64; 8]);

impl AsMut<[f64; 8]> for Record {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64; 8] {
        &mut self.0
    }
}

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

/// A neighbour as [`Record`] has it, in single precision: one cache line, too.
///
/// A place is a multiple of 2^-6 R and a rest, so that differences of places lose nothing: those of
/// the multiples are exact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct SingleRecord {
    /// x over R: multiple and rest.
    pub x: [f32; 2],
    /// y over R.
    pub y: [f32; 2],
    /// Velocity, m/s.
    pub velocity: [f32; 2],
    /// See [`Record::WEIGHT`].
    pub weight: f32,
    /// Pressure times correction, Pa: xx, xy, yy.
    pub pressure: [f32; 3],
    /// Half the differences of the velocity gradient, of fluid.
    pub strain: [f32; 2],
}

impl SingleRecord {
    /// A record and a strain, rounded.
    #[inline(always)]
    pub fn new(record: &Record, strain: [f64; 2]) -> SingleRecord {
        let [x, y, vx, vy, weight, xx, xy, yy] = record.0;
        SingleRecord {
            x: split(x),
            y: split(y),
            velocity: [vx as f32, vy as f32],
            weight: weight as f32,
            pressure: [xx as f32, xy as f32, yy as f32],
            strain: [strain[0] as f32, strain[1] as f32],
        }
    }
}

/// A place as a multiple of 2^-6 and the rest of it.
#[inline(always)]
pub fn split(place: f64) -> [f32; 2] {
    // Adding 1.5·2^46 rounds to multiples of 2^-6.
    const ROUNDING: f64 = 1.5 * (1_u64 << 46) as f64;
    let multiple = (place + ROUNDING) - ROUNDING;
    [multiple as f32, (place - multiple) as f32]
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
