//! The files that a comparison leaves.

use std::path::{Path, PathBuf};

use crate::disk;
use crate::report::Figure;
use crate::results::SweepError;

/// Writes `compare.csv`, and `compare.svg` if there is a figure.
pub(super) fn save(
    out: &Path,
    table: &str,
    figure: Option<&Figure>,
) -> anyhow::Result<Vec<PathBuf>> {
    let bad = |error: std::io::Error| SweepError::unusable(out, &error);
    std::fs::create_dir_all(out).map_err(bad)?;
    let mut files = vec![out.join("compare.csv")];
    disk::put(&files[0], table).map_err(bad)?;
    if let Some(figure) = figure {
        let path = out.join("compare.svg");
        disk::put(&path, figure.svg()).map_err(bad)?;
        files.push(path);
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::faults;

    /// The story: a disk that was full left half a table where a whole one had been.
    #[test]
    fn a_table_that_cannot_be_written_leaves_the_old_one() {
        let out = tempfile::tempdir().unwrap();
        let table = save(out.path(), "old\n", None).unwrap().remove(0);
        for call in 0..3 {
            faults::arm(call, 0);
            let saved = save(out.path(), "new, and longer\n", None);
            assert!(faults::disarm() > call && saved.is_err(), "call {call}");
            assert_eq!(std::fs::read_to_string(&table).unwrap(), "old\n", "call {call}");
            assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 1, "call {call}");
        }
    }
}
