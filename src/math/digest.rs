//! The start of SHA-256, which identifies files and studies.

use sha2::{Digest, Sha256};

/// Its first 16 hex digits.
pub fn digits(hash: Sha256) -> String {
    let start = hash.finalize()[..8].try_into().expect("a digest has 32 bytes");
    format!("{:016x}", u64::from_be_bytes(start))
}
