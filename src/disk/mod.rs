//! The system calls that change a study's files, all in one place, so that tests can make each of
//! them fail. [`write_whole`] writes a file that readers find complete or not at all.

pub(crate) mod names;
mod whole_file;

use std::fs::{self, File, OpenOptions};
use std::io::{Result, Write};
use std::path::Path;

pub(crate) use whole_file::{PARTIAL, put, write_whole};

/// Creates a file, or empties it.
pub(crate) fn create(path: &Path) -> Result<File> {
    faults::next()?;
    File::create(path)
}

/// Opens a file for writing at its end.
pub(crate) fn append(path: &Path) -> Result<File> {
    faults::next()?;
    OpenOptions::new().append(true).create(true).open(path)
}

/// Writes all bytes. After a failure some of them may be there.
pub(crate) fn write(mut file: &File, bytes: &[u8]) -> Result<()> {
    if let Err(error) = faults::next() {
        file.write_all(&bytes[..bytes.len() / 2])?;
        return Err(error);
    }
    file.write_all(bytes)
}

/// Cuts a file to this length, on the disk as well. Some systems cannot cut files that are open for
/// appending.
pub(crate) fn cut(path: &Path, length: u64) -> Result<()> {
    faults::next()?;
    let file = OpenOptions::new().write(true).open(path)?;
    file.set_len(length)?;
    sync(&file)
}

/// Creates a file that does not exist, which gets its name only when it is complete. Returns
/// whether it did. This is less work for the file system than a change of name.
#[cfg(target_os = "linux")]
pub(crate) fn write_new(path: &Path, bytes: &[u8]) -> bool {
    use rustix::fs::{AtFlags, CWD, Mode, OFlags};
    use std::os::fd::AsRawFd;
    use std::sync::atomic::{AtomicBool, Ordering};
    /// Whether an open file can be named directly; until Linux 6.10 only root could. Its path in
    /// `/proc` works for everybody, but must be looked up.
    static BY_ITSELF: AtomicBool = AtomicBool::new(true);
    let made = || {
        faults::next()?;
        let folder = path.parent().unwrap_or(path);
        let flags = OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC;
        let file = File::from(rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666))?);
        write(&file, bytes)?;
        faults::next()?;
        if BY_ITSELF.load(Ordering::Relaxed) {
            match rustix::fs::linkat(&file, "", CWD, path, AtFlags::EMPTY_PATH) {
                Err(rustix::io::Errno::NOENT) => BY_ITSELF.store(false, Ordering::Relaxed),
                other => return Ok(other?),
            }
        }
        let open = format!("/proc/self/fd/{}", file.as_raw_fd());
        Ok(rustix::fs::linkat(CWD, open, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
    };
    let made: Result<()> = made();
    made.is_ok()
}

/// Other systems have no files without names.
#[cfg(not(target_os = "linux"))]
pub(crate) fn write_new(_path: &Path, _bytes: &[u8]) -> bool {
    false
}

/// Puts a file's content, or the names in a folder, on the disk.
pub(crate) fn sync(file: &File) -> Result<()> {
    faults::next()?;
    if cfg!(test) { Ok(()) } else { file.sync_all() } // tests pull no plugs
}

/// Puts a file's content on the disk.
pub(crate) fn sync_data(file: &File) -> Result<()> {
    faults::next()?;
    if cfg!(test) { Ok(()) } else { file.sync_data() }
}

/// Puts all waiting data of an open folder's file system on the disk, if that file system is known
/// to do so completely. Returns whether it did.
#[cfg(target_os = "linux")]
pub(crate) fn sync_all(folder: &File) -> bool {
    /// ext2 to ext4, XFS, Btrfs, in memory, overlays.
    const KNOWN: [u64; 5] = [0xEF53, 0x5846_5342, 0x9123_683E, 0x0102_1994, 0x794C_7630];
    let known = || {
        let system = rustix::fs::fstatfs(folder).map(|told| told.f_type as u64);
        system.is_ok_and(|system| KNOWN.contains(&system))
    };
    faults::next().is_ok() && known() && (cfg!(test) || rustix::fs::syncfs(folder).is_ok())
}

/// Other systems have no such call.
#[cfg(not(target_os = "linux"))]
pub(crate) fn sync_all(_folder: &File) -> bool {
    false
}

/// Gives a file or folder another name.
pub(crate) fn rename(from: &Path, to: &Path) -> Result<()> {
    faults::next()?;
    fs::rename(from, to)
}

/// Exchanges the names of two folders in one step, so that both names always exist. Returns whether
/// it did.
#[cfg(target_os = "linux")]
pub(crate) fn exchange(one: &Path, other: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    faults::next().is_ok() && renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).is_ok()
}

/// Other systems have no such call.
#[cfg(not(target_os = "linux"))]
pub(crate) fn exchange(_one: &Path, _other: &Path) -> bool {
    false
}

/// Removes a file.
pub(crate) fn remove_file(path: &Path) -> Result<()> {
    faults::next()?;
    fs::remove_file(path)
}

/// Makes a folder and those above it.
pub(crate) fn create_folder(path: &Path) -> Result<()> {
    faults::next()?;
    fs::create_dir_all(path)
}

/// Makes a folder in one that exists. If that was removed, it is not made again.
pub(crate) fn create_folder_in(path: &Path) -> Result<()> {
    faults::next()?;
    match fs::create_dir(path) {
        // Another process was faster.
        Err(_) if path.is_dir() => Ok(()),
        made => made,
    }
}

/// Removes a folder and all in it.
pub(crate) fn remove_folder(path: &Path) -> Result<()> {
    faults::next()?;
    fs::remove_dir_all(path)
}

/// A writer to a file, piece by piece.
pub(crate) struct Writer<'a>(pub(crate) &'a File);

impl Write for Writer<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        write(self.0, bytes).map(|()| bytes.len())
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

/// No faults on their own.
#[cfg(not(test))]
mod faults {
    pub(super) fn next() -> std::io::Result<()> {
        Ok(())
    }
}

/// Faults on demand, in the calls of one thread.
#[cfg(test)]
pub(crate) mod faults {
    use std::cell::Cell;
    use std::io::{Error, Result};

    thread_local! {
        static CALLS: Cell<usize> = const { Cell::new(0) };
        static FAILING: Cell<[usize; 2]> = const { Cell::new([usize::MAX; 2]) };
    }

    /// From now on the call number `first`, counted from 0, fails, and `more` calls after it.
    pub(crate) fn arm(first: usize, more: usize) {
        CALLS.set(0);
        FAILING.set([first, first.saturating_add(more)]);
    }

    /// Ends the faults. Returns the number of calls.
    pub(crate) fn disarm() -> usize {
        FAILING.set([usize::MAX; 2]);
        CALLS.get()
    }

    pub(super) fn next() -> Result<()> {
        let call = CALLS.replace(CALLS.get() + 1);
        let [first, last] = FAILING.get();
        if call >= first && call <= last {
            return Err(Error::other("the disk is full, says a test"));
        }
        Ok(())
    }
}
