//! One process per output directory: an advisory lock that ends with its holder.
//!
//! It is on a file in the directory, and on the directory itself if its file system has such locks.
//! So deleting the file does not let another process in.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind::NotFound;
use std::path::Path;
use std::time::{Duration, Instant};

use super::atomic_file;
use super::error::SweepError;

pub(super) const FILE_NAME: &str = "lock";
const PATIENCE: Duration = Duration::from_secs(5);
const PAUSE: Duration = Duration::from_millis(50);

/// A held lock; dropping it releases it.
#[derive(Debug)]
pub struct Lock {
    _file: File,
    _directory: Option<File>,
}

/// Whether a try has shown that another process holds a lock.
fn is_taken<T>(tried: &Result<T, TryLockError>) -> bool {
    matches!(tried, Err(TryLockError::WouldBlock))
}

impl Lock {
    /// Locks a directory, waiting up to 5 s for another process to leave it.
    ///
    /// # Errors
    /// The other process does not leave, or the file cannot be opened.
    pub fn hold(directory: &Path) -> Result<Lock, SweepError> {
        Lock::hold_within(directory, PATIENCE)
    }

    fn hold_within(directory: &Path, patience: Duration) -> Result<Lock, SweepError> {
        let path = directory.join(FILE_NAME);
        let open = || OpenOptions::new().write(true).create(true).truncate(false).open(&path);
        let start = Instant::now();
        loop {
            // This is no fault of the machine: the directory is another user's or read-only.
            let file = match open() {
                // Another process has moved the directory aside and is about to put a new one in
                // its place.
                Err(error) if error.kind() == NotFound && start.elapsed() < patience => {
                    std::thread::sleep(PAUSE);
                    continue;
                }
                open => open.map_err(|error| SweepError::unusable(directory, &error))?,
            };
            let whole = File::open(directory).ok();
            let tried = whole.as_ref().map_or(Ok(()), File::try_lock);
            let tried = if is_taken(&tried) { tried } else { file.try_lock() };
            match tried {
                // The holder may have moved the directory aside.
                Ok(()) if !atomic_file::is_same(&file, &path) => {}
                Ok(()) => return Ok(Lock { _file: file, _directory: whole }),
                Err(TryLockError::WouldBlock) if start.elapsed() < patience => {
                    std::thread::sleep(PAUSE);
                }
                Err(TryLockError::WouldBlock) => {
                    return Err(SweepError::refused(directory, "another process is at work here"));
                }
                Err(TryLockError::Error(source)) => return Err(SweepError::io(&path)(source)),
            }
        }
    }

    /// Whether a process works in a directory.
    pub fn is_held(directory: &Path) -> bool {
        let both = [File::open(directory), File::open(directory.join(FILE_NAME))];
        // A shared lock: two that look at once do not see each other.
        both.iter().flatten().any(|file| is_taken(&file.try_lock_shared()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_lock_is_refused_and_a_dropped_one_free() {
        let directory = tempfile::tempdir().unwrap();
        let lock = Lock::hold(directory.path()).unwrap();
        assert!(Lock::is_held(directory.path()));
        let wait = Duration::from_millis(60);
        assert!(Lock::hold_within(directory.path(), wait).unwrap_err().is_refusal());
        // Without the file a second process once got in.
        std::fs::remove_file(directory.path().join(FILE_NAME)).unwrap();
        assert!(Lock::is_held(directory.path()));
        assert!(Lock::hold_within(directory.path(), wait).unwrap_err().is_refusal());
        drop(lock);
        assert!(!Lock::is_held(directory.path()));
        Lock::hold(directory.path()).unwrap();
    }
}
