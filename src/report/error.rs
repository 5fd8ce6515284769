//! What can go wrong between an output directory and its report.

use std::path::PathBuf;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file or folder could not be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A table lacks a column that the report needs.
    #[error("{}: no column {column:?}", path.display())]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// The column.
        column: &'static str,
    },
    /// A table is not well formed.
    #[error("{}: {source}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// Position and kind, as the reader tells it.
        source: csv::Error,
    },
    /// A cell holds something that is not what its column holds.
    #[error("{}, line {line}, column {column:?}: {reason}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// Line in the file.
        line: u64,
        /// Name of the column.
        column: String,
        /// What the reader expected.
        reason: String,
    },
    /// `manifest.json` is not JSON.
    #[error("{}: {source}", path.display())]
    Manifest {
        /// The file.
        path: PathBuf,
        /// Position and kind, as the reader tells it.
        source: serde_json::Error,
    },
    /// A figure could not be drawn: a fault of the program, not of the data.
    #[error("cannot draw {figure}: {reason}")]
    Draw {
        /// Name of the figure.
        figure: String,
        /// What the drawing library says.
        reason: String,
    },
}
