//! Lines of the journal: writing and reading.
//!
//! Every line is `{"sum":"<16 hex digits>","entry":<entry>}`. The sum is the start of SHA-256 over
//! the entry's text.

use std::io::{BufRead, Read};
use std::path::Path;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::checksum::Frame;
use super::error::SweepError;
use super::record::CaseRecord;
use super::wanted::{Wanted, wanted};
use crate::math::simd::SimdPath;

const VERSION: u32 = 1;

/// The study of a journal.
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
pub(super) enum Entry<R = CaseRecord> {
    Header(Header),
    Case(Box<R>),
}

impl<R: Serialize> Entry<R> {
    /// Its line.
    pub(super) fn line(&self) -> String {
        let entry = serde_json::to_string(self).expect("an entry has a JSON form");
        FRAME.around(&entry, b"") + "\n"
    }
}

/// The contents of a journal. `R` is the part of a record that is read.
#[derive(Debug)]
pub struct Content<R = CaseRecord> {
    /// The first line, if it is intact.
    pub header: Option<Header>,
    /// Records in the order of writing, unless they were passed on.
    pub records: Vec<R>,
    /// How many records there were.
    pub found: usize,
    /// How many lines are damaged.
    pub damaged: usize,
    pub(super) condition: Condition,
}

/// The condition of a journal's text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Condition {
    Intact,
    /// All lines are intact except the last one, which has no end. It begins after this many bytes.
    Torn(u64),
    Damaged,
}

/// Bytes read at once. Their lines are parsed in parallel.
const BLOCK: usize = 8 << 20;

/// The contents of a line: entries, and the number of invalid parts.
struct Line<R> {
    entries: Vec<Result<Entry<R>, String>>,
    damaged: usize,
    /// Whether it is a single entry.
    intact: bool,
    bytes: u64,
}

impl<R> Line<R> {
    /// The condition of a text that ends with this line, from its condition before.
    fn after(&self, before: Condition, end: &mut u64) -> Condition {
        let start = *end;
        *end += self.bytes;
        match before {
            Condition::Intact if self.intact => Condition::Intact,
            Condition::Intact if self.entries.is_empty() && self.damaged == 0 => {
                Condition::Torn(start)
            }
            _ => Condition::Damaged,
        }
    }
}

/// Reads a journal. `path` is for errors. A last line without an end is ignored. Errors are a file
/// that cannot be read, and an intact line that is unknown or in the wrong place.
pub(super) fn parse<R: Wanted>(
    path: &Path,
    text: impl BufRead + Send,
) -> Result<Content<R>, SweepError> {
    let mut records = Vec::new();
    let content = parse_in_blocks(path, text, |block| records.extend(block))?;
    Ok(Content { records, ..content })
}

/// The same without keeping the records: each block of them is passed on.
pub(super) fn parse_in_blocks<R: Wanted>(
    path: &Path,
    mut text: impl BufRead + Send,
    mut take: impl FnMut(Vec<R>),
) -> Result<Content<R>, SweepError> {
    let condition = Condition::Intact;
    let mut content =
        Content { header: None, records: Vec::new(), found: 0, damaged: 0, condition };
    let (mut number, mut end, mut block, mut next) = (0, 0, Vec::new(), Vec::new());
    next_lines(&mut text, &mut next).map_err(SweepError::io(path))?;
    while !next.is_empty() {
        std::mem::swap(&mut block, &mut next);
        // The next block is read while the lines of this one are parsed.
        let look = || lines_of(&block).into_par_iter().map(read).collect();
        let (lines, more): (Vec<_>, _) = rayon::join(look, || next_lines(&mut text, &mut next));
        more.map_err(SweepError::io(path))?;
        for line in lines {
            number += 1;
            content.damaged += line.damaged;
            content.condition = line.after(content.condition, &mut end);
            for entry in line.entries {
                content.take(number, entry).map_err(|reason| {
                    SweepError::refused(path, format_args!("line {number}: {reason}"))
                })?;
            }
        }
        content.found += content.records.len();
        take(std::mem::take(&mut content.records));
    }
    content.condition = content.header.as_ref().map_or(Condition::Damaged, |_| content.condition);
    Ok(content)
}

