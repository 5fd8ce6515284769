//! A small study with made-up results, for tests of its files.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::made_up::made_up;
use super::{CaseRecord, Directory, OpenMode};
use crate::math::simd::SimdPath;
use crate::study::{Case, Study, SweepFile};

/// What it is computed with.
pub(super) const SIMD: SimdPath = SimdPath::Portable;

/// A study of waves of these heights.
pub(super) fn study(ratios: &str) -> Study {
    of_file(&format!("name = \"a\"\n[grid]\nwave_height_ratio = [{ratios}]"))
}

/// The study of a file.
pub(super) fn of_file(text: &str) -> Study {
    Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap()
}

/// A place for the directory of a study of waves of these heights, which nobody has made yet.
pub(super) fn room(ratios: &str) -> (TempDir, PathBuf, Study) {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("run");
    (root, path, study(ratios))
}

/// The record of a case that has ended well.
pub(super) fn record(study: &Study, case: &Case) -> CaseRecord {
    CaseRecord::new(study, case, &Ok(made_up(&case.config)), 1.0, "here")
}

/// Opens a directory to go on with it.
pub(super) fn open(path: &Path, study: &Study) -> Directory {
    Directory::open(path, study, OpenMode::Resume, None, SIMD).unwrap().0
}

/// Runs a case and records it.
pub(super) fn run(directory: &mut Directory, study: &Study, case: &Case) {
    let result = made_up(&case.config);
    directory.record(record(study, case), Some(&result)).unwrap();
}

/// A directory in which all cases have run.
pub(super) fn finished(path: &Path, study: &Study) -> Directory {
    let mut directory = open(path, study);
    study.cases.iter().for_each(|case| run(&mut directory, study, case));
    directory.sync(true).unwrap();
    directory.write_tables(study, &|| false).unwrap();
    directory
}
