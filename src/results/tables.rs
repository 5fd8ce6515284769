//! The tables that are made from journal and study alone: whether they agree with these.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;

use super::derived::Derived;
use super::earlier::Earlier;
use super::error::SweepError;
use super::making::{Making, Wish};
use super::manifest::{Manifest, SessionInfo};
use super::record::CaseRecord;
use super::{energy, probe_columns, summary};
use crate::disk::names::{ENERGY, PROBE_COLUMNS, SUMMARY};
use crate::study::Study;

/// A table that is made from journal and study alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Table {
    Summary,
    Energy,
    ProbeColumns,
}

/// Makes all tables of a sweep. A report may be about to make the same ones. False where the wait
/// for it was given up.
pub(super) fn write(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
    gives_up: Wish<'_>,
) -> Result<bool, SweepError> {
    let Some(_making) = Making::hold_unless(directory, || {}, gives_up) else { return Ok(false) };
    let cases = &records[..study.cases.len().min(records.len())];
    summary::write(directory, study, records)?;
    energy::write(directory, cases)?;
    probe_columns::write(directory, study, cases)?;
    Ok(true)
}

/// Makes the tables again that differ from the journal; returns their names. If the journal lacks
/// cases, and the summary has more rows than it, all tables stay. The sweep's next run makes them
/// agree.
pub fn renew_tables(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<Vec<&'static str>, SweepError> {
    let mut renewed = Vec::new();
    let cases = &records[..study.cases.len()];
    let known = cases.iter().flatten().count();
    if known < cases.len() && rows(directory) > known {
        return Ok(renewed);
    }
    for table in Table::ALL {
        if table.fit(directory, study, records)? != Fit::Right {
            match table {
                Table::Summary => summary::write(directory, study, records)?,
                Table::Energy => energy::write(directory, cases)?,
                Table::ProbeColumns => probe_columns::write(directory, study, cases)?,
            }
            renewed.push(table.name());
        }
    }
    Ok(renewed)
}

/// Rows of `summary.csv`, damaged or not.
fn rows(directory: &Path) -> usize {
    let Ok(file) = File::open(directory.join(SUMMARY)) else { return 0 };
    let (mut file, mut breaks) = (BufReader::with_capacity(BUFFER, file), 0_usize);
    while let Ok(bytes @ [_, ..]) = file.fill_buf() {
        breaks += bytes.iter().filter(|&&byte| byte == b'\n').count();
        let read = bytes.len();
        file.consume(read);
    }
    breaks.saturating_sub(1)
}

/// How a table agrees with the journal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fit {
    Right,
    /// It is right as far as it goes, and the last sweep ended before it made the table again.
    Older,
    /// It is not, in words.
    Wrong(&'static str),
}

impl Table {
    pub(super) const ALL: [Table; 3] = [Table::Summary, Table::Energy, Table::ProbeColumns];

    pub(super) fn name(self) -> &'static str {
        match self {
            Table::Summary => SUMMARY,
            Table::Energy => ENERGY,
            Table::ProbeColumns => PROBE_COLUMNS,
        }
    }

    /// How it agrees with the journal.
    pub(super) fn fit(
        self,
        directory: &Path,
        study: &Study,
        records: &[Option<CaseRecord>],
    ) -> Result<Fit, SweepError> {
        let path = directory.join(self.name());
        let cases = &records[..study.cases.len()];
        let right = |right, what| Ok(if right { Fit::Right } else { Fit::Wrong(what) });
        if path.is_dir() {
            return Ok(Fit::Wrong("is a directory"));
        }
        if self == Table::ProbeColumns {
            return right(probe_columns::fits(directory, study, cases), "is damaged or missing");
        }
        let wrong = "is not what the journal says";
        let was_killed = || {
            let sessions = Manifest::read(directory).map(|manifest| manifest.sessions);
            let killed = |all: Vec<SessionInfo>| all.last().is_some_and(|one| one.ended.is_none());
            sessions.is_some_and(killed) || Derived::is_owed(directory)
        };
        if !path.exists() {
            // Otherwise the sweep has not come so far.
            let is_early = cases.iter().any(Option::is_none);
            return if !is_early && was_killed() { Ok(Fit::Older) } else { right(is_early, wrong) };
        }
        let open = || {
            let file = File::open(&path).map_err(SweepError::io(&path))?;
            Ok::<_, SweepError>(BufReader::with_capacity(BUFFER, file))
        };
        let mut comparison = Comparison { there: open()?, same: true };
        self.write(&mut comparison, study, records).map_err(SweepError::io(&path))?;
        let rest = comparison.there.fill_buf().map_err(SweepError::io(&path))?;
        if rest.is_empty() && comparison.same {
            return Ok(Fit::Right);
        }
        let is_earlier = || {
            let mut earlier = Earlier::new(open()?);
            self.write(&mut earlier, study, records).map_err(SweepError::io(&path))?;
            Ok::<_, SweepError>(earlier.is_found())
        };
        Ok(if was_killed() && is_earlier()? { Fit::Older } else { Fit::Wrong(wrong) })
    }

    /// Writes what it should be.
    fn write(
        self,
        into: impl Write,
        study: &Study,
        records: &[Option<CaseRecord>],
    ) -> std::io::Result<()> {
        match self {
            Table::Summary => summary::write_table(into, study, records).map_err(Into::into),
            Table::Energy => energy::write_table(into, &records[..study.cases.len()]),
            Table::ProbeColumns => Ok(()),
        }
    }
}

/// Bytes read at once.
const BUFFER: usize = 1 << 20;

/// Takes the expected contents of a file, and compares them with the file.
struct Comparison {
    there: BufReader<File>,
    same: bool,
}

impl Write for Comparison {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.same {
            let mut there = Vec::with_capacity(bytes.len());
            (&mut self.there).take(bytes.len() as u64).read_to_end(&mut there)?;
            self.same = there == bytes;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
