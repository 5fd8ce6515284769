//! The journal: the truth about a sweep, one line of JSON per finished case.
//!
//! Every line is `{"sum":"<16 hex digits>","entry":<entry>}`, the sum being the start of SHA-256
//! over the entry's text. The first entry is the [`Header`]. Lines are only ever appended; a torn
//! last line (the process or the machine died) is cut off on reopening, damage anywhere before it
//! is an error. Lines reach the disk in groups: within 0.2 s, or as soon as nothing else happens.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::error::SweepError;
use super::record::CaseRecord;
use crate::math::simd::SimdPath;

pub(super) const FILE_NAME: &str = "journal.jsonl";
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
enum JournalEntry {
    Header(Header),
    Case(Box<CaseRecord>),
}

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    unsynced_since: Option<Instant>,
}

impl Journal {
    /// Starts a journal.
    pub fn create(directory: &Path, header: &Header) -> Result<Journal, SweepError> {
        let path = directory.join(FILE_NAME);
        let file = File::create(&path).map_err(SweepError::io(&path))?;
        let mut journal = Journal { path, file, unsynced_since: None };
        journal.append(&JournalEntry::Header(header.clone()))?;
        journal.sync()?;
        super::atomic_file::sync(directory)?;
        Ok(journal)
    }

    /// Opens a journal to go on with it, cutting a torn tail off. `None` where not even the
    /// header is whole.
    ///
    /// # Errors
    /// Damage before the tail, or a file that cannot be read or written.
    pub fn resume(
        directory: &Path,
    ) -> Result<Option<(Journal, Header, Vec<CaseRecord>)>, SweepError> {
        let path = directory.join(FILE_NAME);
        let bytes = std::fs::read(&path).map_err(SweepError::io(&path))?;
        let content = parse(&path, &bytes)?;
        let Some(header) = content.header else { return Ok(None) };
        let file = OpenOptions::new().append(true).open(&path).map_err(SweepError::io(&path))?;
        if content.whole < bytes.len() {
            file.set_len(content.whole as u64).map_err(SweepError::io(&path))?;
            file.sync_all().map_err(SweepError::io(&path))?;
        }
        Ok(Some((Journal { path, file, unsynced_since: None }, header, content.records)))
    }

    /// Appends a finished case.
    pub fn record(&mut self, record: &CaseRecord) -> Result<(), SweepError> {
        self.append(&JournalEntry::Case(Box::new(record.clone())))
    }

    fn append(&mut self, entry: &JournalEntry) -> Result<(), SweepError> {
        let entry = serde_json::to_string(entry).expect("an entry has a JSON form");
        let line = format!("{{\"sum\":\"{}\",\"entry\":{entry}}}\n", checksum(entry.as_bytes()));
        self.file.write_all(line.as_bytes()).map_err(SweepError::io(&self.path))?;
        self.unsynced_since.get_or_insert_with(Instant::now);
        Ok(())
    }

    /// Whether lines have waited for the disk so long.
    pub fn waits(&self, time: Duration) -> bool {
        self.unsynced_since.is_some_and(|since| since.elapsed() >= time)
    }

    /// Puts all lines on the disk.
    pub fn sync(&mut self) -> Result<(), SweepError> {
        if self.unsynced_since.is_some() {
            self.file.sync_data().map_err(SweepError::io(&self.path))?;
            self.unsynced_since = None;
        }
        Ok(())
    }
}

/// Reads a journal without touching it: header and records in the order of writing.
///
/// # Errors
/// Damage before the tail, or a file that cannot be read.
pub fn read_journal(directory: &Path) -> Result<Option<(Header, Vec<CaseRecord>)>, SweepError> {
    let path = directory.join(FILE_NAME);
    let bytes = std::fs::read(&path).map_err(SweepError::io(&path))?;
    let content = parse(&path, &bytes)?;
    Ok(content.header.map(|header| (header, content.records)))
}

#[derive(Default)]
struct Content {
    header: Option<Header>,
    records: Vec<CaseRecord>,
    /// Bytes that are whole lines.
    whole: usize,
}

