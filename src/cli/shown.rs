//! Paths and texts of unknown origin, as results and messages show them.

use std::path::{Path, PathBuf};

pub(super) use crate::keys::{named as told, shown};

/// A path for JSON, which knows no other text than UTF-8.
pub(super) fn path(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Paths for JSON.
pub(super) fn paths(paths: &[PathBuf]) -> Vec<String> {
    paths.iter().map(|it| path(it)).collect()
}
