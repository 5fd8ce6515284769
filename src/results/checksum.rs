//! Short sums that tell damage.

use sha2::{Digest, Sha256};

/// The start of SHA-256 over some bytes, 16 hex digits.
pub(super) fn checksum(bytes: &[u8]) -> String {
    checksum_of([bytes])
}

/// The same over pieces, one behind the other.
pub(crate) fn checksum_of<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> String {
    let mut hash = Sha256::new();
    pieces.into_iter().for_each(|piece| hash.update(piece));
    let start = hash.finalize()[..8].try_into().expect("a digest has 32 bytes");
    format!("{:016x}", u64::from_be_bytes(start))
}
