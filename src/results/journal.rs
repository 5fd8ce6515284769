//! The journal: the truth about a sweep, one line of JSON per finished case.
//!
//! The first line is the [`Header`]. Lines are only ever appended. A torn last line (the process or
//! the machine died) is cut off on reopening. A damaged line costs its case alone: the line is set
//! aside, and the case runs again. Lines reach the disk in groups: within 0.2 s, or as soon as nothing
//! else happens.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::entries::{self, Content, Entry, Header};
use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, disk};

pub(super) const FILE_NAME: &str = "journal.jsonl";
/// Where damaged lines go.
const DAMAGED: &str = "journal.damaged";

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
        let file = disk::create(&path).map_err(SweepError::io(&path))?;
        let mut journal = Journal { path, file, unsynced_since: None };
        journal.append(&Entry::<CaseRecord>::Header(header.clone()))?;
        journal.sync()?;
        atomic_file::sync(directory)?;
        Ok(journal)
    }

    /// Opens a journal, which holds `content`, to go on with it. A torn tail is cut off, damaged lines are
    /// set aside. Where the first line is lost, `header` takes its place.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn resume(
        directory: &Path,
        content: &Content<impl Sized>,
        header: &Header,
    ) -> Result<Journal, SweepError> {
        let path = directory.join(FILE_NAME);
        if !content.intact {
            let text = std::fs::read(&path).map_err(SweepError::io(&path))?;
            let [whole, damaged] = entries::sorted(&text);
            keep_damaged(directory, &damaged)?;
            let header = || Entry::<CaseRecord>::Header(header.clone()).line();
            let first = content.header.is_none().then(header);
            let text = [first.unwrap_or_default().as_bytes(), &whole].concat();
            atomic_file::write(&path, &text)?;
        }
        let file = disk::append(&path).map_err(SweepError::io(&path))?;
        Ok(Journal { path, file, unsynced_since: None })
    }

    /// Appends a finished case.
    pub fn record(&mut self, record: &CaseRecord) -> Result<(), SweepError> {
        self.append(&Entry::Case(Box::new(record)))
    }

    fn append(&mut self, entry: &Entry<impl Serialize>) -> Result<(), SweepError> {
        disk::write(&self.file, entry.line().as_bytes()).map_err(SweepError::io(&self.path))?;
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
            disk::sync_data(&self.file).map_err(SweepError::io(&self.path))?;
            self.unsynced_since = None;
        }
        Ok(())
    }

    /// Leaves it to somebody else to put the lines so far on the disk.
    pub(super) fn let_sync(&mut self) -> Result<Journal, SweepError> {
        let file = self.file.try_clone().map_err(SweepError::io(&self.path))?;
        Ok(Journal { path: self.path.clone(), file, unsynced_since: self.unsynced_since.take() })
    }

    /// Makes sure that the file which is written to is still the one that has its name.
    ///
    /// # Errors
    /// Somebody has deleted or moved it, or the directory with it.
    pub fn demand_in_place(&self) -> Result<(), SweepError> {
        if atomic_file::is_same(&self.file, &self.path) {
            return Ok(());
        }
        let reason = "was deleted, moved or replaced while the sweep ran; what finished since then \
                      is lost";
        Err(SweepError::Executor(format!("{}: {reason}", self.path.display())))
    }
}

/// Adds lines to those that were set aside earlier.
fn keep_damaged(directory: &Path, lines: &[u8]) -> Result<(), SweepError> {
    if lines.is_empty() {
        return Ok(());
    }
    let path = directory.join(DAMAGED);
    let file = disk::append(&path);
    file.and_then(|file| disk::write(&file, lines)).map_err(SweepError::io(&path))
}

/// The header alone; `None` where its line is not whole.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn read_header(directory: &Path) -> Result<Option<Header>, SweepError> {
    let path = directory.join(FILE_NAME);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    let mut line = Vec::new();
    BufReader::new(file).read_until(b'\n', &mut line).map_err(SweepError::io(&path))?;
    Ok(entries::parse::<CaseRecord>(&path, &line[..])?.header)
}

/// Reads a journal without touching it, and hands on its records block by block. `R` has what is wanted of each
/// record. Of a large study the rest takes time and memory.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn read_in_blocks<R: DeserializeOwned + Send>(
    directory: &Path,
    take: impl FnMut(Vec<R>),
) -> Result<Content<R>, SweepError> {
    let path = directory.join(FILE_NAME);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    entries::parse_in_blocks(&path, BufReader::new(file), take)
}

