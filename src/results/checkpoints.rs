//! The checkpoints of an output directory.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::atomic_file;
use super::checkpoint::{CASE, Checkpoint, FOLDER, TRUNK, whole};
use super::error::SweepError;
use crate::disk;
use crate::keys::named;
use crate::math::simd::SimdPath;
use crate::study::CaseId;

/// For checkpoints of more cases than this, the folder is listed.
const ASKED: usize = 100;

/// All files that are named as checkpoints, with their id and whether they belong to a case.
fn files(directory: &Path) -> Vec<(PathBuf, CaseId, bool)> {
    let entries = fs::read_dir(directory.join(FOLDER)).into_iter().flatten().flatten();
    let mut files: Vec<_> = entries
        .filter_map(|entry| {
            let path = entry.path();
            let id = path.file_stem()?.to_str()?.parse().ok()?;
            let ending = path.extension()?.to_str()?;
            (ending == CASE || ending == TRUNK).then(|| (path.clone(), id, ending == CASE))
        })
        .collect();
    files.sort();
    files
}

/// Whether an output directory has any checkpoint.
pub fn has_checkpoints(directory: &Path) -> bool {
    !files(directory).is_empty()
}

/// The cases that can go on from a checkpoint, and the faults of others in words.
pub(super) fn look(directory: &Path, simd: SimdPath) -> (BTreeSet<CaseId>, Vec<String>) {
    let (mut cases, mut findings) = (BTreeSet::new(), Vec::new());
    for (path, id, is_case) in files(directory) {
        let ending = if is_case { CASE } else { TRUNK };
        match Checkpoint::of(directory, id, ending, simd).read() {
            Ok(_) if is_case => drop(cases.insert(id)),
            Ok(_) => {}
            Err(why) => {
                let what = if is_case { "its case" } else { "that shared stretch" };
                findings.push(format!("{} {why}: {what} starts over", named(&path)));
            }
        }
    }
    (cases, findings)
}

/// The files that are damaged.
pub(super) fn damaged(directory: &Path) -> impl Iterator<Item = PathBuf> {
    let is_damaged = |path: &PathBuf| fs::read(path).is_ok_and(|bytes| whole(&bytes).is_none());
    files(directory).into_iter().map(|(path, ..)| path).filter(is_damaged)
}

/// Removes those of finished cases, and half-written files.
pub(super) fn tidy(
    directory: &Path,
    finished: impl IntoIterator<Item = CaseId>,
) -> Result<(), SweepError> {
    atomic_file::clean(&[directory.join(FOLDER)])?;
    remove(directory, finished)
}

/// Removes those of finished cases.
pub(super) fn remove(
    directory: &Path,
    cases: impl IntoIterator<Item = CaseId>,
) -> Result<(), SweepError> {
    let folder = directory.join(FOLDER);
    if !folder.is_dir() {
        return Ok(());
    }
    let cases: Vec<CaseId> = cases.into_iter().collect();
    // The folder has few files, but there may be a million cases.
    let listed = || files(directory).into_iter().map(|(_, id, _)| id).collect();
    let there: Option<BTreeSet<CaseId>> = (cases.len() > ASKED).then(listed);
    for id in cases.into_iter().filter(|id| there.as_ref().is_none_or(|there| there.contains(id))) {
        atomic_file::remove(&folder.join(format!("{id}.{CASE}")))?;
    }
    Ok(())
}

/// Removes all of them.
pub(super) fn clear(directory: &Path) -> Result<(), SweepError> {
    let folder = directory.join(FOLDER);
    if folder.is_dir() {
        disk::remove_folder(&folder).map_err(SweepError::io(&folder))
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::names::JOURNAL;

    const ID: &str = "00000000000000ab";

    fn checkpoint(root: &Path) -> Checkpoint {
        Checkpoint::of_case(root, ID.parse().unwrap(), SimdPath::Portable)
    }

    #[test]
    fn any_flipped_bit_and_any_cut_is_told() {
        let root = tempfile::tempdir().unwrap();
        let (kept, state) = (checkpoint(root.path()), [7; 300]);
        let id: CaseId = ID.parse().unwrap();
        kept.write(&state).unwrap();
        assert!(!kept.path().exists(), "not without a journal");
        fs::write(root.path().join(JOURNAL), "").unwrap();
        assert_eq!(kept.read(), Ok(None));
        kept.write(&state).unwrap();
        assert_eq!(kept.read(), Ok(Some(state.to_vec())));
        let simd = SimdPath::Portable;
        assert_eq!(look(root.path(), simd), (BTreeSet::from([id]), Vec::new()));
        let bytes = fs::read(kept.path()).unwrap();
        for place in 0..bytes.len() {
            let mut flipped = bytes.clone();
            flipped[place] ^= 1 << (place % 7);
            fs::write(kept.path(), flipped).unwrap();
            assert!(kept.read().is_err(), "byte {place}");
            fs::write(kept.path(), &bytes[..place]).unwrap();
            assert_eq!(kept.read(), Err("is damaged".to_owned()), "cut at {place}");
        }
        assert_eq!(damaged(root.path()).count(), 1);
        let (cases, told) = look(root.path(), simd);
        assert!(
            cases.is_empty() && told[0].ends_with("is damaged: its case starts over"),
            "{told:?}"
        );
        remove(root.path(), [id]).unwrap();
        assert!(!kept.path().exists());
    }
}
