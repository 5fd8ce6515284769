//! Checks whether the contents of a directory are unchanged.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use super::entries::Condition;
use super::error::SweepError;
use super::filling::{self, Filling};
use super::manifest::Manifest;
use super::record::{CaseRecord, HeldLine};
use super::{checkpoints, derived, energy, journal, opening, probe_columns, summary};
use crate::keys::named;
use crate::study::Study;

/// The result of a check of a whole directory.
#[derive(Debug)]
pub struct Verified {
    /// Everything that has changed, in words.
    pub told: Vec<String>,
    /// Files of cases that are damaged or missing.
    pub damaged: Vec<PathBuf>,
    /// The finished cases and companions, as in [`super::finished`].
    pub records: Vec<Option<CaseRecord>>,
}

/// Checks everything in a directory.
pub fn verify(directory: &Path, study: &Study) -> Result<Verified, SweepError> {
    let mut filling = Filling::<HeldLine>::new(directory, study);
    let content = journal::read_in_blocks(directory, |lines| filling.take(lines))?;
    let (records, damaged) = filling.all();
    let mut told: Vec<String> = opening::told_damage(&content, false).into_iter().collect();
    match &content.header {
        Some(header) if header.sweep != study.identity => {
            told.push(format!("journal.jsonl is of another sweep (\"{}\")", header.name));
        }
        None if told.is_empty() => told.push("journal.jsonl has lost its beginning".to_owned()),
        _ if told.is_empty() && content.condition != Condition::Intact => {
            told.push("journal.jsonl: its last line does not end".to_owned());
        }
        _ => {}
    }
    told.extend(damaged.iter().map(filling::told));
    let damaged = damaged.into_iter().map(|(path, _)| path).collect();
    let kept = checkpoints::damaged(directory);
    told.extend(kept.map(|path| format!("{} is damaged: what it is of starts over", named(&path))));
    for table in Table::ALL {
        if !table.fits(directory, study, &records)? {
            let is_file = !directory.join(table.name()).is_dir();
            let what = if is_file { table.told() } else { "is a directory" };
            told.push(format!("{} {what}", table.name()));
        }
    }
    told.extend(Manifest::damage(directory).map(|what| format!("manifest.json {what}")));
    told.extend(derived::damage(directory));
    Ok(Verified { told, damaged, records })
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
        if !table.fits(directory, study, records)? {
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

/// A table that is made from journal and study alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Table {
    Summary,
    Energy,
    ProbeColumns,
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

impl Table {
    const ALL: [Table; 3] = [Table::Summary, Table::Energy, Table::ProbeColumns];

    fn name(self) -> &'static str {
        match self {
            Table::Summary => SUMMARY,
            Table::Energy => energy::FILE_NAME,
            Table::ProbeColumns => probe_columns::FILE_NAME,
        }
    }

    /// The fault of one that does not fit.
    fn told(self) -> &'static str {
        match self {
            Table::Summary | Table::Energy => "is not what the journal says",
            Table::ProbeColumns => "is damaged or missing",
        }
    }

    /// Whether it agrees with the journal.
    fn fits(
        self,
        directory: &Path,
        study: &Study,
        records: &[Option<CaseRecord>],
    ) -> Result<bool, SweepError> {
        let path = directory.join(self.name());
        let cases = &records[..study.cases.len()];
        if self == Table::ProbeColumns {
            return Ok(probe_columns::fits(directory, study, cases));
        }
        if path.is_dir() {
            return Ok(false);
        }
        if !path.exists() {
            // Otherwise the sweep has not come so far.
            return Ok(cases.iter().any(Option::is_none));
        }
        let there = File::open(&path).map_err(SweepError::io(&path))?;
        let there = BufReader::with_capacity(BUFFER, there);
        let mut comparison = Comparison { there, same: true };
        let written = match self {
            Table::Summary => {
                summary::write_table(&mut comparison, study, records).map_err(Into::into)
            }
            Table::Energy => energy::write_table(&mut comparison, cases),
            Table::ProbeColumns => Ok(()),
        };
        written.map_err(SweepError::io(&path))?;
        let rest = comparison.there.fill_buf().map_err(SweepError::io(&path))?;
        Ok(rest.is_empty() && comparison.same)
    }
}

const SUMMARY: &str = "summary.csv";
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

#[cfg(test)]
mod tests {
    use super::super::{finished, trial};
    use super::*;

    #[test]
    fn a_flipped_bit_is_told_wherever_it_is() {
        let root = tempfile::tempdir().unwrap();
        let (path, study) = (root.path().join("run"), trial::study("0.2, 0.3"));
        drop(trial::finished(&path, &study));
        Manifest::new(&path, &study, &[], trial::SIMD).write(&path).unwrap();
        let told = || verify(&path, &study).unwrap().told;
        assert_eq!(told(), Vec::<String>::new());
        let history = std::fs::read_dir(path.join("histories")).unwrap().next().unwrap().unwrap();
        for (name, case_runs_again) in [
            (history.path(), true),
            (path.join("summary.csv"), false),
            (path.join("energy.csv"), false),
            (path.join("manifest.json"), false),
            (path.join("journal.jsonl"), true),
        ] {
            let before = std::fs::read(&name).unwrap();
            let mut damaged = before.clone();
            let place = damaged.len() * 3 / 4;
            damaged[place] ^= 4;
            std::fs::write(&name, damaged).unwrap();
            let found = told();
            assert!(!found.is_empty(), "{}", name.display());
            // A check repairs nothing.
            assert!(!found[0].contains("set aside"), "{found:?}");
            let directory = trial::open(&path, &study);
            assert_eq!(directory.runs().iter().flatten().count() == 1, case_runs_again);
            assert_eq!(!directory.findings().is_empty(), case_runs_again);
            drop(directory);
            std::fs::write(&name, before).unwrap();
        }
        std::fs::write(path.join("manifest.json"), "").unwrap();
        assert_eq!(told(), ["manifest.json is damaged"]);
        for table in [Table::Summary, Table::Energy] {
            std::fs::write(path.join(table.name()), "x").unwrap();
        }
        let records = finished(&path, &study).unwrap();
        assert_eq!(renew_tables(&path, &study, &records).unwrap(), ["summary.csv", "energy.csv"]);
        assert!(renew_tables(&path, &study, &records).unwrap().is_empty());
        // An extra line is no case that the journal lacks.
        let line_too_many = std::fs::read_to_string(path.join("summary.csv")).unwrap() + "junk\n";
        std::fs::write(path.join("summary.csv"), line_too_many).unwrap();
        assert_eq!(renew_tables(&path, &study, &records).unwrap(), ["summary.csv"]);
        std::fs::write(path.join("journal.jsonl"), "").unwrap();
        assert_eq!(told()[0], "journal.jsonl has lost its beginning");
    }
}
