//! One process at a time makes page, figures, tables and films: an advisory lock of its own.
//!
//! The directory's [`Lock`](super::Lock) is for whoever runs cases. A report must not wait for
//! hours until a sweep has ended. Both take this lock while they write the files that are made last.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind::Interrupted;
use std::path::Path;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use super::atomic_file;

pub(super) const FILE_NAME: &str = "derived.lock";
/// How long a process waits in silence.
const SILENCE: Duration = Duration::from_secs(1);
/// How often it then asks whether to give up.
const LOOK: Duration = Duration::from_millis(50);

/// Whether to stop waiting.
pub type Wish<'a> = &'a dyn Fn() -> bool;

/// A held lock. Dropping it releases it, and so does the end of its process.
#[derive(Debug)]
pub struct Making {
    _file: Option<File>,
}

impl Making {
    /// Locks a directory's derived files, once all who have asked before are done. `waits` is
    /// called if that takes more than a second. Where the file cannot be opened or the system has
    /// no locks, there is nothing to wait for: who cannot write finds out at the first file.
    pub fn hold(directory: &Path, waits: impl FnOnce()) -> Making {
        Making::hold_unless(directory, waits, &|| false).unwrap_or(Making { _file: None })
    }

    /// The same; `None` where the other process is still at work after a second and `gives_up` says
    /// not to wait any longer.
    pub fn hold_unless(
        directory: &Path,
        waits: impl FnOnce(),
        gives_up: Wish<'_>,
    ) -> Option<Making> {
        let path = directory.join(FILE_NAME);
        let mut waits = Some(waits);
        loop {
            let open = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
            let Ok(file) = open.or_else(|_| File::open(&path)) else {
                return Some(Making { _file: None });
            };
            let file = match file.try_lock() {
                Ok(()) => Some(file),
                Err(TryLockError::WouldBlock) => waited(file, &mut waits, gives_up)?,
                Err(TryLockError::Error(_)) => None,
            };
            // The directory may have been moved aside meanwhile.
            if file.as_ref().is_none_or(|file| atomic_file::is_same(file, &path)) {
                return Some(Making { _file: file });
            }
        }
    }

    /// Whether a process makes such files, be it this one.
    pub fn is_held(directory: &Path) -> bool {
        let file = File::open(directory.join(FILE_NAME));
        file.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }
}

/// Waits in the system's queue: one that asks again and again may never find the lock free. `None`
/// once it gives up; no file if there is no lock after all.
fn waited(
    file: File,
    waits: &mut Option<impl FnOnce()>,
    gives_up: Wish<'_>,
) -> Option<Option<File>> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let locked = loop {
            match file.lock() {
                Err(error) if error.kind() == Interrupted => {}
                locked => break locked,
            }
        };
        // Nobody waits any more if the process ends.
        let _ = sender.send(locked.ok().map(|()| file));
    });
    let mut patience = SILENCE;
    loop {
        match receiver.recv_timeout(patience) {
            Ok(file) => return Some(file),
            Err(RecvTimeoutError::Disconnected) => return Some(None),
            // The thread goes on waiting, and lets go of the lock once it has it.
            Err(RecvTimeoutError::Timeout) if gives_up() => return None,
            Err(RecvTimeoutError::Timeout) => patience = LOOK,
        }
        waits.take().into_iter().for_each(|waits| waits());
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Instant;

    use super::*;

    #[test]
    fn the_second_waits_until_the_first_is_done() {
        let root = tempfile::tempdir().unwrap();
        let (directory, done) = (root.path(), AtomicBool::new(false));
        assert!(!Making::is_held(directory));
        let first = Making::hold(directory, || unreachable!("it is free"));
        assert!(Making::is_held(directory));
        let mut told = false;
        thread::scope(|scope| {
            scope.spawn(|| {
                thread::sleep(SILENCE + Duration::from_millis(200));
                done.store(true, Ordering::SeqCst);
                drop(first);
            });
            let second = Making::hold(directory, || told = true);
            assert!(done.load(Ordering::SeqCst), "both held it");
            assert!(Making::is_held(directory));
            drop(second);
        });
        assert!(told && !Making::is_held(directory));
    }

    /// The story: a first signal to stop did nothing while a sweep waited here.
    #[test]
    fn who_waits_can_give_up_and_holds_nothing() {
        let root = tempfile::tempdir().unwrap();
        let first = Making::hold(root.path(), || {});
        let mut told = false;
        assert!(Making::hold_unless(root.path(), || told = true, &|| true).is_none());
        assert!(!told, "it gave up before it had anything to tell");
        drop(first);
        drop(Making::hold(root.path(), || {}));
        // Its thread may get the lock now, and lets go of it at once.
        let until = Instant::now() + Duration::from_secs(20);
        while Making::is_held(root.path()) {
            assert!(Instant::now() < until, "it keeps the lock");
            thread::sleep(LOOK);
        }
    }

    #[test]
    fn where_no_file_can_be_made_nobody_waits() {
        let root = tempfile::tempdir().unwrap();
        let nowhere = root.path().join("nowhere");
        drop(Making::hold(&nowhere, || unreachable!("nothing is held")));
        assert!(!Making::is_held(&nowhere) && !nowhere.exists());
    }
}
