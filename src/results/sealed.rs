//! JSON files that contain their own checksum, so that a flipped bit shows.
//!
//! The first line of such an object is `"sum"`, the start of SHA-256 over all lines below it.

use std::fs;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::atomic_file;
use super::checksum::Frame;
use super::error::SweepError;

/// That of an object's fields.
const FRAME: Frame = Frame(["{\n  \"sum\": \"", "\",\n", ""]);

/// Writes an object with fields, under its sum.
pub(super) fn write(path: &Path, object: &impl Serialize) -> Result<(), SweepError> {
    atomic_file::write(path, sealed(object).as_bytes())
}

/// Reads one; `None` if it is missing or has changed.
pub(super) fn read<T: DeserializeOwned>(path: &Path) -> Option<T> {
    let text = fs::read(path).ok().filter(|text| is_whole(text))?;
    serde_json::from_slice(&text).ok()
}

/// The text of an object with fields, under its sum.
fn sealed(object: &impl Serialize) -> String {
    let text = serde_json::to_string_pretty(object).expect("plain data has a JSON form");
    let fields = text.strip_prefix("{\n").expect("an object with fields has a line each");
    FRAME.around(&format!("{fields}\n"), b"")
}

/// Whether a text is as [`sealed`] made it.
pub(super) fn is_whole(text: &[u8]) -> bool {
    FRAME.text(text, b"").is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_flipped_bit_and_any_cut_shows() {
        let text = sealed(&serde_json::json!({ "a": 1, "b": { "c": "d" } }));
        let read: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["b"]["c"], "d");
        assert!(is_whole(text.as_bytes()));
        for place in 0..text.len() {
            for bit in 0..8 {
                let mut flipped = text.clone().into_bytes();
                flipped[place] ^= 1 << bit;
                assert!(!is_whole(&flipped), "bit {bit} of byte {place}");
            }
            assert!(!is_whole(&text.as_bytes()[..place]), "cut at {place}");
        }
    }
}
