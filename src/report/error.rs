//! What can go wrong between an output directory and its report.

use std::path::{Path, PathBuf};

use crate::disk::names::{JOURNAL, SUMMARY};
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
    #[error("{}: no column {column:?}{}", named(path), remedy(path))]
    MissingColumn { path: PathBuf, column: &'static str },
    /// A table is not well formed.
    #[error("{}: {}{}", named(path), table_in_words(source), remedy(path))]
    Table { path: PathBuf, source: csv::Error },
    /// A cell holds something that its column does not take.
    #[error("{}, line {line}, column {column:?}: {reason}{}", named(path), remedy(path))]
    Cell { path: PathBuf, line: u64, column: String, reason: String },
    /// A measured record cannot be held against a case.
    #[error("{}: {reason}", named(path))]
    Record { path: PathBuf, reason: String },
    /// A figure could not be drawn: a fault of the program, not of the data.
    #[error("cannot draw {figure}: {reason}")]
    Draw { figure: String, reason: String },
}

/// What mends a summary: a study's journal has all of it.
fn remedy(path: &Path) -> String {
    let directory = path.parent().filter(|_| path.ends_with(SUMMARY));
    let directory = directory.filter(|directory| directory.join(JOURNAL).is_file());
    directory.map_or_else(String::new, |directory| {
        let directory = named(directory);
        format!(": the file is damaged; `seawall report {directory}` makes it again")
    })
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
