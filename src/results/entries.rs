//! Lines of the journal: how one is written, and what a text of them holds.
//!
//! Every line is `{"sum":"<16 hex digits>","entry":<entry>}`, the sum being the start of SHA-256
//! over the entry's text.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::checksum::checksum;
use super::error::SweepError;
use super::record::CaseRecord;
use crate::math::simd::SimdPath;

const VERSION: u32 = 1;

/// What the journal belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Version of the journal's own format.
    pub version: u32,
    /// Name of the study.
    pub name: String,
    /// Identity of the study.
    pub sweep: String,
    /// Number of its cases.
    pub cases: usize,
    /// The instruction set that all its cases are computed with.
    pub simd: SimdPath,
}

impl Header {
    /// A header in the present format.
    pub fn new(name: &str, sweep: &str, cases: usize, simd: SimdPath) -> Header {
        Header { version: VERSION, name: name.to_owned(), sweep: sweep.to_owned(), cases, simd }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Entry {
    Header(Header),
    Case(Box<CaseRecord>),
}

impl Entry {
    /// Its line.
    pub(super) fn line(&self) -> String {
        let entry = serde_json::to_string(self).expect("an entry has a JSON form");
        format!("{{\"sum\":\"{}\",\"entry\":{entry}}}\n", checksum(entry.as_bytes()))
    }
}

/// What a journal holds.
#[derive(Debug, Default)]
pub struct Content {
    /// The first line, where it is whole.
    pub header: Option<Header>,
    /// Records in the order of writing.
    pub records: Vec<CaseRecord>,
    /// How many lines are damaged.
    pub damaged: usize,
    /// Whether nothing is torn or damaged.
    pub(super) intact: bool,
    /// The text of whole lines, and that of damaged ones.
    pub(super) texts: [Vec<u8>; 2],
}

/// Reads a journal's text. `path` is told in errors. A last line that was never written to its end
/// counts for nothing.
///
/// # Errors
/// A whole line that this program does not know, or one that is out of place.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Content, SweepError> {
    let mut content = Content::default();
    for (at, line) in bytes.split_inclusive(|&byte| byte == b'\n').enumerate() {
        for piece in pieces(line) {
            let refused =
                |reason: &str| SweepError::refused(path, format_args!("line {}: {reason}", at + 1));
            let Some(entry) = whole_entry(piece) else {
                if line.ends_with(b"\n") {
                    content.damaged += 1;
                    content.texts[1].extend_from_slice(line);
                }
                continue;
            };
            content.texts[0].extend_from_slice(&piece[..piece.len() - 1]);
            content.texts[0].push(b'\n');
            let entry = serde_json::from_slice(entry).map_err(|error| {
                refused(&format!("is whole, but written by another version: {error}"))
            })?;
            match entry {
                Entry::Header(header) if header.version != VERSION => {
                    let theirs = header.version;
                    let reason =
                        format!("journal format {theirs} is not this program's, {VERSION}");
                    return Err(refused(&reason));
                }
                Entry::Header(header) if at == 0 => content.header = Some(header),
                Entry::Header(_) => return Err(refused("a header out of place")),
                Entry::Case(record) => content.records.push(*record),
            }
        }
    }
    content.intact = content.texts[0] == bytes && content.header.is_some();
    Ok(content)
}

const PREFIX: &[u8] = b"{\"sum\":\"";
const MIDDLE: &[u8] = b"\",\"entry\":";

/// What a line holds: mostly itself, or two lines whose break is damaged.
fn pieces(line: &[u8]) -> Vec<&[u8]> {
    let starts = line.windows(PREFIX.len()).enumerate().skip(1);
    let starts = starts.filter(|(_, window)| *window == PREFIX).map(|(at, _)| at);
    let mut ends: Vec<usize> = starts.chain([line.len()]).collect();
    ends.insert(0, 0);
    ends.windows(2).map(|pair| &line[pair[0]..pair[1]]).collect()
}

/// The text of a line's entry, where its sum is right. Whatever byte breaks the line, nothing is lost.
fn whole_entry(line: &[u8]) -> Option<&[u8]> {
    let (_break, line) = line.split_last()?;
    let rest = line.strip_suffix(b"}")?.strip_prefix(PREFIX)?;
    let (sum, rest) = rest.split_at_checked(16)?;
    let entry = rest.strip_prefix(MIDDLE)?;
    (checksum(entry).as_bytes() == sum).then_some(entry)
}
