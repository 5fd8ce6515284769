//! Records in single precision.

use super::record::{Record, SingleRecord};
use crate::math::simd::{Lanes, SimdPath, Task, dispatch};

/// The records of water and ghosts in single precision.
struct Rounding<'a> {
    records: &'a [Record],
    /// Of the water alone.
    strain: &'a [[f64; 2]],
    diffused: &'a [f64],
    /// Rest density, kg/m³.
    rest: f64,
    singles: &'a mut [SingleRecord],
}

impl Task for Rounding<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Rounding { records, strain, diffused, rest, singles } = self;
        for (j, (single, record)) in singles.iter_mut().zip(records).enumerate() {
            *single = if j < strain.len() {
                SingleRecord::new::<L>(record, strain[j], diffused[j] - rest)
            } else {
                SingleRecord::new::<L>(record, [0.0; 2], 0.0)
            };
        }
    }
}

/// Rounds records to single precision, with the water's strain rate and the field that density
/// diffusion smooths, less rest density `rest`, kg/m³.
pub fn round(
    path: SimdPath,
    records: &[Record],
    (strain, diffused, rest): (&[[f64; 2]], &[f64], f64),
    singles: &mut Vec<SingleRecord>,
) {
    singles.resize(records.len(), SingleRecord::default());
    dispatch(path, Rounding { records, strain, diffused, rest, singles });
}