/// Reads a journal without touching it.
///
/// # Errors
/// A file that cannot be read, or another program's.
pub fn read_journal(directory: &Path) -> Result<Content, SweepError> {
    let path = directory.join(FILE_NAME);
    let file = File::open(&path).map_err(SweepError::io(&path))?;
    entries::parse(&path, BufReader::new(file))
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::math::simd::SimdPath;
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

    fn resume(directory: &Path, header: &Header) -> (Journal, Vec<CaseRecord>) {
        let content = read_journal(directory).unwrap();
        (Journal::resume(directory, &content, header).unwrap(), content.records)
    }

    #[test]
    fn a_journal_round_trips_every_bit() {
        let directory = tempfile::tempdir().unwrap();
        let (header, records) = filled(directory.path());
        let content = read_journal(directory.path()).unwrap();
        assert_eq!((content.header, content.records), (Some(header), records));
    }

    #[test]
    fn a_torn_tail_is_cut_wherever_it_tore() {
        let directory = tempfile::tempdir().unwrap();
        let (header, records) = filled(directory.path());
        let path = directory.path().join(FILE_NAME);
        let bytes = std::fs::read(&path).unwrap();
        let ends: Vec<_> = (1..=bytes.len()).filter(|&end| bytes[end - 1] == b'\n').collect();
        let near_an_end = |length: &usize| ends.iter().any(|end| end.abs_diff(*length) <= 2);
        for length in (0..bytes.len()).filter(|length| length % 97 == 0 || near_an_end(length)) {
            std::fs::write(&path, &bytes[..length]).unwrap();
            let whole = ends.iter().filter(|&&end| end <= length).count();
            let (mut journal, read) = resume(directory.path(), &header);
            assert_eq!(read, records[..whole.saturating_sub(1)]);
            journal.record(&records[0]).unwrap();
            let again = read_journal(directory.path()).unwrap();
            assert_eq!((again.records.len(), again.damaged), (whole.max(1), 0));
        }
    }

    #[test]
    fn a_flipped_bit_costs_its_record_alone() {
        let directory = tempfile::tempdir().unwrap();
        let (header, records) = filled(directory.path());
        let path = directory.path().join(FILE_NAME);
        let bytes = std::fs::read(&path).unwrap();
        let breaks: Vec<_> = (0..bytes.len()).filter(|&at| bytes[at] == b'\n').collect();
        let near_a_break = |at: &usize| breaks.iter().any(|other| other.abs_diff(*at) <= 1);
        let places = (0..bytes.len()).filter(|at| at % 101 == 0 || near_a_break(at));
        for (at, bit) in places.flat_map(|at| (0..8).map(move |bit| (at, bit))) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            std::fs::write(&path, &damaged).unwrap();
            let (_, read) = resume(directory.path(), &header);
            let lost = breaks.iter().filter(|&&end| end < at).count();
            let kept = |number: usize| {
                let record = &records[number];
                read.contains(record) || (lost == number + 1 && !breaks.contains(&at))
            };
            assert!((0..records.len()).all(kept), "byte {at}, bit {bit}");
            let again = read_journal(directory.path()).unwrap();
            assert_eq!((again.header.as_ref(), again.records), (Some(&header), read));
        }
    }

    #[test]
    fn a_whole_line_of_another_version_is_never_cut_off() {
        let directory = tempfile::tempdir().unwrap();
        filled(directory.path());
        let path = directory.path().join(FILE_NAME);
        let mut bytes = std::fs::read(&path).unwrap();
        let entry = br#"{"tide":{"level_m":0.2}}"#;
        let sum = super::super::checksum::checksum(entry);
        bytes.extend(format!("{{\"sum\":\"{sum}\",\"entry\":").into_bytes());
        bytes.extend(entry);
        bytes.extend(b"}\n");
        std::fs::write(&path, &bytes).unwrap();
        let error = read_journal(directory.path()).unwrap_err();
        assert!(error.is_refusal());
        assert!(error.to_string().contains("line 5: is whole, but written by another"), "{error}");
        assert_eq!(std::fs::read(&path).unwrap(), bytes);
    }

    #[test]
    fn a_journal_that_is_moved_is_missed() {
        let directory = tempfile::tempdir().unwrap();
        let (header, _) = filled(directory.path());
        let (journal, _) = resume(directory.path(), &header);
        journal.demand_in_place().unwrap();
        let path = directory.path().join(FILE_NAME);
        std::fs::rename(&path, directory.path().join("elsewhere")).unwrap();
        assert!(journal.demand_in_place().is_err());
        std::fs::copy(directory.path().join("elsewhere"), &path).unwrap();
        assert!(journal.demand_in_place().is_err());
    }
}
