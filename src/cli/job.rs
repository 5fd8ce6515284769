//! A study that is to be run.

use std::path::PathBuf;

use crate::math::simd::SimdPath;
use crate::results::OpenMode;
use crate::study::Study;

/// A study, where it runs, and how.
pub(super) struct Job {
    pub(super) study: Study,
    pub(super) out: PathBuf,
    pub(super) mode: OpenMode,
    pub(super) retry_failed: bool,
    pub(super) branching: bool,
    /// Whether threads that the runs would leave idle work within them.
    pub(super) shares_threads: bool,
    pub(super) simd: Option<SimdPath>,
    pub(super) overrides: Vec<String>,
}
