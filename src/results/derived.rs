//! What the files that are made last were when they were made: `derived.json`.
//!
//! Journal, manifest and the files of cases have sums of their own, and `summary.csv` and `energy.csv` are compared
//! with the journal. Here stands the rest: page, figures, tables, films. Whoever makes them again first takes their
//! seals away, so that a process which dies meanwhile leaves no false ones.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::seal::Seal;
use super::sealed;

const FILE_NAME: &str = "derived.json";
const FILES: [&str; 3] = ["histories.csv.gz", "max_error.csv", "report.html"];
const FILMS: &str = "films/";
const FOLDERS: [&str; 3] = ["figures", "tables", "films"];

/// The seals of a directory's derived files, by their paths in it.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Derived {
    files: BTreeMap<String, Seal>,
}

impl Derived {
    /// Those of a directory; none where nothing tells of them, or what tells is damaged.
    fn read(directory: &Path) -> Derived {
        sealed::read(&directory.join(FILE_NAME)).unwrap_or_default()
    }

    fn write(&self, directory: &Path) -> Result<(), SweepError> {
        sealed::write(&directory.join(FILE_NAME), self)
    }

    /// All but films are about to be made again: only they keep their seals.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn begin(directory: &Path) -> Result<(), SweepError> {
        if !directory.join(FILE_NAME).exists() {
            return Ok(());
        }
        let mut derived = Derived::read(directory);
        derived.files.retain(|name, _| name.starts_with(FILMS));
        derived.write(directory)
    }

    /// Everything is made. A film that has a seal keeps it.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn end(directory: &Path) -> Result<(), SweepError> {
        let mut derived = Derived::read(directory);
        for name in names(directory) {
            if let Entry::Vacant(place) = derived.files.entry(name) {
                let path = directory.join(place.key());
                place.insert(Seal::of_file(&path).map_err(SweepError::io(&path))?);
            }
        }
        derived.write(directory)
    }

    /// These files were made or removed, if seals are kept here.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn renew(directory: &Path, paths: &[PathBuf]) -> Result<(), SweepError> {
        if !directory.join(FILE_NAME).exists() {
            return Ok(());
        }
        let mut derived = Derived::read(directory);
        for path in paths {
            let Ok(name) = path.strip_prefix(directory) else { continue };
            let name = name.to_string_lossy().into_owned();
            derived.files.remove(&name);
            if path.is_file() {
                let seal = Seal::of_file(path).map_err(SweepError::io(path))?;
                derived.files.insert(name, seal);
            }
        }
        derived.write(directory)
    }

    /// Whether any of these files is not as it was made.
    pub fn is_damaged(directory: &Path, paths: &[PathBuf]) -> bool {
        let derived = Derived::read(directory);
        paths.iter().any(|path| {
            let name = path.strip_prefix(directory).unwrap_or(path).to_string_lossy();
            derived.files.get(&*name).is_some_and(|seal| seal.fits(path) != Some(true))
        })
    }
}

/// What is not as it was made, in words.
pub(super) fn damage(directory: &Path) -> Vec<String> {
    let path = directory.join(FILE_NAME);
    if fs::read(&path).is_ok_and(|text| !sealed::is_whole(&text)) {
        return vec![format!("{FILE_NAME} is damaged")];
    }
    let files = Derived::read(directory).files.into_iter();
    let told = files.filter_map(|(name, seal)| match seal.fits(&directory.join(&name)) {
        Some(true) => None,
        Some(false) => Some(format!("{name} is damaged")),
        None => Some(format!("{name} is missing")),
    });
    told.collect()
}

/// The derived files that there are.
fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = FILES.map(str::to_owned).into();
    for folder in FOLDERS {
        let entries = fs::read_dir(directory.join(folder)).into_iter().flatten().flatten();
        names.extend(entries.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            Some(format!("{folder}/{name}"))
        }));
    }
    names.retain(|name| directory.join(name).is_file());
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changed_since_it_was_made_is_told() {
        let root = tempfile::tempdir().unwrap();
        let (directory, film) = (root.path(), root.path().join("films/a.html"));
        for folder in FOLDERS {
            fs::create_dir(directory.join(folder)).unwrap();
        }
        let write = |name: &str, text: &str| fs::write(directory.join(name), text).unwrap();
        let names = ["report.html", "figures/a.svg", "films/a.html", "tables/a.csv"];
        names.iter().for_each(|name| write(name, "old"));
        assert!(damage(directory).is_empty(), "nothing is known of them yet");
        Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
        Derived::begin(directory).unwrap();
        assert!(!directory.join(FILE_NAME).exists());
        Derived::end(directory).unwrap();
        assert!(damage(directory).is_empty());
        names.iter().for_each(|name| write(name, "new"));
        let told = ["figures/a.svg", "films/a.html", "report.html", "tables/a.csv"];
        assert_eq!(damage(directory), told.map(|name| format!("{name} is damaged")));
        // To make all again mends all but the film, which nobody has made.
        Derived::begin(directory).unwrap();
        Derived::end(directory).unwrap();
        assert_eq!(damage(directory), ["films/a.html is damaged"]);
        assert!(Derived::is_damaged(directory, std::slice::from_ref(&film)));
        Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
        assert!(damage(directory).is_empty());
        fs::remove_file(&film).unwrap();
        assert_eq!(damage(directory), ["films/a.html is missing"]);
        Derived::renew(directory, &[film]).unwrap();
        assert!(damage(directory).is_empty());
        write(FILE_NAME, "{}");
        assert_eq!(damage(directory), ["derived.json is damaged"]);
        Derived::begin(directory).unwrap();
        Derived::end(directory).unwrap();
        assert!(damage(directory).is_empty());
    }
}
