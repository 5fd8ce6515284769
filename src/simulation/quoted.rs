//! The largest values that are quoted of a run, by the names of their columns.

use super::outcome::{Maximum, Outcome};

/// The largest force of the run, and that of the first impact where it is another one.
pub(super) fn forces(outcome: &Outcome) -> impl Iterator<Item = (&'static str, Maximum)> {
    let other = outcome.first_force_max.filter(|first| first.time_s != outcome.force_max.time_s);
    told([("force_max", Some(outcome.force_max)), ("first_force_max", other)])
}

/// The other quoted maxima.
pub(super) fn others(outcome: &Outcome) -> impl Iterator<Item = (&'static str, Maximum)> {
    told([
        ("runup_max", Some(outcome.runup_max)),
        ("displacement_max", outcome.displacement_max),
        ("first_runup_max", outcome.first_runup_max),
        ("first_displacement_max", outcome.first_displacement_max),
    ])
}

/// Those that are there.
fn told<const N: usize>(
    maxima: [(&'static str, Option<Maximum>); N],
) -> impl Iterator<Item = (&'static str, Maximum)> {
    maxima.into_iter().filter_map(|(name, maximum)| Some((name, maximum?)))
}
