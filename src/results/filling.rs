//! The records of a study, filled from journal lines, with a look at the files of each case.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::left::Places;
use super::record::{CaseRecord, HeldLine};
use super::{files, left};
use crate::keys::named;
use crate::study::{CaseId, Study};

/// Sorts journal lines into the order of the runs; a later line of the same run wins. Companions
/// are known by their id: asking for other error bars renumbers them.
pub(super) struct Filling<'a> {
    path: &'a Path,
    cases: usize,
    places: HashMap<CaseId, usize>,
    records: Vec<Option<CaseRecord>>,
    /// Where the files of each case are.
    left: Places,
    /// Whether files are looked at.
    looks: bool,
    /// What is wrong with the files of a case.
    damage: BTreeMap<usize, Vec<Damaged>>,
}

impl Filling<'_> {
    pub(super) fn new<'a>(path: &'a Path, study: &Study) -> Filling<'a> {
        Filling {
            path,
            cases: study.cases.len(),
            places: study.runs().map(|case| (case.id, case.index)).collect(),
            records: vec![None; study.run_count()],
            left: Places::new(study.cases.len()),
            looks: true,
            damage: BTreeMap::new(),
        }
    }

    /// The same without a look at files.
    pub(super) fn blind(self) -> Self {
        Filling { looks: false, ..self }
    }

    /// Takes the next lines, and looks at the files of their cases.
    pub(super) fn take(&mut self, lines: Vec<HeldLine>) {
        let (path, cases, places, looks) = (self.path, self.cases, &self.places, self.looks);
        let look = |line: HeldLine| {
            let index = *places.get(&line.id())?;
            let (record, files) = line.split(index);
            let has_files = record.is_ok() && record.index < cases;
            let files = has_files.then_some(&files);
            let left = files.map_or(0, left::folders);
            let damage = files.filter(|_| looks);
            let damage = damage.map(|files| files::damage(path, record.id, files));
            Some((record, left, damage))
        };
        let looked: Vec<_> = lines.into_par_iter().filter_map(look).collect();
        for (record, left, damage) in looked {
            let index = record.index;
            self.left.set(index, left);
            self.damage.remove(&index);
            self.damage.extend(damage.filter(|all| !all.is_empty()).map(|all| (index, all)));
            self.records[index] = Some(record);
        }
    }

    /// The records, without those whose files are damaged or missing, where the files of each are, and what is
    /// wrong with them.
    pub(super) fn end(mut self) -> (Vec<Option<CaseRecord>>, Places, Vec<String>) {
        for &index in self.damage.keys() {
            self.records[index] = None;
        }
        let damage = self.damage.into_values().flatten();
        let told = |file: Damaged| format!("{}: its case runs again", told(&file));
        (self.records, self.left, damage.map(told).collect())
    }

    /// All records, and what is wrong with files.
    pub(super) fn all(self) -> (Vec<Option<CaseRecord>>, Vec<Damaged>) {
        (self.records, self.damage.into_values().flatten().collect())
    }
}

/// A file, and what is wrong with it.
pub(super) type Damaged = (PathBuf, &'static str);

/// That in words.
pub(super) fn told((file, what): &Damaged) -> String {
    format!("{} {what}", named(file))
}
