//! Reading what the user wrote.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::failure::BadInput;
use crate::math::simd::SimdPath;
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
    /// A file without one.
    SingleScene,
    Either,
}

pub(super) fn read(path: &Path) -> Result<String, BadInput> {
    let bytes =
        std::fs::read(path).map_err(|error| BadInput(format!("{}: {error}", path.display())))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        BadInput(format!("{}: line {line}: is not UTF-8 text; save it as UTF-8", path.display()))
    })
}

pub(super) fn study(path: &Path, settings: &[Setting], expect: Expect) -> anyhow::Result<Study> {
    let bad = |reason: &dyn std::fmt::Display| BadInput(format!("{}: {reason}", path.display()));
    let text = read(path)?;
    let overrides: Vec<_> = settings.iter().map(|setting| setting.set.clone()).collect();
    let study = || -> Result<Study, ConfigError> {
        let file = SweepFile::read(&text, &overrides)?;
        match expect {
            Expect::Grid => file.require_grid()?,
            Expect::SingleScene => file.refuse_grid()?,
            Expect::Either => {}
        }
        Study::new(&file)
    };
    Ok(study().map_err(|error| bad(&error))?)
}

/// The default output directory of a study.
pub(super) fn default_out(study: &Study) -> PathBuf {
    Path::new("results").join("runs").join(&study.name)
}
