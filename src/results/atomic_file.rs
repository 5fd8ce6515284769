//! A study's files, which readers find complete or not at all. They are written without a name or
//! under a temporary one, then named.

use std::fs::{self, DirEntry, File};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::error::SweepError;
use crate::disk::{self, PARTIAL, write_whole};

/// Writes a file so that no reader, and no crash, ever sees a part of it.
pub(super) fn write(path: &Path, content: &[u8]) -> Result<(), SweepError> {
    write_with(path, |file| disk::write(file, content).map_err(SweepError::io(path)))
}

/// The same for content that is made as it is written.
pub(super) fn write_with(
    path: &Path,
    fill: impl FnOnce(&File) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    write_whole(path, SweepError::io(path), |file| {
        fill(file)?;
        disk::sync(file).map_err(SweepError::io(path))
    })
}

/// The same for readers. A power cut may leave it empty or short, unless it was [synced](sync).
pub(super) fn write_unsynced(path: &Path, content: &[u8]) -> Result<(), SweepError> {
    // An error here shows again in the next lines.
    if disk::write_new(path, content) {
        return Ok(());
    }
    disk::put(path, content).map_err(SweepError::io(path))
}

/// Removes half-written files from folders that exist. The folders are listed in parallel: those of
/// a large study have a million files.
pub(super) fn clean(folders: &[PathBuf]) -> Result<(), SweepError> {
    let left = |folder: &PathBuf| {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let is_partial =
            |entry: &DirEntry| entry.file_name().as_encoded_bytes().ends_with(PARTIAL.as_bytes());
        entries.filter(is_partial).map(|entry| entry.path()).collect::<Vec<_>>()
    };
    let left: Vec<_> = folders.par_iter().flat_map_iter(left).collect();
    left.iter().try_for_each(|path| disk::remove_file(path).map_err(SweepError::io(path)))
}

/// Removes a file, if it exists.
pub(super) fn remove(path: &Path) -> Result<(), SweepError> {
    if path.exists() { disk::remove_file(path).map_err(SweepError::io(path)) } else { Ok(()) }
}

/// Makes a file's content, or the renames inside a directory, durable.
pub(super) fn sync(path: &Path) -> Result<(), SweepError> {
    let file = File::open(path).map_err(SweepError::io(path))?;
    disk::sync(&file).map_err(SweepError::io(path))
}

/// Whether a path still leads to an open file.
pub(super) fn is_same(file: &File, path: &Path) -> bool {
    let [open, named] = [file.metadata(), fs::metadata(path)];
    open.is_ok_and(|open| named.is_ok_and(|named| identity(&open) == identity(&named)))
}

/// Device and number: they identify a file or folder to the system, whatever its name.
pub(super) fn identity(file: &fs::Metadata) -> [u64; 2] {
    use std::os::unix::fs::MetadataExt;
    [file.dev(), file.ino()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.csv");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }
}
