//! The output directory: whose it is, who may write, and what it already holds.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::error::SweepError;
use super::files::{self, Unsynced};
use super::journal::{self, Header, Journal};
use super::lock::{self, Lock};
use super::number::counted;
use super::record::CaseRecord;
use super::{energy, summary};
use crate::math::name::name_of;
use crate::math::simd::SimdPath;
use crate::simulation::CaseResult;
use crate::study::Study;

/// Lines and files are on the disk after this time at most.
const GROUP: Duration = Duration::from_millis(200);

/// What to do with a directory that holds something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpenMode {
    /// Go on with this sweep's results.
    Resume,
    /// Move them aside and start over.
    Fresh,
}

/// What was found on opening.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Opened {
    /// Nothing: a new sweep starts.
    New,
    /// Nothing any more: an old directory was moved here.
    Moved(PathBuf),
    /// So many finished cases of this sweep.
    Resumed(usize),
}

/// An output directory, locked.
#[derive(Debug)]
pub struct Directory {
    path: PathBuf,
    _lock: Lock,
    journal: Journal,
    unsynced: Unsynced,
    simd: SimdPath,
    records: Vec<Option<CaseRecord>>,
    /// Records before this are cases, the others companions.
    cases: usize,
}

impl Directory {
    /// Opens the directory for a study. `requested` is the user's choice of instruction set,
    /// `widest` the widest that every rank has.
    ///
    /// # Errors
    /// Another sweep's or somebody else's directory, a damaged journal, a held lock, an
    /// instruction set that cannot be honoured, a file that cannot be written.
    pub fn open(
        path: &Path,
        study: &Study,
        mode: OpenMode,
        requested: Option<SimdPath>,
        widest: SimdPath,
    ) -> Result<(Directory, Opened), SweepError> {
        if let Some(simd) = requested.filter(|&simd| simd > widest) {
            let (simd, widest) = (name_of(simd), name_of(widest));
            let reason = format!("--simd {simd}: not every rank has it; the widest is {widest}");
            return Err(SweepError::Refused(reason));
        }
        let found = holds_journal(path)?;
        if mode == OpenMode::Resume
            && found
            && let Some((header, _)) = journal::read_journal(path)?
        {
            check_header(path, &header, study, requested, widest)?;
        }
        fs::create_dir_all(path).map_err(|error| SweepError::unusable(path, &error))?;
        let mut lock = Lock::hold(path)?;
        let mut opened = Opened::New;
        if mode == OpenMode::Fresh && found {
            let aside = move_aside(path)?;
            fs::create_dir_all(path).map_err(SweepError::io(path))?;
            lock = Lock::hold(path)?;
            opened = Opened::Moved(aside);
        }
        let mut records = vec![None; study.run_count()];
        let resumed = if holds_journal(path)? { Journal::resume(path)? } else { None };
        let (journal, simd) = if let Some((journal, header, lines)) = resumed {
            check_header(path, &header, study, requested, widest)?;
            files::clean(path)?;
            fill(path, study, &mut records, lines);
            opened = Opened::Resumed(records.iter().flatten().count());
            (journal, header.simd)
        } else {
            let simd = requested.unwrap_or(widest);
            let header = Header::new(&study.name, &study.identity, study.cases.len(), simd);
            (Journal::create(path, &header)?, simd)
        };
        let (path, cases, unsynced) = (path.to_owned(), study.cases.len(), Unsynced::default());
        let directory = Directory { path, _lock: lock, journal, unsynced, simd, records, cases };
        Ok((directory, opened))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The instruction set that all cases here are computed with.
    pub fn simd(&self) -> SimdPath {
        self.simd
    }

    /// The finished cases, in grid order.
    pub fn records(&self) -> &[Option<CaseRecord>] {
        &self.records[..self.cases]
    }

    /// The finished cases and companions, in the order of [`Study::runs`].
    pub fn runs(&self) -> &[Option<CaseRecord>] {
        &self.records
    }

    /// Forgets failed cases, so that they run again.
    pub fn retry_failed(&mut self) {
        for record in &mut self.records {
            if record.as_ref().is_some_and(|record| !record.is_ok()) {
                *record = None;
            }
        }
    }

    /// Records a finished case: its files first, its journal line after.
    pub fn record(
        &mut self,
        mut record: CaseRecord,
        result: Option<&CaseResult>,
    ) -> Result<(), SweepError> {
        if let Some(result) = result.filter(|_| record.is_ok() && record.index < self.cases) {
            record.files = self.unsynced.write(&self.path, record.id, result)?;
        }
        self.journal.record(&record)?;
        let index = record.index;
        self.records[index] = Some(record);
        Ok(())
    }

    /// Puts everything recorded on the disk, once it has waited long enough or if `now`.
    pub fn sync(&mut self, now: bool) -> Result<(), SweepError> {
        if self.journal.waits(if now { Duration::ZERO } else { GROUP }) {
            self.unsynced.sync(&self.path)?;
            self.journal.sync()?;
        }
        Ok(())
    }

    /// Makes all tables from the journal's records.
    pub fn write_tables(&self, study: &Study) -> Result<(), SweepError> {
        summary::write(&self.path, study, &self.records)?;
        energy::write(&self.path, self.records())
    }
}

/// Whether a path holds a journal, or nothing; anything else is somebody else's.
fn holds_journal(path: &Path) -> Result<bool, SweepError> {
    if !path.exists() {
        return Ok(false);
    }
    if path.join(journal::FILE_NAME).is_file() {
        return Ok(true);
    }
    let entries = fs::read_dir(path).map_err(|error| SweepError::unusable(path, &error))?;
    for entry in entries {
        let entry = entry.map_err(SweepError::io(path))?;
        if entry.file_name() != lock::FILE_NAME {
            let reason = "is not empty and holds no journal; choose another --out";
            return Err(SweepError::refused(path, reason));
        }
    }
    Ok(false)
}

fn check_header(
    path: &Path,
    header: &Header,
    study: &Study,
    requested: Option<SimdPath>,
    widest: SimdPath,
) -> Result<(), SweepError> {
    if header.sweep != study.identity {
        let cases = counted(header.cases, "case");
        let reason = format!(
            "holds another sweep (\"{}\", {cases}); choose another --out, or --fresh to move it \
             aside",
            header.name
        );
        return Err(SweepError::refused(path, reason));
    }
    let recorded = header.simd;
    if recorded > widest {
        let reason = format!(
            "was computed with {}, but the widest that every rank has is {}",
            name_of(recorded),
            name_of(widest)
        );
        return Err(SweepError::refused(path, reason));
    }
    if let Some(simd) = requested.filter(|&simd| simd != recorded) {
        let reason = format!(
            "was computed with {}: --simd {} cannot go on",
            name_of(recorded),
            name_of(simd)
        );
        return Err(SweepError::refused(path, reason));
    }
    Ok(())
}

/// Sorts journal lines into the order of the runs; a later line of the same run wins. Companions
/// are known by their id: asking for other error bars renumbers them.
fn fill(path: &Path, study: &Study, records: &mut [Option<CaseRecord>], lines: Vec<CaseRecord>) {
    let places: HashMap<_, _> = study.runs().map(|case| (case.id, case.index)).collect();
    for record in lines {
        if let Some(&index) = places.get(&record.id) {
            records[index] = Some(CaseRecord { index, ..record });
        }
    }
    let has_history = |record: &CaseRecord| files::is_there(path, record.id, &record.files);
    for record in &mut records[..study.cases.len()] {
        let lacks_history =
            record.as_ref().is_some_and(|record| record.is_ok() && !has_history(record));
        if lacks_history {
            *record = None;
        }
    }
}

fn move_aside(path: &Path) -> Result<PathBuf, SweepError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let free = (1..).map(|number| path.with_file_name(format!("{name}.old-{number}")));
    let aside = free.into_iter().find(|aside| !aside.exists()).expect("numbers do not end");
    fs::rename(path, &aside).map_err(SweepError::io(path))?;
    Ok(aside)
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::study::SweepFile;

