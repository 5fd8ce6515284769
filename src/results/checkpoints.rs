//! Checkpoints of cases that take long: `checkpoints/<id>.case`, of shared stretches `<id>.trunk`.
//!
//! A file is a line of JSON, `{"sum":"<16 hexadecimal digits>","checkpoint":<head>}`, and the state of
//! the run, as bytes. The sum is the start of SHA-256 over the head's text and the state. It is replaced
//! whole. It counts for the build that wrote it alone: another one starts over, to its own bits.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::checksum::checksum_of;
use super::error::SweepError;
use super::journal;
use super::program::Program;
use super::{atomic_file, disk};
use crate::math::simd::SimdPath;
use crate::study::CaseId;

const FOLDER: &str = "checkpoints";
/// Ending of the files of cases.
const CASE: &str = "case";
/// Ending of those of shared stretches.
const TRUNK: &str = "trunk";
/// Changes whenever the layout of the file does; that of the state changes with the build.
const LAYOUT: u32 = 1;
/// What stands before the sum, and between it and the head.
const FRAME: [&str; 2] = ["{\"sum\":\"", "\",\"checkpoint\":"];
/// Length of a sum.
const SUM: usize = 16;

/// What stands before the state.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    layout: u32,
    program: Program,
    id: CaseId,
    simd: SimdPath,
}

impl Head {
    /// The line that stands before a state.
    fn line(&self, state: &[u8]) -> String {
        let head = serde_json::to_string(self).expect("plain data has a JSON form");
        let ([before, between], sum) = (FRAME, checksum_of([head.as_bytes(), state]));
        format!("{before}{sum}{between}{head}}}\n")
    }
}

/// The checkpoint of a case or of a shared stretch, which may be there or not.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    directory: PathBuf,
    path: PathBuf,
    id: CaseId,
    simd: SimdPath,
}

impl Checkpoint {
    /// That of a case in an output directory, run with these instructions.
    pub fn of_case(directory: &Path, id: CaseId, simd: SimdPath) -> Checkpoint {
        Checkpoint::of(directory, id, CASE, simd)
    }

    /// That of a shared stretch.
    pub fn of_trunk(directory: &Path, id: CaseId, simd: SimdPath) -> Checkpoint {
        Checkpoint::of(directory, id, TRUNK, simd)
    }

    fn of(directory: &Path, id: CaseId, ending: &str, simd: SimdPath) -> Checkpoint {
        let path = directory.join(FOLDER).join(format!("{id}.{ending}"));
        Checkpoint { directory: directory.to_owned(), path, id, simd }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Replaces it by this state, which is on the disk afterwards. A rank that does not see the sweep's
    /// directory keeps nothing.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, state: &[u8]) -> Result<(), SweepError> {
        if !self.directory.join(journal::FILE_NAME).is_file() {
            return Ok(());
        }
        let folder = self.directory.join(FOLDER);
        if !folder.is_dir() {
            disk::create_folder(&folder).map_err(SweepError::io(&folder))?;
        }
        let head = Head { layout: LAYOUT, program: Program::this(), id: self.id, simd: self.simd };
        let head = head.line(state);
        atomic_file::write_with(&self.path, |file| {
            let written = disk::write(file, head.as_bytes());
            let written = written.and_then(|()| disk::write(file, state));
            written.map_err(SweepError::io(&self.path))
        })
    }

    /// Its state; `None` where there is none.
    ///
    /// # Errors
    /// Why it cannot be gone on from, in words that follow its name.
    pub fn read(&self) -> Result<Option<Vec<u8>>, String> {
        if !self.path.exists() {
            return Ok(None);
        }
        let mut bytes = fs::read(&self.path).map_err(|error| format!("cannot be read: {error}"))?;
        let (head, start) = whole(&bytes).ok_or("is damaged")?;
        let program = Program::this();
        let of_another = head.program.sources != program.sources || head.layout != LAYOUT;
        if of_another || head.program.version != program.version {
            return Err(format!("was written by another build, {}", head.program));
        }
        if (head.id, head.simd) != (self.id, self.simd) {
            return Err("is of another case".to_owned());
        }
        bytes.drain(..start);
        Ok(Some(bytes))
    }
}

