//! The output directory: its study, its lock, and its contents.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::attempts::Attempts;
use super::ended::Ended;
use super::entries::Header;
use super::error::SweepError;
use super::filing::Filed;
use super::filling::{self, Filled};
use super::journal::{self, Journal};
use super::left::{self, Left, Places};
use super::load::forget_load;
use super::lock::Lock;
use super::looked::{Looked, Notes};
use super::making::Wish;
use super::opening::{self, Found, OpenMode, Opened, look};
use super::record::CaseRecord;
use super::stamp::CaseFiles;
use super::waiting::Waiting;
use super::{again, checkpoints, files, probe_columns, tables};
use crate::disk;
use crate::math::simd::SimdPath;
use crate::simulation::CaseResult;
use crate::study::{CaseId, Study};

/// An output directory, locked.
#[derive(Debug)]
pub struct Directory {
    path: PathBuf,
    _lock: Lock,
    journal: Journal,
    waiting: Waiting,
    simd: SimdPath,
    runs: Vec<Option<Ended>>,
    /// The journal's records at the time when the tables were written; empty before.
    records: Vec<Option<CaseRecord>>,
    /// Where the files of each case are.
    left: Places,
    /// Runs before this index are cases, the others companions.
    cases: usize,
    findings: Vec<String>,
    attempts: Attempts,
    /// Cases that can go on from a checkpoint of their own.
    kept: BTreeSet<CaseId>,
    /// The contents of the probes' columns, until they are written.
    probe_columns: Option<String>,
}

impl Directory {
    /// Opens the directory for a study. `requested` is the user's SIMD, `widest` that of all ranks.
    ///
    /// # Errors
    /// A directory of another sweep or of another program, a damaged journal, a held lock, an
    /// instruction set that is not possible, a file that cannot be written.
    pub fn open(
        path: &Path,
        study: &Study,
        mode: OpenMode,
        requested: Option<SimdPath>,
        widest: SimdPath,
    ) -> Result<(Directory, Opened), SweepError> {
        opening::check_request(requested, widest)?;
        let before = look(path)?;
        if let (OpenMode::Resume, Found::Journal(..)) = (mode, &before)
            && let Some(header) = journal::read_header(path)?
        {
            opening::check_header(path, &header, study, requested, widest)?;
        }
        opening::refuse_remains(path, mode, &before)?;
        disk::create_folder(path).map_err(|error| SweepError::unusable(path, &error))?;
        let mut lock = Lock::hold(path)?;
        let mut opened = Opened::New;
        if mode == OpenMode::Fresh {
            opening::demand_same(path, &before)?;
        }
        if mode == OpenMode::Fresh && before != Found::Nothing {
            let (aside, new) = opening::replace(path)?;
            lock = new;
            opened = Opened::Moved(aside);
        }
        let (mut findings, count) = (Vec::new(), study.cases.len());
        let (journal, simd, lines, filled);
        if look(path)? == Found::Nothing {
            simd = requested.unwrap_or(widest);
            let header = Header::new(&study.name, &study.identity, count, simd);
            journal = Journal::create(path, &header)?;
            (lines, filled) = (0, Filled::nothing(study));
        } else {
            let (content, filling) = filling::fill(path, study)?;
            findings.extend(opening::told_damage(&content, true));
            let header = opening::header(path, &content, study, requested.unwrap_or(widest))?;
            opening::check_header(path, &header, study, requested, widest)?;
            journal = Journal::resume(path, &content, &header)?;
            files::clean(path)?;
            (simd, lines, filled) = (header.simd, content.found, filling.end());
            opened = Opened::Resumed(filled.runs.iter().flatten().count());
        }
        let Filled { runs, left, told, found, owed, stamps, is_noted } = filled;
        findings.extend(told);
        if !is_noted {
            Looked::forget(path)?;
        }
        let notes = Notes::of(&journal, lines, stamps)?;
        let finished = runs.iter().flatten().map(|run| run.id);
        checkpoints::tidy(path, finished)?;
        let (kept, told) = checkpoints::look(path, simd);
        findings.extend(told);
        let directory = Directory {
            kept,
            probe_columns: probe_columns::text(study),
            attempts: Attempts::open(path)?,
            path: path.to_owned(),
            _lock: lock,
            journal,
            waiting: Waiting::new(path, found, notes, owed)?,
            simd,
            runs,
            records: Vec::new(),
            left,
            cases: count,
            findings,
        };
        Ok((directory, opened))
    }

