//! The columns of `waves/<case_id>.csv`, in their order: a row for each whole period of a paddle that makes regular
//! waves. Forces are running means over 0.07 √(h/g), as their maxima are.

use super::{Quantity, Unit, quantities};
use crate::simulation::WaveRow;

/// How a column is read.
pub type Read = fn(&WaveRow) -> f64;

const fn column(name: &'static str, unit: Unit, read: Read) -> Quantity<Read> {
    Quantity::new(name, "", unit, read)
}

quantities! { Read;
    /// when the period begins
    FROM = column("from_s", Unit::Seconds, |row| row.from_s);
    /// highest surface at the wave gauge, over still water
    CREST = column("crest_m", Unit::Metres, |row| row.surface_m[0]);
    /// lowest surface there, over still water: negative
    TROUGH = column("trough_m", Unit::Metres, |row| row.surface_m[1]);
    /// amplitude of the surface there at the paddle's frequency
    FIRST_HARMONIC = column("first_harmonic_m", Unit::Metres, |row| row.harmonics_m[0]);
    /// the same at twice the paddle's frequency
    SECOND_HARMONIC = column("second_harmonic_m", Unit::Metres, |row| row.harmonics_m[1]);
    /// largest F*
    FORCE_MAX = column("force_max", Unit::Force, |row| row.force[0]);
    /// smallest F*
    FORCE_MIN = column("force_min", Unit::Force, |row| row.force[1]);
    /// largest R*
    RUNUP_MAX = column("runup_max", Unit::Runup, |row| row.runup_max);
    /// mean of the surface at the wave gauge, over still water
    MEAN = column("mean_m", Unit::Metres, |row| row.mean_m);
}
