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

/// Splits a text with a sum: the sum, which follows `before`, and the text after `between`.
pub(super) fn split<'a>(
    text: &'a [u8],
    [before, between]: [&str; 2],
) -> Option<(&'a [u8], &'a [u8])> {
    let (sum, rest) = text.strip_prefix(before.as_bytes())?.split_at_checked(LENGTH)?;
    Some((sum, rest.strip_prefix(between.as_bytes())?))
}
