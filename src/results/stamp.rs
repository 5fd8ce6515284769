//! The system's data on the files of a case. A change shows in them without reading the files.

use std::os::fd::OwnedFd;
use std::path::{Path, PathBuf};

use rustix::fs::{AtFlags, Mode, OFlags, statat};

use super::left::{self, Folders};
use super::seal::Seals;
use crate::disk::names::{CASE_FOLDERS, case_file, of_case};
use crate::study::CaseId;

/// The files of a case in a few bytes, because there may be a million cases.
#[derive(Debug, Clone, Copy)]
pub(super) struct CaseFiles {
    pub(super) id: CaseId,
    pub(super) folders: Folders,
    /// A sum over their seals.
    seals: u64,
    /// The sum of their lengths.
    bytes: u64,
}

impl CaseFiles {
    /// Those of a successful case.
    pub(super) fn of(id: CaseId, seals: &Seals) -> CaseFiles {
        let mut sum = id.number();
        for (folder, seal) in seals {
            let place = CASE_FOLDERS.iter().position(|name| name == folder);
            sum = mixed(sum, place.map_or(u64::MAX, |place| place as u64));
            sum = mixed(sum, seal.bytes);
            sum = mixed(sum, u64::from_str_radix(&seal.sum, 16).unwrap_or(u64::MAX));
        }
        let bytes = seals.values().map(|seal| seal.bytes).fold(0, u64::wrapping_add);
        CaseFiles { id, folders: left::folders(seals), seals: sum, bytes }
    }

    /// Their paths.
    pub(super) fn paths(self, directory: &Path) -> impl Iterator<Item = PathBuf> {
        self.there().map(move |at| of_case(directory, CASE_FOLDERS[at], self.id))
    }

    /// A sum over the system's data on them. It changes if any of them was changed or replaced.
    /// `None` if one is missing, or their length has changed.
    pub(super) fn stamp(self, folders: &OpenFolders) -> Option<u64> {
        let (name, mut sum, mut bytes) = (case_file(self.id), self.seals, 0);
        for folder in self.there().map(|at| &folders.0[at]) {
            let file = statat(folder.as_ref()?, &name, AtFlags::empty()).ok()?;
            bytes += file.st_size as u64;
            let times = [file.st_ctime as u64, file.st_ctime_nsec as u64];
            sum = [file.st_size as u64, file.st_ino].into_iter().chain(times).fold(sum, mixed);
        }
        (bytes == self.bytes).then_some(sum)
    }

    /// Indices of their folders.
    fn there(self) -> impl Iterator<Item = usize> {
        (0..CASE_FOLDERS.len()).filter(move |at| self.folders >> at & 1 == 1)
    }
}

/// The existing folders of a study's files, open. Looking up a file from the root would take a
/// fifth longer.
pub(super) struct OpenFolders([Option<OwnedFd>; CASE_FOLDERS.len()]);

impl OpenFolders {
    /// Those of a directory.
    pub(super) fn of(directory: &Path) -> OpenFolders {
        // A pipe in a folder's place must not block.
        let flags = OFlags::DIRECTORY | OFlags::CLOEXEC;
        let open = |name| rustix::fs::open(directory.join(name), flags, Mode::empty()).ok();
        OpenFolders(CASE_FOLDERS.map(open))
    }
}

/// Stamps of the cases of a study, by index. If a case runs again, the last one counts.
#[derive(Debug, Default)]
pub(super) struct Stamps(Vec<Option<u64>>);

impl Stamps {
    /// For this many cases without files.
    pub(super) fn new(cases: usize) -> Stamps {
        Stamps(vec![Some(0); cases])
    }

    /// That of this run, if it is a case.
    pub(super) fn set(&mut self, index: usize, stamp: Option<u64>) {
        if let Some(place) = self.0.get_mut(index) {
            *place = stamp;
        }
    }

    /// Their sum; `None` where one is missing.
    pub(super) fn sum(&self) -> Option<u64> {
        self.0.iter().try_fold(0_u64, |sum, stamp| Some(sum.wrapping_add((*stamp)?)))
    }
}

/// A sum with one more number. Its steps are those of SplitMix64 (Steele et al. 2014).
fn mixed(sum: u64, number: u64) -> u64 {
    let mut mixed = (sum ^ number).wrapping_add(0x9E37_79B9_7F4A_7C15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    mixed ^ (mixed >> 31)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::seal::Seal;
    use super::*;

    #[test]
    fn any_change_of_a_file_shows() {
        let root = tempfile::tempdir().unwrap();
        let (directory, id) = (root.path(), "00000000000000ab".parse().unwrap());
        let seals: Seals =
            ["histories", "waves"].map(|name| (name.to_owned(), Seal::of(b"1,2\n"))).into();
        let files = CaseFiles::of(id, &seals);
        let open = || OpenFolders::of(directory);
        assert_eq!(files.stamp(&open()), None);
        for path in files.paths(directory) {
            fs::create_dir(path.parent().unwrap()).unwrap();
            fs::write(&path, "1,2\n").unwrap();
        }
        let waves = directory.join("waves/00000000000000ab.csv");
        assert_eq!(files.paths(directory).last(), Some(waves.clone()));
        let mut before = files.stamp(&open()).unwrap();
        assert_eq!(files.stamp(&open()), Some(before));
        let replace = || {
            fs::write(directory.join("new"), "1,2\n").unwrap();
            fs::rename(directory.join("new"), &waves).unwrap();
        };
        let changes: [&dyn Fn(); 4] = [
            &|| fs::write(&waves, "1,3\n").unwrap(),
            &|| fs::set_permissions(&waves, fs::metadata(&waves).unwrap().permissions()).unwrap(),
            &|| fs::hard_link(&waves, directory.join("link")).unwrap(),
            &replace,
        ];
        for (number, change) in changes.iter().enumerate() {
            std::thread::sleep(std::time::Duration::from_millis(20));
            change();
            let now = files.stamp(&open()).unwrap();
            assert_ne!(now, before, "change {number}");
            before = now;
        }
        let mut others = seals.clone();
        others.insert("waves".to_owned(), Seal::of(b"1,3\n"));
        assert_ne!(CaseFiles::of(id, &others).stamp(&open()).unwrap(), before);
        fs::write(&waves, "1,23\n").unwrap();
        assert_eq!(files.stamp(&open()), None);
        fs::remove_file(&waves).unwrap();
        assert_eq!(files.stamp(&open()), None);
    }
}