/// The head of a file, and where its state begins; `None` where anything is damaged.
fn whole(bytes: &[u8]) -> Option<(Head, usize)> {
    let end = bytes.iter().position(|&byte| byte == b'\n')?;
    let [before, between] = FRAME.map(str::as_bytes);
    let (sum, rest) = bytes[..end].strip_prefix(before)?.split_at_checked(SUM)?;
    let head = rest.strip_prefix(between)?.strip_suffix(b"}")?;
    if checksum_of([head, &bytes[end + 1..]]).as_bytes() != sum {
        return None;
    }
    Some((serde_json::from_slice(head).ok()?, end + 1))
}

/// Every file that stands for a checkpoint, with its id and whether it is that of a case.
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

/// The cases that can go on from a checkpoint, and in words what is wrong with others.
pub(super) fn look(directory: &Path, simd: SimdPath) -> (BTreeSet<CaseId>, Vec<String>) {
    let (mut cases, mut findings) = (BTreeSet::new(), Vec::new());
    for (path, id, is_case) in files(directory) {
        let ending = if is_case { CASE } else { TRUNK };
        match Checkpoint::of(directory, id, ending, simd).read() {
            Ok(_) if is_case => drop(cases.insert(id)),
            Ok(_) => {}
            Err(why) => {
                let what = if is_case { "its case" } else { "that shared stretch" };
                findings.push(format!("{} {why}: {what} starts over", path.display()));
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

/// Removes those of finished cases, and what was left half written.
pub(super) fn tidy(
    directory: &Path,
    finished: impl IntoIterator<Item = CaseId>,
) -> Result<(), SweepError> {
    atomic_file::clean(&directory.join(FOLDER))?;
    remove(directory, finished)
}

/// Removes those of finished cases.
pub(super) fn remove(
    directory: &Path,
    cases: impl IntoIterator<Item = CaseId>,
) -> Result<(), SweepError> {
    if !directory.join(FOLDER).is_dir() {
        return Ok(());
    }
    for id in cases {
        let path = directory.join(FOLDER).join(format!("{id}.{CASE}"));
        if path.exists() {
            disk::remove_file(&path).map_err(SweepError::io(&path))?;
        }
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

    fn checkpoint(root: &Path) -> Checkpoint {
        Checkpoint::of_case(root, "00000000000000ab".parse().unwrap(), SimdPath::Portable)
    }

    #[test]
    fn any_flipped_bit_and_any_cut_is_told() {
        let root = tempfile::tempdir().unwrap();
        let (kept, state) = (checkpoint(root.path()), [7; 300]);
        kept.write(&state).unwrap();
        assert!(!kept.path().exists(), "not without a journal");
        fs::write(root.path().join(journal::FILE_NAME), "").unwrap();
        assert_eq!(kept.read(), Ok(None));
        kept.write(&state).unwrap();
        assert_eq!(kept.read(), Ok(Some(state.to_vec())));
        let simd = SimdPath::Portable;
        assert_eq!(look(root.path(), simd), (BTreeSet::from([kept.id]), Vec::new()));
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
        remove(root.path(), [kept.id]).unwrap();
        assert!(!kept.path().exists());
    }

    #[test]
    fn another_builds_and_another_cases_are_not_gone_on_from() {
        let root = tempfile::tempdir().unwrap();
        let kept = checkpoint(root.path());
        fs::write(root.path().join(journal::FILE_NAME), "").unwrap();
        kept.write(b"state").unwrap();
        let bytes = fs::read(kept.path()).unwrap();
        let program = Program { sources: "0123456789abcdef".to_owned(), ..Program::this() };
        let head = Head { layout: LAYOUT, program, id: kept.id, simd: kept.simd };
        fs::write(kept.path(), head.line(b"state") + "state").unwrap();
        assert!(kept.read().unwrap_err().starts_with("was written by another build, "));
        assert_eq!(damaged(root.path()).count(), 0, "it is whole");
        let other = Checkpoint { id: "00000000000000ac".parse().unwrap(), ..kept.clone() };
        fs::write(kept.path(), bytes).unwrap();
        assert!(other.read().unwrap_err().contains("another case"));
        let other = Checkpoint { simd: SimdPath::Avx2, ..kept };
        assert!(other.read().unwrap_err().contains("another case"));
    }
}
