//! Replaces the `mpi` executor in a build without the feature of that name.

use super::{Crew, Launcher, Setup};
use crate::results::SweepError;

/// Whether this build can run under MPI.
pub const AVAILABLE: bool = false;

/// Refuses.
///
/// # Errors
/// Always.
pub fn with_crew(
    _setup: &Setup<'_>,
    _launcher: Launcher,
    _lead: impl FnOnce(&mut dyn Crew) -> u8,
) -> Result<u8, SweepError> {
    Err(SweepError::Refused(
        "this build has no MPI: rebuild with `cargo build --release --features mpi`".to_owned(),
    ))
}
