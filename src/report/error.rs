//! What can go wrong between an output directory and its report.

use std::path::PathBuf;

use crate::keys::named;
use crate::math::words::in_words;

/// Why a report could not be written.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A file could not be read.
    #[error("cannot read {}: {}", named(path), in_words(error))]
    Read { path: PathBuf, error: std::io::Error },
    /// A file or folder could not be written.
    #[error("cannot write {}: {}", named(path), in_words(error))]
    Write { path: PathBuf, error: std::io::Error },
    /// A table lacks a column that the report needs.
    #[error("{}: no column {column:?}", named(path))]
    MissingColumn { path: PathBuf, column: &'static str },
    /// A table is not well formed.
    #[error("{}: {source}", named(path))]
    Table { path: PathBuf, source: csv::Error },
    /// A cell holds something that is not what its column holds.
    #[error("{}, line {line}, column {column:?}: {reason}", named(path))]
    Cell { path: PathBuf, line: u64, column: String, reason: String },
    /// A figure could not be drawn: a fault of the program, not of the data.
    #[error("cannot draw {figure}: {reason}")]
    Draw { figure: String, reason: String },
}

impl ReportError {
    /// Whether a table is not what it should be, rather than the program or the machine failing.
    pub fn is_of_the_files(&self) -> bool {
        match self {
            ReportError::MissingColumn { .. } | ReportError::Cell { .. } => true,
            ReportError::Table { source, .. } => !source.is_io_error(),
            _ => false,
        }
    }
}
