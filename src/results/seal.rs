//! What a file was when it was written, so that damage shows.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::checksum::checksum;

/// What a file was when it was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Seal {
    /// Its length, bytes, and the start of its SHA-256.
    Whole {
        /// Length.
        bytes: u64,
        /// 16 hex digits.
        sum: String,
    },
    /// Its length alone, as earlier versions wrote it.
    Length(u64),
}

impl Seal {
    /// That of a content.
    pub(super) fn of(content: &[u8]) -> Seal {
        Seal::Whole { bytes: content.len() as u64, sum: checksum(content) }
    }

    /// Whether this is the content that was written.
    pub(super) fn fits(&self, content: &[u8]) -> bool {
        match self {
            Seal::Length(bytes) => *bytes == content.len() as u64,
            whole => *whole == Seal::of(content),
        }
    }
}

/// Seals of a case's files by their folders.
pub(super) type Seals = BTreeMap<String, Seal>;
