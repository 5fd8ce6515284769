//! Short checksums that show damage.

use std::io::{Read, Result};

use sha2::{Digest, Sha256};

use crate::math::digest::digits;

/// Digits of a sum.
const LENGTH: usize = 16;

/// The start of SHA-256 over some bytes, 16 hex digits.
pub(super) fn checksum(bytes: &[u8]) -> String {
    checksum_of([bytes])
}

/// The same over pieces, one after another.
pub(crate) fn checksum_of<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> String {
    let mut hash = Sha256::new();
    pieces.into_iter().for_each(|piece| hash.update(piece));
    digits(hash)
}

/// The same over the rest of a reader, and its number of bytes.
pub(super) fn checksum_of_rest(mut from: impl Read) -> Result<(u64, String)> {
    let (mut hash, mut bytes) = (Sha256::new(), 0);
    let mut buffer = vec![0; 1 << 20];
    loop {
        let read = from.read(&mut buffer)?;
        if read == 0 {
            return Ok((bytes, digits(hash)));
        }
        hash.update(&buffer[..read]);
        bytes += read as u64;
    }
}

/// What stands around a text and its sum in a file: before the sum, between it and the text, and after
/// the text.
pub(super) struct Frame(pub(super) [&'static str; 3]);

impl Frame {
    /// A text, under a sum over it and what follows in the file.
    pub(super) fn around(&self, text: &str, follows: &[u8]) -> String {
        let ([before, between, after], sum) = (self.0, checksum_of([text.as_bytes(), follows]));
        format!("{before}{sum}{between}{text}{after}")
    }

    /// The text of one, if its sum is right.
    pub(super) fn text<'a>(&self, whole: &'a [u8], follows: &[u8]) -> Option<&'a [u8]> {
        let [before, between, after] = self.0.map(str::as_bytes);
        let (sum, rest) = whole.strip_prefix(before)?.split_at_checked(LENGTH)?;
        let text = rest.strip_prefix(between)?.strip_suffix(after)?;
        (checksum_of([text, follows]).as_bytes() == sum).then_some(text)
    }
}
