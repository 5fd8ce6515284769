//! A mark in a folder, by which other processes find out whether they see the same folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use super::error::SweepError;

/// How its name begins. Where a process was killed, a mark is left, which says nothing.
const PREFIX: &str = ".seawall-mark-";
/// A file system of a network may take so long to show a new file.
const PATIENCE: Duration = Duration::from_secs(3);
const PAUSE: Duration = Duration::from_millis(50);

/// A file that is there for a moment; it is removed when dropped.
#[derive(Debug)]
pub struct Mark(PathBuf);

impl Mark {
    /// Leaves a mark where results go, or in the nearest folder above that is there already.
    ///
    /// # Errors
    /// Where nothing can be written.
    pub fn leave(directory: &Path) -> Result<Mark, SweepError> {
        let unusable = |error: io::Error| SweepError::unusable(directory, &error);
        let whole = std::path::absolute(directory).map_err(unusable)?;
        let folder = whole.ancestors().find(|part| part.exists()).unwrap_or(Path::new("/"));
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let name = format!("{PREFIX}{:x}-{:x}", now.as_nanos(), process::id());
        let mark = Mark(folder.join(name));
        fs::write(&mark.0, "").map_err(unusable)?;
        Ok(mark)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Whether this process sees a mark that another one has left, now or within a moment.
    pub fn is_seen(path: &Path) -> bool {
        let start = Instant::now();
        while !path.exists() {
            if start.elapsed() >= PATIENCE {
                return false;
            }
            thread::sleep(PAUSE);
        }
        true
    }

    /// Whether a file is one.
    pub(super) fn is_named(name: &std::ffi::OsStr) -> bool {
        name.as_encoded_bytes().starts_with(PREFIX.as_bytes())
    }
}

impl Drop for Mark {
    fn drop(&mut self) {
        // One that stays does no harm.
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_is_seen_while_it_is_there_and_leaves_nothing() {
        let root = tempfile::tempdir().unwrap();
        let mark = Mark::leave(&root.path().join("a/b")).unwrap();
        assert_eq!(mark.path().parent(), Some(root.path()));
        assert!(Mark::is_seen(mark.path()) && Mark::is_named(mark.path().file_name().unwrap()));
        let path = mark.path().to_owned();
        drop(mark);
        assert!(!Mark::is_seen(&path));
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
        let file = root.path().join("file");
        fs::write(&file, "").unwrap();
        let error = Mark::leave(&file).unwrap_err();
        assert!(error.is_refusal() && error.to_string().contains("is a file"), "{error}");
    }
}