    fn study(ratios: &str) -> Study {
        let text = format!("name = \"a\"\n[grid]\nwave_height_ratio = [{ratios}]");
        Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap()
    }

    fn open(path: &Path, study: &Study, mode: OpenMode) -> Result<(Directory, Opened), SweepError> {
        Directory::open(path, study, mode, None, SimdPath::Avx2)
    }

    fn run_first(directory: &mut Directory, study: &Study) {
        let case = &study.cases[0];
        let result = made_up(&case.config);
        let record = CaseRecord::new(study, case, &Ok(result.clone()), 1.0, "here");
        directory.record(record, Some(&result)).unwrap();
        directory.sync(true).unwrap();
    }

    #[test]
    fn a_sweep_goes_on_where_it_stopped() {
        let root = tempfile::tempdir().unwrap();
        let (path, study) = (root.path().join("run"), study("0.1, 0.2"));
        let (mut directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
        assert_eq!(opened, Opened::New);
        run_first(&mut directory, &study);
        drop(directory);
        let (directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
        assert_eq!(opened, Opened::Resumed(1));
        drop(directory);
        // A power cut may leave the name of a file without its content.
        let history = fs::read_dir(path.join("histories")).unwrap().next().unwrap().unwrap().path();
        fs::File::create(&history).unwrap();
        let (mut directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
        assert_eq!(opened, Opened::Resumed(0));
        run_first(&mut directory, &study);
        drop(directory);
        fs::remove_file(history).unwrap();
        let (_directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
        assert_eq!(opened, Opened::Resumed(0));
    }

    #[test]
    fn another_sweeps_directory_is_refused_untouched() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("run");
        open(&path, &study("0.1, 0.2"), OpenMode::Resume).unwrap();
        let before = fs::read(path.join(journal::FILE_NAME)).unwrap();
        let error = open(&path, &study("0.1, 0.3"), OpenMode::Resume).unwrap_err();
        assert!(error.to_string().contains("holds another sweep"), "{error}");
        assert_eq!(fs::read(path.join(journal::FILE_NAME)).unwrap(), before);
        let (_directory, opened) = open(&path, &study("0.1, 0.3"), OpenMode::Fresh).unwrap();
        assert_eq!(opened, Opened::Moved(root.path().join("run.old-1")));
    }

    #[test]
    fn a_strangers_directory_is_never_moved() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("thesis.tex"), "").unwrap();
        for mode in [OpenMode::Resume, OpenMode::Fresh] {
            assert!(open(root.path(), &study("0.1"), mode).unwrap_err().is_refusal());
        }
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_instruction_set_is_kept() {
        let root = tempfile::tempdir().unwrap();
        let (path, study) = (root.path().join("run"), study("0.1, 0.2"));
        let with = |requested, widest| {
            Directory::open(&path, &study, OpenMode::Resume, requested, widest)
                .map(|(directory, _)| directory.simd())
        };
        use SimdPath::{Avx2, Avx512, Portable};
        assert!(with(Some(Avx512), Avx2).is_err());
        assert!(!path.exists(), "nothing is written for a refused request");
        assert_eq!(with(None, Avx2).unwrap(), Avx2);
        assert_eq!(with(None, Avx512).unwrap(), Avx2);
        assert!(with(None, Portable).is_err());
        assert!(with(Some(Portable), Avx2).is_err());
    }
}
