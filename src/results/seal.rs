//! Length and checksum of a file from when it was written, so that damage shows.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::checksum::{checksum, checksum_of_rest};

/// Length and checksum of a file from when it was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Seal {
    /// Its length.
    pub(super) bytes: u64,
    /// The start of its SHA-256, 16 hex digits.
    pub(super) sum: String,
}

impl Seal {
    /// That of a content.
    pub(super) fn of(content: &[u8]) -> Seal {
        Seal { bytes: content.len() as u64, sum: checksum(content) }
    }

    /// That of a file, which may be large.
    pub(super) fn of_file(path: &Path) -> std::io::Result<Seal> {
        let (bytes, sum) = checksum_of_rest(File::open(path)?)?;
        Ok(Seal { bytes, sum })
    }

    /// The fault of a file; `None` if it is unchanged.
    pub(super) fn damage(&self, path: &Path) -> Option<&'static str> {
        match self.fits(path) {
            Some(true) => None,
            _ if path.is_dir() => Some("is a directory"),
            Some(false) => Some("is damaged"),
            None if path.exists() => Some("cannot be read"),
            None => Some("is missing"),
        }
    }

    /// Whether a file is unchanged; `None` if it cannot be read.
    fn fits(&self, path: &Path) -> Option<bool> {
        let mut file = File::open(path).ok()?;
        if self.bytes > ASKED {
            let alike = file.metadata().ok()?.len() == self.bytes;
            return Some(alike && *self == Seal::of_file(path).ok()?);
        }
        let length = usize::try_from(self.bytes).ok()?;
        // Reading one byte more shows at once where it ends. For a million small files each call
        // matters.
        let mut content = vec![0; length + 1];
        let mut read = 0;
        loop {
            match file.read(&mut content[read..]) {
                Ok(0) => break,
                Ok(more) => read += more,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(_) => return None,
            }
            if read >= length {
                break;
            }
        }
        content.truncate(read);
        Some(read == length && self.sum == checksum(&content))
    }
}

/// A larger file is first asked for its length, and is never in memory as a whole.
const ASKED: u64 = 1 << 20;

/// Seals of a case's files by their folders.
pub(super) type Seals = BTreeMap<String, Seal>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_fits_its_seal_alone() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a.csv");
        assert_eq!(Seal::of(b"").fits(&path), None);
        for written in ["", "a,b\n1,2\n"] {
            let seal = Seal::of(written.as_bytes());
            std::fs::write(&path, written).unwrap();
            assert_eq!(seal.fits(&path), Some(true), "{written:?}");
            std::fs::write(&path, format!("{written}3")).unwrap();
            assert_eq!(seal.fits(&path), Some(false), "{written:?} and more");
        }
        std::fs::write(&path, "a,b\n1,").unwrap();
        assert_eq!(Seal::of(b"a,b\n1,2\n").fits(&path), Some(false));
    }
}