    /// The damage found on opening, in words. The cases in question run again.
    pub fn findings(&self) -> &[String] {
        &self.findings
    }

    /// The list of work that has begun and not ended; see [`Attempts`].
    pub fn attempts(&mut self) -> &mut Attempts {
        &mut self.attempts
    }

    /// The cases and companions that can go on from a checkpoint of their own.
    pub fn kept(&self) -> &BTreeSet<CaseId> {
        &self.kept
    }

    /// Removes what only a running study needs, after everything has run.
    pub fn clear(&mut self) -> Result<(), SweepError> {
        Looked::forget(&self.path)?;
        self.attempts.close()?;
        forget_load(&self.path)?;
        checkpoints::clear(&self.path)
    }

    /// Makes sure that the directory and its journal were not deleted or moved.
    pub fn demand_in_place(&self) -> Result<(), SweepError> {
        self.journal.demand_in_place()
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The instruction set that all cases here are computed with.
    pub fn simd(&self) -> SimdPath {
        self.simd
    }

    /// The cases and companions that have ended, in the order of [`Study::runs`].
    pub fn runs(&self) -> &[Option<Ended>] {
        &self.runs
    }

    /// The finished cases in grid order, once tables are written; see [`super::finished`].
    pub fn case_records(&self) -> &[Option<CaseRecord>] {
        &self.records[..self.cases.min(self.records.len())]
    }

    /// The same of cases and companions, in the order of [`Study::runs`].
    pub fn records(&self) -> &[Option<CaseRecord>] {
        &self.records
    }

    /// Forgets failed cases, so that they run again; with `companions` failed companions, too.
    pub fn retry_failed(&mut self, companions: bool) {
        let among = if companions { self.runs.len() } else { self.cases };
        let failed = self.runs[..among].iter_mut().filter(|run| run.is_some_and(|run| !run.is_ok));
        failed.for_each(|run| *run = None);
    }

    /// The files of all cases so far, for a last check.
    pub fn left(&self) -> Left {
        self.left.of(&self.runs)
    }

    /// Forgets the records, but stays locked: for work that only reads files.
    pub fn forget_records(&mut self) {
        (self.runs, self.records) = Default::default();
    }

    /// Records a finished case: its files first, its journal line after.
    pub fn record(
        &mut self,
        mut record: CaseRecord,
        result: Option<&CaseResult>,
    ) -> Result<(), SweepError> {
        if let Some(result) = result.filter(|_| self.leaves_files(&record)) {
            record.files = files::write(&self.path, record.id, result, false)?;
        }
        self.take(record, false)
    }

    /// Records a case whose files were written where it ran.
    pub fn record_filed(&mut self, record: CaseRecord, filed: &Filed) -> Result<(), SweepError> {
        self.take(record, filed.on_disk)
    }

    /// Whether a run leaves files besides its line.
    fn leaves_files(&self, record: &CaseRecord) -> bool {
        record.is_ok() && record.index < self.cases
    }

    /// Records a run whose files are written. They may be on the disk already.
    fn take(&mut self, record: CaseRecord, on_disk: bool) -> Result<(), SweepError> {
        if let Some(columns) = self.probe_columns.take_if(|_| files::has_probes(&record.files)) {
            probe_columns::put(&self.path, &columns)?;
        }
        self.journal.record(&record)?;
        self.left.set(record.index, left::folders(&record.files));
        if self.leaves_files(&record) {
            self.waiting.add_files(CaseFiles::of(record.id, &record.files), on_disk);
        }
        self.waiting.add_line(record.id);
        self.runs[record.index] = Some(Ended { id: record.id, is_ok: record.is_ok() });
        Ok(())
    }

    /// Puts records on the disk: with `now` all, before it returns; else those that have waited.
    pub fn sync(&mut self, now: bool) -> Result<(), SweepError> {
        self.waiting.sync(&self.path, &mut self.journal, now)
    }

    /// Makes all tables from the journal's records, which are kept in memory from then on. False
    /// where another process writes there, and `gives_up` says not to wait for it.
    pub fn write_tables(&mut self, study: &Study, gives_up: Wish<'_>) -> Result<bool, SweepError> {
        self.demand_in_place()?;
        self.records = again::finished_of(&self.path, study, &self.runs)?;
        tables::write(&self.path, study, &self.records, gives_up)
    }
}

#[cfg(test)]
mod tests;