fn parse(path: &Path, bytes: &[u8]) -> Result<Content, SweepError> {
    let mut content = Content::default();
    let mut lines = bytes.split_inclusive(|&byte| byte == b'\n').enumerate().peekable();
    while let Some((number, line)) = lines.next() {
        let last = lines.peek().is_none();
        let Some(entry) = read_line(line) else {
            if last {
                break;
            }
            return Err(SweepError::refused(
                path,
                format_args!(
                    "line {}: damaged, though lines follow it; restore the file from a copy, or start over with --fresh",
                    number + 1
                ),
            ));
        };
        match (entry, &content.header) {
            (JournalEntry::Header(header), None) if header.version == VERSION => {
                content.header = Some(header);
            }
            (JournalEntry::Header(header), None) => {
                let reason = format_args!(
                    "line 1: journal format {} is not the one this program writes ({VERSION})",
                    header.version
                );
                return Err(SweepError::refused(path, reason));
            }
            (JournalEntry::Case(record), Some(_)) => content.records.push(*record),
            _ => {
                let reason = format_args!("line {}: out of place", number + 1);
                return Err(SweepError::refused(path, reason));
            }
        }
        content.whole += line.len();
    }
    Ok(content)
}

const PREFIX: &[u8] = b"{\"sum\":\"";
const MIDDLE: &[u8] = b"\",\"entry\":";

fn read_line(line: &[u8]) -> Option<JournalEntry> {
    let rest = line.strip_suffix(b"}\n")?.strip_prefix(PREFIX)?;
    let (sum, rest) = rest.split_at_checked(16)?;
    let entry = rest.strip_prefix(MIDDLE)?;
    if checksum(entry).as_bytes() != sum {
        return None;
    }
    serde_json::from_slice(entry).ok()
}

fn checksum(entry: &[u8]) -> String {
    Sha256::digest(entry)[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::study::{Study, SweepFile};

    fn filled(directory: &Path) -> (Header, Vec<CaseRecord>) {
        let text = "name = \"a\"\n[grid]\nwave_height_ratio = [0.1, 0.2, 0.3]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let header = Header::new("a", &study.identity, 3, SimdPath::Portable);
        let mut journal = Journal::create(directory, &header).unwrap();
        let mut records = Vec::new();
        for case in &study.cases {
            let result = made_up(&case.config);
            let record = CaseRecord::new(&study, case, &Ok(result), 0.1 + 0.2, "here");
            journal.record(&record).unwrap();
            records.push(record);
        }
        assert!(journal.waits(Duration::ZERO));
        journal.sync().unwrap();
        (header, records)
    }

    #[test]
    fn a_journal_round_trips_every_bit() {
        let directory = tempfile::tempdir().unwrap();
        let (header, records) = filled(directory.path());
        let (_, read_header, read) = Journal::resume(directory.path()).unwrap().unwrap();
        assert_eq!((read_header, read), (header, records));
    }

    #[test]
    fn a_torn_tail_is_cut_wherever_it_tore() {
        let directory = tempfile::tempdir().unwrap();
        let (_, records) = filled(directory.path());
        let path = directory.path().join(FILE_NAME);
        let bytes = std::fs::read(&path).unwrap();
        let ends: Vec<_> = (1..=bytes.len()).filter(|&end| bytes[end - 1] == b'\n').collect();
        let near_an_end = |length: &usize| ends.iter().any(|end| end.abs_diff(*length) <= 2);
        for length in (0..bytes.len()).filter(|length| length % 97 == 0 || near_an_end(length)) {
            std::fs::write(&path, &bytes[..length]).unwrap();
            let whole = ends.iter().filter(|&&end| end <= length).count();
            let resumed = Journal::resume(directory.path()).unwrap();
            match resumed {
                None => assert_eq!(whole, 0),
                Some((mut journal, _, read)) => {
                    assert_eq!(read, records[..whole - 1]);
                    journal.record(&records[0]).unwrap();
                    let (_, again) = read_journal(directory.path()).unwrap().unwrap();
                    assert_eq!(again.len(), whole);
                }
            }
        }
    }

    #[test]
    fn damage_in_the_middle_is_told_with_its_line() {
        let directory = tempfile::tempdir().unwrap();
        filled(directory.path());
        let path = directory.path().join(FILE_NAME);
        let mut bytes = std::fs::read(&path).unwrap();
        let line_two = bytes.iter().position(|&byte| byte == b'\n').unwrap() + 200;
        bytes[line_two] ^= 1;
        std::fs::write(&path, &bytes).unwrap();
        let error = Journal::resume(directory.path()).unwrap_err();
        assert!(error.is_refusal());
        assert!(error.to_string().contains("journal.jsonl: line 2: damaged"), "{error}");
    }
}
