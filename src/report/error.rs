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
    #[error("{}: {}", named(path), table_in_words(source))]
    Table { path: PathBuf, source: csv::Error },
    /// A cell holds something that its column does not take.
    #[error("{}, line {line}, column {column:?}: {reason}", named(path))]
    Cell { path: PathBuf, line: u64, column: String, reason: String },
    /// A figure could not be drawn: a fault of the program, not of the data.
    #[error("cannot draw {figure}: {reason}")]
    Draw { figure: String, reason: String },
}

fn table_in_words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Io(error) => in_words(error),
        _ => error.to_string(),
    }
}

impl ReportError {
    /// Whether a table is at fault, rather than the program or the machine.
    pub fn is_of_the_files(&self) -> bool {
        match self {
            ReportError::MissingColumn { .. } | ReportError::Cell { .. } => true,
            ReportError::Table { source, .. } => !source.is_io_error(),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_that_cannot_be_opened_is_told_plainly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().to_owned();
        let source = csv::Reader::from_path(&path).unwrap().headers().unwrap_err();
        let told = ReportError::Table { path, source }.to_string();
        assert!(told.ends_with(": a directory stands in the place of this file"), "{told}");
    }
}
