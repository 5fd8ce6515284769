//! A checkpoint of a long case, `checkpoints/<id>.case`, or of a trunk, `<id>.trunk`.
//!
//! A file is a line of JSON, `{"sum":"<16 hexadecimal digits>","checkpoint":<head>}`, and the state
//! of the run, as bytes. The sum is the start of SHA-256 over the head's text and the state. The
//! file is always replaced as a whole. Only the build that wrote it can use it; another build
//! starts again, with its own bits.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic_file;
use super::checksum::Frame;
use super::error::SweepError;
use super::program::Program;
use crate::disk;
use crate::disk::names::JOURNAL;
use crate::math::simd::SimdPath;
use crate::study::CaseId;

/// Where they are.
pub(super) const FOLDER: &str = "checkpoints";
/// Ending of the files of cases.
pub(super) const CASE: &str = "case";
/// Ending of the files of trunks.
pub(super) const TRUNK: &str = "trunk";
/// Changes whenever the layout of the file does. The layout of the state changes with the build.
const LAYOUT: u32 = 1;
/// That of the first line.
const FRAME: Frame = Frame(["{\"sum\":\"", "\",\"checkpoint\":", "}"]);

/// The head, which comes before the state.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Head {
    layout: u32,
    program: Program,
    id: CaseId,
    simd: SimdPath,
}

impl Head {
    /// The line before a state.
    fn line(&self, state: &[u8]) -> String {
        let head = serde_json::to_string(self).expect("plain data has a JSON form");
        FRAME.around(&head, state) + "\n"
    }
}

/// The checkpoint of a case or of a trunk, which may exist or not.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    directory: PathBuf,
    path: PathBuf,
    id: CaseId,
    simd: SimdPath,
}

impl Checkpoint {
    /// That of a case in an output directory, run with this instruction set.
    pub fn of_case(directory: &Path, id: CaseId, simd: SimdPath) -> Checkpoint {
        Checkpoint::of(directory, id, CASE, simd)
    }

    /// That of a trunk.
    pub fn of_trunk(directory: &Path, id: CaseId, simd: SimdPath) -> Checkpoint {
        Checkpoint::of(directory, id, TRUNK, simd)
    }

    pub(super) fn of(directory: &Path, id: CaseId, ending: &str, simd: SimdPath) -> Checkpoint {
        let path = directory.join(FOLDER).join(format!("{id}.{ending}"));
        Checkpoint { directory: directory.to_owned(), path, id, simd }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Replaces it by this state and waits until that is on the disk. A rank that does not see the
    /// sweep's directory writes nothing.
    pub fn write(&self, state: &[u8]) -> Result<(), SweepError> {
        if !self.directory.join(JOURNAL).is_file() {
            return Ok(());
        }
        let folder = self.directory.join(FOLDER);
        if !folder.is_dir() {
            disk::create_folder_in(&folder).map_err(SweepError::io(&folder))?;
        }
        let head = Head { layout: LAYOUT, program: Program::this(), id: self.id, simd: self.simd };
        let head = head.line(state);
        atomic_file::write_with(&self.path, |file| {
            let written = disk::write(file, head.as_bytes());
            let written = written.and_then(|()| disk::write(file, state));
            written.map_err(SweepError::io(&self.path))
        })
    }

    /// Its state; `None` if there is none.
    ///
    /// # Errors
    /// Why it cannot be used, in words that follow its name.
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

/// The head of a complete file, and the start of its state; `None` if anything is damaged.
pub(super) fn whole(bytes: &[u8]) -> Option<(Head, usize)> {
    let end = bytes.iter().position(|&byte| byte == b'\n')?;
    let head = FRAME.text(&bytes[..end], &bytes[end + 1..])?;
    Some((serde_json::from_slice(head).ok()?, end + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoint(root: &Path) -> Checkpoint {
        Checkpoint::of_case(root, "00000000000000ab".parse().unwrap(), SimdPath::Portable)
    }

    #[test]
    fn another_builds_and_another_cases_are_not_gone_on_from() {
        let root = tempfile::tempdir().unwrap();
        let kept = checkpoint(root.path());
        fs::write(root.path().join(JOURNAL), "").unwrap();
        kept.write(b"state").unwrap();
        let bytes = fs::read(kept.path()).unwrap();
        let program = Program { sources: "0123456789abcdef".to_owned(), ..Program::this() };
        let head = Head { layout: LAYOUT, program, id: kept.id, simd: kept.simd };
        fs::write(kept.path(), head.line(b"state") + "state").unwrap();
        assert!(kept.read().unwrap_err().starts_with("was written by another build, "));
        assert!(whole(&fs::read(kept.path()).unwrap()).is_some());
        let other = Checkpoint { id: "00000000000000ac".parse().unwrap(), ..kept.clone() };
        fs::write(kept.path(), bytes).unwrap();
        assert!(other.read().unwrap_err().contains("another case"));
        let other = Checkpoint { simd: SimdPath::Avx2, ..kept };
        assert!(other.read().unwrap_err().contains("another case"));
    }
}
