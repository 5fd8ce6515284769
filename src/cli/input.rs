//! Reading what the user wrote.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use clap::ValueEnum;

use super::failure::{BadFile, BadInput};
use super::picked_case::the_case;
use crate::disk::names::{JOURNAL, MANIFEST};
use crate::keys::{bytes_of, named};
use crate::math::simd::SimdPath;
use crate::math::words::in_words;
use crate::scene::ConfigError;
use crate::study::{Override, Study, SweepFile};

/// The user's choice of instruction set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SimdChoice {
    /// The widest that every rank has; on resuming, what the sweep began with.
    Auto,
    /// 512-bit vectors.
    Avx512,
    /// 256-bit vectors.
    Avx2,
    /// Plain Rust.
    Portable,
}

impl SimdChoice {
    pub(super) fn path(self) -> Option<SimdPath> {
        match self {
            SimdChoice::Auto => None,
            SimdChoice::Avx512 => Some(SimdPath::Avx512),
            SimdChoice::Avx2 => Some(SimdPath::Avx2),
            SimdChoice::Portable => Some(SimdPath::Portable),
        }
    }
}

/// A `--set` argument, checked and as written.
#[derive(Debug, Clone)]
pub(super) struct Setting {
    pub(super) text: String,
    pub(super) set: Override,
}

impl std::str::FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Setting, String> {
        Ok(Setting { text: text.to_owned(), set: text.parse()? })
    }
}

/// How many scenes a command takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Expect {
    /// A file with a `[grid]`.
    Grid,
    Either,
}

/// What has come through a pipe, which can be read only once.
static PIPED: Mutex<Option<(PathBuf, Vec<u8>)>> = Mutex::new(None);

/// The bytes of a file, or of a pipe, however often they are asked for.
fn bytes(path: &Path) -> std::io::Result<Vec<u8>> {
    if !path.exists() || path.is_file() || path.is_dir() {
        return bytes_of(path);
    }
    let mut piped = PIPED.lock().unwrap_or_else(PoisonError::into_inner);
    match &*piped {
        Some((known, bytes)) if known == path => Ok(bytes.clone()),
        _ => {
            let bytes = bytes_of(path)?;
            *piped = Some((path.to_owned(), bytes.clone()));
            Ok(bytes)
        }
    }
}

/// The kind of file that a command asks for, in the words of its error messages.
#[derive(Debug, Clone, Copy)]
pub(super) struct FileKind {
    file: &'static str,
    help: &'static str,
}

impl FileKind {
    /// What to give.
    pub(super) fn advice(self) -> String {
        format!("give {}{}", self.file, self.help)
    }
}

/// A sweep or scene file.
pub(super) const STUDY: FileKind =
    FileKind { file: "a sweep or scene file", help: " (`seawall init NAME` writes one)" };
/// What `accuracy` and `stress` take.
pub(super) const MATRIX: FileKind =
    FileKind { file: "a file of cases and methods", help: ", or none: one is built in" };

/// The text of a file.
pub(super) fn read(path: &Path, wanted: FileKind) -> Result<String, BadInput> {
    let bytes = bytes(path).map_err(|error| unreadable(path, &error, wanted))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        BadInput::of(path, format_args!("line {line}: is not UTF-8 text; save it as UTF-8"))
    })
}

/// Why a file cannot be read, and what would be one.
fn unreadable(path: &Path, error: &std::io::Error, wanted: FileKind) -> BadInput {
    let reason = if path.join(MANIFEST).is_file() {
        let told = named(path);
        format!("is the output directory of a study; `seawall status {told}` tells how it fares")
    } else if path.is_dir() {
        let such = named(&path.join("NAME.toml"));
        format!("is a directory; give {}, such as {such}", wanted.file)
    } else {
        format!("{}; {}", in_words(error), wanted.advice())
    };
    BadInput::of(path, reason)
}

/// Refuses a directory that does not hold a file which every output directory of a study has.
pub(super) fn demand_output_of_study(directory: &Path, holds: &str) -> Result<(), BadInput> {
    let reason = if directory.join(holds).is_file() {
        return Ok(());
    } else if !directory.exists() {
        "no such directory; give the output directory of a study, such as results/runs/NAME"
            .to_owned()
    } else if directory.is_file() {
        "is a file; give the output directory of a study, such as results/runs/NAME".to_owned()
    } else if directory.join(JOURNAL).is_file() {
        format!("has no {holds}; `seawall sweep` or `run` of the same file makes it")
    } else {
        format!("holds no {holds}: not the output directory of a study")
    };
    Err(BadInput::of(directory, reason))
}

/// A sweep or scene file with the command line's values.
pub(super) fn sweep_file(path: &Path, settings: &[Setting]) -> anyhow::Result<SweepFile> {
    let text = read(path, STUDY)?;
    let overrides: Vec<_> = settings.iter().map(|setting| setting.set.clone()).collect();
    Ok(SweepFile::read(&text, &overrides).map_err(blame(path, settings))?)
}

/// An error names the file, and `--set` where that gave the value.
fn blame<'a>(path: &'a Path, settings: &'a [Setting]) -> impl Fn(ConfigError) -> BadFile + 'a {
    BadFile::unless_set(path, |key| {
        settings.iter().any(|setting| {
            let rest = key.strip_prefix(&setting.set.path());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        })
    })
}

pub(super) fn study(path: &Path, settings: &[Setting], expect: Expect) -> anyhow::Result<Study> {
    let file = sweep_file(path, settings)?;
    if expect == Expect::Grid {
        file.require_grid().map_err(BadFile::of(path))?;
    }
    whole(path, &file, settings)
}

/// The study of a file that a user has written.
fn whole(path: &Path, file: &SweepFile, settings: &[Setting]) -> anyhow::Result<Study> {
    let study = Study::new(file).map_err(blame(path, settings))?;
    study.refuse_unread_axis().map_err(blame(path, settings))?;
    Ok(study)
}

/// The study of a single scene: of a file without a grid, or of the case of a sweep file that the
/// words name; one that has a single case needs no words. Besides, the settings that are not yet in its file.
pub(super) fn scene<'a>(
    path: &Path,
    settings: &'a [Setting],
    words: &[String],
) -> anyhow::Result<(Study, &'a [Setting])> {
    let file = sweep_file(path, settings)?;
    if words.is_empty() && file.grid.is_empty() {
        return Ok((Study::new(&file).map_err(blame(path, settings))?, settings));
    }
    let whole = whole(path, &file, settings)?;
    if words.is_empty() && whole.cases.len() > 1 {
        file.refuse_grid().map_err(BadFile::of(path))?;
    }
    let case = the_case(&whole, words)?;
    let single = file.single(case).and_then(|text| SweepFile::read(&text, &[]));
    Ok((single.and_then(|file| Study::new(&file)).map_err(BadFile::of(path))?, &[]))
}

/// The default output directory of a study.
pub(super) fn default_out(study: &Study) -> PathBuf {
    named_out(&study.name)
}

/// That of a sweep file's study, without its cases; none where the file cannot be read.
pub(super) fn out_of(path: &Path, settings: &[Setting]) -> Option<PathBuf> {
    sweep_file(path, settings).ok().map(|file| named_out(&file.name))
}

pub(super) fn named_out(name: &str) -> PathBuf {
    Path::new("results").join("runs").join(name)
}
