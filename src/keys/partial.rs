//! The name of a file on its way: it gets its own once it is complete.

use std::path::{Path, PathBuf};

/// The end of such a name. What a killed process leaves under one is removed by who writes next.
pub const PARTIAL: &str = ".partial";

/// Where a file is written before it gets its name.
pub fn partial(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(PARTIAL);
    path.with_file_name(name)
}
