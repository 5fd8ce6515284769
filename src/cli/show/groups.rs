//! Sorts the summary's columns into results, health and parameters.

use crate::quantities::summary::{
    ALL, CASE_ID, COARSE_SPACING, DOUBTFUL_REASON, MEASURED_WAVE_HEIGHT_RATIO, PARTICLES_LOST,
    REASON, STATUS, STOP_IMPULSE,
};
use crate::quantities::{Column, Unit};

/// Columns of results, health and parameters. Bars and flags stand beside their column.
pub(super) fn groups() -> (Vec<&'static Column>, Vec<&'static Column>, Vec<&'static Column>) {
    let belongs = |column: &&Column| {
        ALL.iter().any(|other| [other.bar, other.bound].contains(&Some(column.name)))
    };
    let first = ALL.iter().position(|column| *column == &MEASURED_WAVE_HEIGHT_RATIO).unwrap_or(0);
    let (mut results, mut health, mut parameters) = (Vec::new(), Vec::new(), Vec::new());
    for (place, &column) in ALL.iter().enumerate().filter(|(_, column)| !belongs(column)) {
        let is_health = column.unit == Unit::Percent
            || [&REASON, &DOUBTFUL_REASON, &COARSE_SPACING, &PARTICLES_LOST].contains(&column);
        let is_input = place < first || is_configured(column);
        match (column == &CASE_ID || column == &STATUS, is_health, is_input) {
            (true, ..) => {}
            (_, true, _) => health.push(column),
            (_, _, true) => parameters.push(column),
            _ if column.unit == Unit::Pure && column != &MEASURED_WAVE_HEIGHT_RATIO => {
                health.push(column);
            }
            _ => results.push(column),
        }
    }
    results.sort_by_key(|column| column == &&STOP_IMPULSE);
    (results, health, parameters)
}

/// Whether a column repeats a value of a file: it has the name of a key.
fn is_configured(column: &Column) -> bool {
    let numerics = crate::scene::numerics_keys();
    let scene = crate::scene::scene_keys(crate::scene::Kind::DEFAULT);
    numerics.iter().chain(&scene).any(|key| key.name == column.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_is_told_once() {
        let (results, health, parameters) = groups();
        let told = results.len() + health.len() + parameters.len();
        let beside = ["force_error", "runup_error", "displacement_error", "force_max_error"];
        let more = ["runup_max_error", "moment_error", "moment_max_error"];
        let rest = ["overtopping_volume_error_m2", "displacement_truncated"];
        let beside = beside.len() + more.len() + rest.len();
        assert_eq!(told, ALL.len() - beside - 2, "all but the id, the status, bars and flags");
        assert!(parameters.iter().any(|column| column.name == "particle_spacing_m"));
        assert!(health.iter().any(|column| column.name == "doubtful_reason"));
        assert!(results.iter().any(|column| column.name == "onset_time_s"));
    }
}
