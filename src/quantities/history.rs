//! The columns of `histories/<case_id>.csv`, in their order: values of the first step at or after
//! each sampling time.

use super::{Quantity, Unit, quantities};
use crate::simulation::HistoryRow;

/// How a column is read.
pub type Read = fn(&HistoryRow) -> f64;

const fn column(name: &'static str, unit: Unit, read: Read) -> Quantity<Read> {
    Quantity::new(name, "", unit, read)
}

quantities! { Read;
    /// the step's own time
    TIME = column("time_s", Unit::Seconds, |row| row.time_s);
    /// force F* on the wall, unfiltered
    FORCE = column("force", Unit::Force, |row| row.force);
    /// runup R*: the surface at the wall, or on a beach the water's edge, over that at rest
    RUNUP = column("runup", Unit::Runup, |row| row.runup);
    /// displacement X* of the wall, away from the water; 0 for a fixed wall
    DISPLACEMENT = column("displacement", Unit::Displacement, |row| row.displacement);
    /// of the wall, away from the water; 0 for a fixed wall
    WALL_VELOCITY = column("wall_velocity_m_per_s", Unit::MetresPerSecond, |row| {
        row.wall_velocity_m_per_s
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::HISTORY_COLUMNS;

    /// The story: a probe called "force" was held against the measured force on the wall.
    #[test]
    fn probes_leave_these_names_alone() {
        let names: Vec<_> = ALL.iter().map(|column| column.name).collect();
        assert_eq!(names[0], TIME.name);
        assert_eq!(names[1..], HISTORY_COLUMNS);
    }
}
