//! Records in single precision, for the momentum pass.

use super::Wcsph;
use super::precision::Precision;
use crate::math::simd::{Lanes, Task, dispatch};
use crate::particles::{Record, SingleRecord};

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

impl Wcsph {
    /// The records in single precision, where pair terms are.
    pub(super) fn round(&mut self) {
        if self.options.precision == Precision::F32 {
            self.singles.resize(self.records.len(), SingleRecord::default());
            let (records, singles) = (&*self.records, &mut *self.singles);
            let (strain, diffused, rest) = (&*self.strain, &*self.diffused, self.options.density);
            dispatch(self.path, Rounding { records, strain, diffused, rest, singles });
        }
    }
}
