//! Files of cases that a report leaves out because they are damaged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::error::ReportError;

/// Files left out, and faults found on reading. `None`: all must be read. Clones share it.
#[derive(Debug, Clone, Default)]
pub struct Omitted(Option<Arc<Mutex<Files>>>);

/// Files that were already known to be damaged have no words.
type Files = BTreeMap<PathBuf, Option<String>>;

impl Omitted {
    /// Omits these files, and all that turn out to be unreadable.
    pub fn from(known: Vec<PathBuf>) -> Omitted {
        let files = known.into_iter().map(|path| (path, None)).collect();
        Omitted(Some(Arc::new(Mutex::new(files))))
    }

    fn with<T>(&self, ask: impl FnOnce(&mut Files) -> T) -> Option<T> {
        self.0.as_ref().map(|files| ask(&mut files.lock().unwrap_or_else(PoisonError::into_inner)))
    }

    /// Whether a file is left out.
    pub fn has(&self, path: &Path) -> bool {
        self.with(|files| files.contains_key(path)).unwrap_or(false)
    }

    /// Leaves out a damaged file. Returns whether this is allowed.
    pub fn add(&self, path: &Path, why: &dyn std::fmt::Display) -> bool {
        self.with(|files| files.insert(path.to_owned(), Some(why.to_string()))).is_some()
    }

    /// How many files are left out, and the faults found on reading.
    pub fn count_and_faults(&self) -> (usize, Vec<String>) {
        let told = |files: &mut Files| (files.len(), files.values().flatten().cloned().collect());
        self.with(told).unwrap_or_default()
    }

    /// Reads a file; gives the default where the file is missing or left out.
    pub(super) fn read<T: Default>(
        &self,
        path: &Path,
        read: impl FnOnce(&Path) -> Result<T, ReportError>,
    ) -> Result<T, ReportError> {
        if !path.exists() || self.has(path) {
            return Ok(T::default());
        }
        read(path)
            .or_else(|error| if self.add(path, &error) { Ok(T::default()) } else { Err(error) })
    }
}
