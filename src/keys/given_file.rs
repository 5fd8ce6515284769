//! The bytes of a file that the user names. It may be a device or a pipe.

use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result};
use std::os::unix::fs::FileTypeExt;
use std::path::Path;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// The longest file that is read, MiB: devices have no end.
const LONGEST_MIB: u64 = 64;
/// A named pipe may wait this long for a writer.
const PATIENCE: Duration = Duration::from_secs(1);

/// All bytes of a file.
///
/// # Errors
/// A file that cannot be read or is too long, or a pipe without a writer.
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

/// The open file. Opening a named pipe waits until its other end is opened, so a thread does it.
fn opened(path: &Path) -> Result<File> {
    if !path.metadata()?.file_type().is_fifo() {
        return File::open(path);
    }
    let (sender, receiver) = mpsc::channel();
    let path = path.to_owned();
    // Nobody receives this if the wait has ended.
    thread::spawn(move || drop(sender.send(File::open(path))));
    let silent = |_| Error::new(ErrorKind::TimedOut, "nobody writes into this pipe");
    receiver.recv_timeout(PATIENCE).map_err(silent)?
}
