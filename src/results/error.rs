//! What can go wrong with a sweep as a whole; a failing case is not among it.

use std::path::{Path, PathBuf};

/// An error that ends a sweep.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The request cannot be carried out as it stands: bad usage, a foreign or damaged directory.
    #[error("{0}")]
    Refused(String),
    /// The system failed to read or write a file.
    #[error("{}: {error}", path.display())]
    Io { path: PathBuf, error: std::io::Error },
    /// The machinery between ranks failed.
    #[error("{0}")]
    Executor(String),
}

impl SweepError {
    /// A refusal that concerns a file or directory.
    pub fn refused(path: &Path, reason: impl std::fmt::Display) -> SweepError {
        SweepError::Refused(format!("{}: {reason}", path.display()))
    }

    /// Wraps a system error with the file that it concerns.
    pub fn io(path: &Path) -> impl FnOnce(std::io::Error) -> SweepError + '_ {
        move |error| SweepError::Io { path: path.to_owned(), error }
    }

    /// Whether the user asked for something that cannot be (exit code 2) rather than the program
    /// or the machine failing (70).
    pub fn is_refusal(&self) -> bool {
        matches!(self, SweepError::Refused(_))
    }
}