/// Reads the next lines, with their breaks, in place of those before.
fn next_lines(text: &mut impl BufRead, lines: &mut Vec<u8>) -> std::io::Result<()> {
    lines.clear();
    text.by_ref().take(BLOCK as u64).read_to_end(lines)?;
    if lines.last().is_some_and(|&last| last != b'\n') {
        text.read_until(b'\n', lines)?;
    }
    Ok(())
}

/// The lines of a text, with their breaks.
fn lines_of(mut text: &[u8]) -> Vec<&[u8]> {
    let mut lines = Vec::new();
    while !text.is_empty() {
        let whole = text;
        // Reading from memory cannot fail.
        let length = text.skip_until(b'\n').unwrap_or(whole.len());
        lines.push(&whole[..length]);
    }
    lines
}

fn read<R: Wanted>(line: &[u8]) -> Line<R> {
    let ended = line.ends_with(b"\n");
    let entry = |text: &[u8]| serde_json::from_slice(&wanted::<R>(text)).map_err(|e| e.to_string());
    let bytes = line.len() as u64;
    // This is nearly every line. Then no search for another one is needed.
    if let Some(text) = whole_entry(line) {
        return Line { entries: vec![entry(text)], damaged: 0, intact: ended, bytes };
    }
    let pieces = pieces(line);
    let whole: Vec<_> = pieces.iter().filter_map(|piece| whole_entry(piece)).collect();
    let lost = pieces.len() - whole.len();
    Line {
        damaged: if ended { lost } else { 0 },
        intact: ended && pieces.len() == 1 && lost == 0,
        entries: whole.into_iter().map(entry).collect(),
        bytes,
    }
}

impl<R> Content<R> {
    fn take(&mut self, line: usize, entry: Result<Entry<R>, String>) -> Result<(), String> {
        match entry {
            Err(error) => Err(format!("is whole, but written by another version: {error}")),
            Ok(Entry::Header(header)) if header.version != VERSION => {
                let theirs = header.version;
                Err(format!("journal format {theirs} is not this program's, {VERSION}"))
            }
            Ok(Entry::Header(header)) if line == 1 => {
                self.header = Some(header);
                Ok(())
            }
            Ok(Entry::Header(_)) => Err("a header out of place".to_owned()),
            Ok(Entry::Case(record)) => {
                self.records.push(*record);
                Ok(())
            }
        }
    }
}

/// The intact lines of a journal's text, and the damaged ones.
pub(super) fn sorted(bytes: &[u8]) -> [Vec<u8>; 2] {
    let [mut whole, mut damaged] = [Vec::new(), Vec::new()];
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        for piece in pieces(line) {
            if whole_entry(piece).is_some() {
                whole.extend_from_slice(&piece[..piece.len() - 1]);
                whole.push(b'\n');
            } else if line.ends_with(b"\n") {
                damaged.extend_from_slice(line);
            }
        }
    }
    [whole, damaged]
}

/// That of a line.
const FRAME: Frame = Frame(["{\"sum\":\"", "\",\"entry\":", "}"]);

/// The parts of a line: usually itself, or two lines whose break is damaged.
fn pieces(line: &[u8]) -> Vec<&[u8]> {
    let start = FRAME.0[0].as_bytes();
    let starts = line.windows(start.len()).enumerate().skip(1);
    let starts = starts.filter(|(_, window)| *window == start).map(|(at, _)| at);
    let mut ends: Vec<usize> = starts.chain([line.len()]).collect();
    ends.insert(0, 0);
    ends.windows(2).map(|pair| &line[pair[0]..pair[1]]).collect()
}

/// The text of a line's entry, if its sum is right. Any byte may break the line, and nothing is
/// lost.
fn whole_entry(line: &[u8]) -> Option<&[u8]> {
    let (_break, line) = line.split_last()?;
    FRAME.text(line, b"")
}
