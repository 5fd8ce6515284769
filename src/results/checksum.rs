//! Short sums that tell damage.

use sha2::{Digest, Sha256};

/// The start of SHA-256 over some bytes, 16 hex digits.
pub(super) fn checksum(bytes: &[u8]) -> String {
    Sha256::digest(bytes)[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}
