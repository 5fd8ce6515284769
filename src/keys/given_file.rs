//! The bytes of a file that the user names, which may be a device or a pipe.

use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result};
use std::os::unix::fs::FileTypeExt;
use std::path::Path;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// The longest file that is taken, MiB: devices have no end.
const LONGEST_MIB: u64 = 64;
/// So long a named pipe may be without anybody who writes into it.
const PATIENCE: Duration = Duration::from_secs(1);

/// All bytes of a file.
///
/// # Errors
/// One that cannot be read, that is longer than any such file, or a pipe into which nobody writes.
pub fn bytes_of(path: &Path) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    opened(path)?.take((LONGEST_MIB << 20) + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LONGEST_MIB << 20 {
        return Err(Error::new(
            ErrorKind::InvalidData,
            format!("is longer than {LONGEST_MIB} MiB, the most that is read"),
        ));
    }
    Ok(bytes)
}

/// The open file. Opening a named pipe lasts until somebody opens its other end: a thread waits for that.
fn opened(path: &Path) -> Result<File> {
    if !path.metadata()?.file_type().is_fifo() {
        return File::open(path);
    }
    let (sender, receiver) = mpsc::channel();
    let path = path.to_owned();
    // Nobody listens any more where patience has ended.
    thread::spawn(move || drop(sender.send(File::open(path))));
    let silent = |_| Error::new(ErrorKind::TimedOut, "nobody writes into this pipe");
    receiver.recv_timeout(PATIENCE).map_err(silent)?
}
