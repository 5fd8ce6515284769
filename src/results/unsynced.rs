//! Files of cases that may not be on the disk yet.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use super::atomic_file;
use super::error::SweepError;
use super::stamp::{CaseFiles, OpenFolders};
use crate::disk;
use crate::disk::names::CASE_FOLDERS;

/// From this many files on, they go to the disk together with all other waiting data. One by one
/// takes seven times as long.
const MANY: usize = 32;
/// At most this many cases that were found on opening go to the disk one by one.
const MOST_FOUND: usize = if cfg!(test) { 2 } else { 10_000 };

/// Files that go to the disk in groups. One by one, the coordinator of many ranks would mostly wait
/// for the disk.
#[derive(Debug)]
pub(super) struct Unsynced {
    /// Open from before the first file, so that failures since then are reported.
    directory: Arc<File>,
    cases: Vec<CaseFiles>,
    /// Number of files found on opening. An earlier process may have died before they were on the
    /// disk.
    found: usize,
    /// Cases whose files were put on the disk by their writers.
    on_disk: Vec<CaseFiles>,
}

impl Unsynced {
    /// The files found in this directory.
    pub(super) fn new(directory: &Path, cases: Vec<CaseFiles>) -> Result<Unsynced, SweepError> {
        let opened = File::open(directory).map_err(SweepError::io(directory))?;
        let found = cases.len();
        Ok(Unsynced { directory: Arc::new(opened), cases, found, on_disk: Vec::new() })
    }

    /// A case has written its files. They may be on the disk already.
    pub(super) fn add(&mut self, files: CaseFiles, on_disk: bool) {
        if on_disk { &mut self.on_disk } else { &mut self.cases }.push(files);
    }

    /// Takes all of them out.
    pub(super) fn take(&mut self) -> Unsynced {
        Unsynced {
            directory: self.directory.clone(),
            cases: std::mem::take(&mut self.cases),
            found: std::mem::take(&mut self.found),
            on_disk: std::mem::take(&mut self.on_disk),
        }
    }

    /// Puts them on the disk. Returns whether those found on opening are there too. For very many
    /// that would take too long, unless the system can do it in one call.
    pub(super) fn sync(&self, directory: &Path) -> Result<bool, SweepError> {
        let files: u32 = self.cases.iter().map(|files| files.folders.count_ones()).sum();
        if files as usize >= MANY && disk::sync_all(&self.directory) {
            return Ok(true);
        }
        let left_out = if self.found > MOST_FOUND { self.found } else { 0 };
        let mut paths = self.cases[left_out..].iter().flat_map(|files| files.paths(directory));
        paths.try_for_each(|path| atomic_file::sync(&path))?;
        let folders = CASE_FOLDERS.map(|name| directory.join(name));
        folders.iter().filter(|path| path.is_dir()).try_for_each(|path| atomic_file::sync(path))?;
        Ok(left_out == 0)
    }

    /// A sum over the system's data on all files that were not found on opening; see
    /// [`CaseFiles::stamp`].
    pub(super) fn stamp(&self, directory: &Path) -> Option<u64> {
        let folders = OpenFolders::of(directory);
        let mut new = self.cases[self.found..].iter().chain(&self.on_disk);
        new.try_fold(0_u64, |sum, files| Some(sum.wrapping_add(files.stamp(&folders)?)))
    }
}
