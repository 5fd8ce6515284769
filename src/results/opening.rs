//! Opens an output directory: its contents, whether they fit, and their damage.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::entries::{Content, Header};
use super::error::SweepError;
use super::journal::header_of;
use super::lock::{self, Lock};
use super::manifest::Manifest;
use super::other_sweep::difference;
use super::{atomic_file, files};
use crate::disk;
use crate::disk::names::JOURNAL;
use crate::math::name::name_of;
use crate::math::simd::SimdPath;
use crate::math::words::counted;
use crate::study::Study;

/// How to open a directory that has contents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpenMode {
    /// Go on with this sweep's results.
    Resume,
    /// Move them aside and start again.
    Fresh,
}

/// The contents found on opening.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Opened {
    /// Nothing: a new sweep starts.
    New,
    /// Empty now: an old directory was moved here.
    Moved(PathBuf),
    /// This many finished cases of this sweep.
    Resumed(usize),
}

/// The contents of a path. Anything else belongs to another program.
#[derive(Debug, PartialEq)]
pub(super) enum Found {
    Nothing,
    /// A journal, with the time of its start, if the system provides it, and the identity of its
    /// directory. Both distinguish a new one from an old one.
    Journal(Option<SystemTime>, [u64; 2]),
    /// A study whose journal was deleted.
    Remains,
}

pub(super) fn look(path: &Path) -> Result<Found, SweepError> {
    if !path.exists() {
        return Ok(Found::Nothing);
    }
    let journal = path.join(JOURNAL);
    if journal.is_file() {
        let created = fs::metadata(&journal).and_then(|file| file.created()).ok();
        let directory = fs::metadata(path).map_err(|error| SweepError::unusable(path, &error))?;
        return Ok(Found::Journal(created, atomic_file::identity(&directory)));
    }
    if Manifest::read(path).is_some() && !journal.is_file() {
        return Ok(Found::Remains);
    }
    let entries = fs::read_dir(path).map_err(|error| SweepError::unusable(path, &error))?;
    for entry in entries {
        let entry = entry.map_err(SweepError::io(path))?;
        if entry.file_name() != lock::FILE_NAME {
            if journal.is_file() {
                // Another process has started meanwhile.
                return look(path);
            }
            let reason = "is not empty and holds no journal; choose another --out";
            return Err(SweepError::refused(path, reason));
        }
    }
    Ok(Found::Nothing)
}

/// Refuses to go on without a journal, because existing files would be overwritten.
pub(super) fn refuse_remains(path: &Path, mode: OpenMode, found: &Found) -> Result<(), SweepError> {
    if mode == OpenMode::Fresh || *found != Found::Remains {
        return Ok(());
    }
    let reason = "journal.jsonl is missing, though a study's other files lie here; restore it from a copy, or \
                  start over with --fresh";
    Err(SweepError::refused(path, reason))
}

/// While this process waited for the lock, another may have started again.
pub(super) fn demand_same(path: &Path, before: &Found) -> Result<(), SweepError> {
    if look(path)? == *before {
        return Ok(());
    }
    Err(SweepError::refused(path, "another process has just started over here"))
}

/// The journal's header. If its line is lost, it comes from the manifest. `new` is the instruction
/// set of a study without finished work.
pub(super) fn header(
    path: &Path,
    content: &Content<impl Sized>,
    study: &Study,
    new: SimdPath,
) -> Result<Header, SweepError> {
    if let Some(header) = &content.header {
        return Ok(header.clone());
    }
    let told = header_of(path)?.filter(|told| told.sweep == study.identity).map(|told| told.simd);
    let simd = if content.found > 0 {
        told
    } else {
        // Stopped before any work was done.
        (!files::any(path)).then(|| told.unwrap_or(new))
    };
    let lost = "journal.jsonl has lost its beginning, though results lie beside it; restore it from a \
                copy, or start over with --fresh";
    let simd = simd.ok_or_else(|| SweepError::refused(path, lost))?;
    Ok(Header::new(&study.name, &study.identity, study.cases.len(), simd))
}

/// The damage of a journal's lines. `mends` is whether it is repaired now.
pub(super) fn told_damage(content: &Content<impl Sized>, mends: bool) -> Option<String> {
    let lines = (content.damaged > 0).then(|| counted(content.damaged, "damaged line"));
    let aside = if mends { ", set aside in journal.damaged" } else { "" };
    let told = lines.map(|lines| format!("{lines}{aside}"));
    let headless = content.header.is_none() && content.found > 0;
    let told = told.or_else(|| headless.then(|| "its first line was lost".to_owned()))?;
    let when = if mends { "" } else { " at the next start" };
    Some(format!("journal.jsonl: {told}; what they held runs again{when}"))
}

/// Refuses an instruction set that not all ranks have.
pub(super) fn check_request(
    requested: Option<SimdPath>,
    widest: SimdPath,
) -> Result<(), SweepError> {
    let Some(simd) = requested.filter(|&simd| simd > widest) else { return Ok(()) };
    let (simd, widest) = (name_of(simd), name_of(widest));
    let reason = format!("--simd {simd}: not every rank has it; the widest is {widest}");
    Err(SweepError::Refused(reason))
}

pub(super) fn check_header(
    path: &Path,
    header: &Header,
    study: &Study,
    requested: Option<SimdPath>,
    widest: SimdPath,
) -> Result<(), SweepError> {
    if header.sweep != study.identity {
        let cases = counted(header.cases, "case");
        let why = difference(path, study).map(|why| format!(": {why}")).unwrap_or_default();
        let reason = format!(
            "holds another sweep (\"{}\", {cases}){why}; choose another --out, or --fresh to move it \
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

/// Moves a directory aside and replaces it by an empty one, which is locked from the start. If the
/// system can do so, the name always has a directory. Otherwise another process could take it for a
/// new one.
pub(super) fn replace(path: &Path) -> Result<(PathBuf, Lock), SweepError> {
    if path.is_symlink() {
        // A link stays, and leads to the new directory: it may be on a disk with more space.
        return replace(&fs::canonicalize(path).map_err(SweepError::io(path))?);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let new = path.with_file_name(format!("{name}.new-{}", std::process::id()));
    disk::create_folder(&new).map_err(SweepError::io(&new))?;
    let lock = Lock::hold(&new)?;
    let aside = if disk::exchange(&new, path) {
        move_aside(path, &new).inspect_err(|_| {
            // Back to the old state. If this fails too, the old one keeps the other name.
            let _ = disk::exchange(&new, path);
        })?
    } else {
        let aside = move_aside(path, path)?;
        disk::rename(&new, path).map_err(SweepError::io(path))?;
        aside
    };
    Ok((aside, lock))
}

/// Gives a directory that was at `path`, and is at `now`, a name of its own.
fn move_aside(path: &Path, now: &Path) -> Result<PathBuf, SweepError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let free = (1..).map(|number| path.with_file_name(format!("{name}.old-{number}")));
    let aside = free.into_iter().find(|aside| !aside.exists()).expect("numbers do not end");
    disk::rename(now, &aside).map_err(SweepError::io(path))?;
    Ok(aside)
}
