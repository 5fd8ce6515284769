//! The data of a neighbour for pair loops: one cache line.

use crate::kernel::KernelChoice;
use crate::math::simd::{LANES, Lanes, Vector};

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
    /// Volume times C/R³ and the kernel's slope factor. It turns the kernel's w'(q)/q times a
    /// scaled distance into V ∇W.
    pub const WEIGHT: usize = 4;
    /// Pressure times correction, Pa, xx component. It is the pressure itself if the scheme has no
    /// corrections.
    pub const PRESSURE: usize = 5;
    /// Its xy component.
    pub const PRESSURE_XY: usize = 6;
    /// Its yy component.
    pub const PRESSURE_YY: usize = 7;

    /// Puts a velocity in, m/s.
    #[inline(always)]
    pub fn set_velocity(&mut self, [u, v]: [f64; 2]) {
        (self.0[Self::VX], self.0[Self::VY]) = (u, v);
    }

    /// Puts a pressure times its correction in, Pa: xx, xy, yy.
    #[inline(always)]
    pub fn set_pressure(&mut self, [xx, xy, yy]: [f64; 3]) {
        let Record([.., to_xx, to_xy, to_yy]) = self;
        (*to_xx, *to_xy, *to_yy) = (xx, xy, yy);
    }
}

/// A neighbour as in [`Record`], in single precision, also in one cache line.
///
/// The first eight slots are those of a record. A place is split into a multiple of 2^-6 R, in the
/// slots of the place, and a rest. Differences of the multiples are exact, so differences of places
/// lose nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct SingleRecord(pub [f32; 16]);

impl SingleRecord {
    /// The rest of x over R.
    pub const X_REST: usize = 8;
    /// The rest of y over R.
    pub const Y_REST: usize = 9;
    /// Half the difference of the velocity gradient's diagonal, of fluid.
    pub const STRETCH: usize = 10;
    /// Half the sum of the other two.
    pub const SHEAR: usize = 11;
    /// The field that density diffusion smooths, less rest density, of fluid, kg/m³.
    pub const DIFFUSED: usize = 12;

    /// A record, its strain rate, and the field that density diffusion smooths less rest density,
    /// all rounded.
    #[inline(always)]
    pub fn new<L: Lanes>(record: &Record, strain: [f64; 2], diffused: f64) -> SingleRecord {
        let values = L::load(&record.0);
        let [multiples, rests] = split(values);
        let (mut of_places, mut of_rests) = ([0.0; LANES], [0.0; LANES]);
        multiples.store_single(&mut of_places);
        rests.store_single(&mut of_rests);
        let mut numbers = [0.0; 16];
        values.store_single(numbers.first_chunk_mut().unwrap());
        [numbers[Record::X], numbers[Record::Y]] = [of_places[Record::X], of_places[Record::Y]];
        [numbers[Self::X_REST], numbers[Self::Y_REST]] = [of_rests[Record::X], of_rests[Record::Y]];
        numbers[Self::STRETCH] = strain[0] as f32;
        numbers[Self::SHEAR] = strain[1] as f32;
        numbers[Self::DIFFUSED] = diffused as f32;
        SingleRecord(numbers)
    }
}

/// Places as multiples of 2^-6, and their rests.
#[inline(always)]
pub fn split<V: Vector>(places: V) -> [V; 2] {
    // Adding 1.5·2^46 rounds to multiples of 2^-6.
    let rounding = V::splat(1.5 * (1_u64 << 46) as f64);
    let multiples = (places + rounding) - rounding;
    [multiples, places - multiples]
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
