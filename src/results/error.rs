//! Errors of a sweep as a whole. A failing case is not one of them.

use std::path::{Path, PathBuf};

use crate::keys::named;
use crate::math::words::in_words;

/// An error that ends a sweep.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The request is not possible: bad usage, or the directory of another sweep or a damaged one.
    #[error("{0}")]
    Refused(String),
    /// The system failed to read or write a file.
    #[error("{}: {}", named(path), in_words(error))]
    Io { path: PathBuf, error: std::io::Error },
    /// The machinery between ranks failed.
    #[error("{0}")]
    Executor(String),
}

impl SweepError {
    /// A refusal because of a file or directory.
    pub fn refused(path: &Path, reason: impl std::fmt::Display) -> SweepError {
        SweepError::Refused(format!("{}: {reason}", named(path)))
    }

    /// An output directory in which nothing can be written.
    pub fn unusable(path: &Path, error: &std::io::Error) -> SweepError {
        let path_told = named(path);
        let reason = match path.ancestors().find(|part| part.is_file()) {
            Some(file) if file == path => "is a file".to_owned(),
            Some(file) => format!("{} is a file", named(file)),
            None => format!("nothing can be written there ({})", in_words(error)),
        };
        SweepError::Refused(format!(
            "--out {path_told}: {reason}; give a directory, a new one or that of an earlier run"
        ))
    }

    /// Wraps a system error with the file that it concerns.
    pub fn io(path: &Path) -> impl Fn(std::io::Error) -> SweepError + '_ {
        move |error| SweepError::Io { path: path.to_owned(), error }
    }

    /// Whether the user asked for something impossible (exit code 2). Otherwise the program or the
    /// machine failed (70).
    pub fn is_refusal(&self) -> bool {
        matches!(self, SweepError::Refused(_))
    }
}
