//! The columns of `envelopes/<case_id>.csv`, in their order: a row per height of the wall, as far up as it
//! got wet. Pressures are running means over 0.07 √(h/g), and those after a hit on the stop are left out,
//! as with forces.

use super::{Quantity, Unit, quantities};
use crate::simulation::EnvelopeRow;

/// How a column is read.
pub type Read = fn(&EnvelopeRow) -> Option<f64>;

const fn column(name: &'static str, unit: Unit, read: Read) -> Quantity<Read> {
    Quantity::new(name, "", unit, read)
}

quantities! { Read;
    /// over the bed at the paddle
    HEIGHT = column("height_m", Unit::Metres, |row| Some(row.height_m));
    /// largest pressure of the whole run
    PRESSURE_MAX = column("pressure_max_pa", Unit::Pascal, |row| Some(row.pressure_max_pa));
    /// largest pressure of the first impact; empty where there was none
    FIRST_PRESSURE_MAX = column("first_pressure_max_pa", Unit::Pascal, |row| {
        row.first_pressure_max_pa
    });
}
