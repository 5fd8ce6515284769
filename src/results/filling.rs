//! The records of a study, filled from journal lines, with a check of each case's files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::closing::Closing;
use super::ended::{Ended, EndedLine, Line};
use super::entries::Content;
use super::error::SweepError;
use super::left::Places;
use super::looked::{self, Looked};
use super::stamp::{CaseFiles, OpenFolders, Stamps};
use super::{files, journal};
use crate::keys::named;
use crate::study::{CaseId, CaseMap, Study};

/// Sorts journal lines into the order of the runs; a later line of the same run replaces an earlier
/// one. Companions are found by their id, because other error bars change their numbers.
pub(super) struct Filling<'a, L: Line> {
    path: &'a Path,
    folders: OpenFolders,
    cases: usize,
    places: CaseMap<usize>,
    records: Vec<Option<L::Held>>,
    /// Where the files of each case are.
    left: Places,
    /// Whether files are checked.
    looks: bool,
    /// Whether notes on them are needed.
    notes: bool,
    /// The notes of an earlier process.
    known: Option<Looked>,
    /// Number of lines so far.
    taken: usize,
    /// Files that were read and are intact.
    found: Vec<CaseFiles>,
    /// The system's data on files with earlier notes, and on all files.
    noted: Stamps,
    stamps: Stamps,
    /// The faults of a case's files.
    damage: BTreeMap<usize, Vec<Damaged>>,
}

impl<'a, L: Line> Filling<'a, L> {
    pub(super) fn new(path: &'a Path, study: &Study) -> Filling<'a, L> {
        Filling {
            path,
            folders: OpenFolders::of(path),
            cases: study.cases.len(),
            places: study.runs().map(|case| (case.id, case.index)).collect(),
            records: vec![None; study.run_count()],
            left: Places::new(study.cases.len()),
            looks: true,
            notes: false,
            known: None,
            taken: 0,
            found: Vec::new(),
            noted: Stamps::default(),
            stamps: Stamps::default(),
            damage: BTreeMap::new(),
        }
    }

    /// The same without a check of files.
    pub(super) fn blind(self) -> Self {
        Filling { looks: false, ..self }
    }

    /// The same for a large study. Files with notes of an earlier process are not read again.
    fn noting(self, known: Option<Looked>) -> Self {
        let [noted, stamps] = [Stamps::new(self.cases), Stamps::new(self.cases)];
        Filling { notes: true, known, noted, stamps, ..self }
    }

    /// Takes the next lines, and checks the files of their cases.
    pub(super) fn take(&mut self, lines: Vec<L>) {
        let (path, cases, places, folders) = (self.path, self.cases, &self.places, &self.folders);
        let (looks, notes) = (self.looks, self.notes);
        let known = self.known.map_or(0, |known| known.lines).saturating_sub(self.taken);
        self.taken += lines.len();
        let look = |(number, line): (usize, L)| {
            let Ended { id, is_ok } = line.ended();
            let index = *places.get(&id)?;
            let (record, seals) = line.split(index);
            let has_files = is_ok && index < cases;
            let files = has_files.then(|| CaseFiles::of(id, &seals));
            // Before they are read, so that a change meanwhile shows later.
            let stamp = files.filter(|_| notes).map_or(Some(0), |files| files.stamp(folders));
            let is_noted = number < known;
            let is_read = looks && has_files && !is_noted;
            let damage = is_read.then(|| files::damage(path, id, &seals));
            Some((index, record, files, stamp, is_noted, damage.unwrap_or_default()))
        };
        let looked: Vec<_> = lines.into_par_iter().enumerate().filter_map(look).collect();
        for (index, record, files, stamp, is_noted, damage) in looked {
            self.left.set(index, files.map_or(0, |files| files.folders));
            self.damage.remove(&index);
            if is_noted {
                self.noted.set(index, stamp);
            } else if damage.is_empty() {
                self.found.extend(files.filter(|_| notes));
            }
            self.stamps.set(index, if damage.is_empty() { stamp } else { Some(0) });
            self.damage.extend((!damage.is_empty()).then_some((index, damage)));
            self.records[index] = Some(record);
        }
    }

    /// Whether the files with earlier notes have not changed.
    fn bears_out(&self) -> bool {
        let known = self.known.filter(|known| known.lines <= self.taken);
        known.is_some_and(|known| self.noted.sum() == Some(known.files))
    }

    /// All records, and the faults of files.
    pub(super) fn all(self) -> (Vec<Option<L::Held>>, Vec<Damaged>) {
        (self.records, self.damage.into_values().flatten().collect())
    }
}

impl Filling<'_, EndedLine> {
    /// All records, without runs whose files are damaged or missing.
    pub(super) fn end(mut self) -> Filled {
        let damaged = self.damage.keys().filter_map(|&index| self.records[index].take());
        let owed = damaged.map(|run| run.id).collect();
        let damage = self.damage.into_values().flatten();
        let told = |file: Damaged| format!("{}: its case runs again", in_words(&file));
        Filled {
            runs: self.records,
            left: self.left,
            told: damage.map(told).collect(),
            found: self.found,
            owed,
            stamps: self.stamps.sum().filter(|_| self.notes),
            is_noted: self.known.is_some(),
        }
    }
}

/// The records of a journal, in the order of the runs.
pub(super) struct Filled {
    pub runs: Vec<Option<Ended>>,
    /// Where the files of each case are.
    pub left: Places,
    /// The faults of files, in words.
    pub told: Vec<String>,
    /// Files of a large study that were read and are intact. An earlier process may have died
    /// before they were on the disk.
    pub found: Vec<CaseFiles>,
    /// Cases whose files are damaged or missing.
    pub owed: BTreeSet<CaseId>,
    /// A sum over the system's data on all files. `None` for a small study, or if a file is missing
    /// or has another length.
    pub stamps: Option<u64>,
    /// Whether the notes of an earlier process still hold.
    pub is_noted: bool,
}

impl Filled {
    /// For a study without finished runs.
    pub(super) fn nothing(study: &Study) -> Filled {
        let is_large = study.cases.len() > looked::ABOVE;
        Filled {
            runs: vec![None; study.run_count()],
            left: Places::new(study.cases.len()),
            told: Vec::new(),
            found: Vec::new(),
            owed: BTreeSet::new(),
            stamps: is_large.then_some(0),
            is_noted: false,
        }
    }
}

/// The records in the journal of a study, with a check of its cases' files. The notes of an earlier
/// process are used if all of them still hold.
pub(super) fn fill<'a>(
    path: &'a Path,
    study: &Study,
) -> Result<(Content<EndedLine>, Filling<'a, EndedLine>), SweepError> {
    let read = |mut filling: Filling<'a, EndedLine>| {
        let content = journal::read_in_blocks(path, |lines| filling.take(lines))?;
        Ok::<_, SweepError>((content, filling))
    };
    if Closing::read(path).is_some() {
        return read(Filling::new(path, study).blind());
    }
    let new = || Filling::new(path, study);
    if study.cases.len() <= looked::ABOVE {
        return read(new());
    }
    if let Some(known) = Looked::read(path) {
        let (content, filling) = read(new().noting(Some(known)))?;
        // If a line is lost, those after it have another place.
        if content.damaged == 0 && filling.bears_out() {
            return Ok((content, filling));
        }
    }
    read(new().noting(None))
}

/// A file, and its fault.
pub(super) type Damaged = (PathBuf, &'static str);

/// The same in words.
pub(super) fn in_words((file, what): &Damaged) -> String {
    format!("{} {what}", named(file))
}
