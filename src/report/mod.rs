//! Tables and figures from files alone.

use std::path::{Path, PathBuf};

/// Writes the report of an output directory and returns the path of `report.html`.
///
/// # Errors
/// Where the directory's files cannot be read or the report cannot be written.
pub fn write(out_dir: &Path) -> anyhow::Result<PathBuf> {
    // To come: see the report layer.
    Ok(out_dir.join("report.html"))
}
