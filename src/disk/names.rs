//! The names of what an output directory holds, as far as more than one module knows of it.

use std::path::{Path, PathBuf};

/// The truth: a line for each case that has ended.
pub(crate) const JOURNAL: &str = "journal.jsonl";
/// Where the results come from.
pub(crate) const MANIFEST: &str = "manifest.json";
pub(crate) const SUMMARY: &str = "summary.csv";
pub(crate) const ENERGY: &str = "energy.csv";
pub(crate) const ALL_HISTORIES: &str = "histories.csv.gz";
/// The numerics that `--max-error` chose.
pub(crate) const MAX_ERROR: &str = "max_error.csv";
/// The table of `seawall accuracy`.
pub(crate) const ACCURACY: &str = "accuracy.csv";
pub(crate) const PAGE: &str = "report.html";

pub(crate) const HISTORIES: &str = "histories";
pub(crate) const PROBES: &str = "probes";
pub(crate) const READINGS: &str = "readings";
pub(crate) const ENVELOPES: &str = "envelopes";
pub(crate) const WAVES: &str = "waves";
/// The folders with a table for each case, that of histories first.
pub(crate) const CASE_FOLDERS: [&str; 5] = [HISTORIES, PROBES, READINGS, ENVELOPES, WAVES];
/// What the columns of probes are.
pub(crate) const PROBE_COLUMNS: &str = "probes/columns.csv";

pub(crate) const FIGURES: &str = "figures";
pub(crate) const TABLES: &str = "tables";
pub(crate) const FILMS: &str = "films";
/// How the name of a film's page ends, and those of its stills: of the largest force, of the highest
/// runup and of the largest displacement.
pub(crate) const FILM_PAGE: &str = ".html";
pub(crate) const STILL: &str = ".svg";
pub(crate) const HIGHEST: &str = "-highest.svg";
pub(crate) const FURTHEST: &str = "-furthest.svg";
/// All that a case's film may have, the page last.
pub(crate) const FILM_FILES: [&str; 4] = [FURTHEST, HIGHEST, STILL, FILM_PAGE];
/// Films for ParaView.
pub(crate) const VTK: &str = "vtk";
/// Why cases were filmed, and the two of these reasons by which the page picks stills.
pub(crate) const REASONS: &str = "films/reasons.csv";
pub(crate) const LARGEST_FORCE: &str = "largest force";
pub(crate) const HIGHEST_RUNUP: &str = "highest runup";

/// The path of a file of a case's film, in the folder of films.
pub(crate) fn film_file(folder: &Path, id: impl std::fmt::Display, ending: &str) -> PathBuf {
    folder.join(format!("{id}{ending}"))
}

/// The path of a case's table in one of its folders.
pub(crate) fn of_case(directory: &Path, folder: &str, id: impl std::fmt::Display) -> PathBuf {
    directory.join(folder).join(case_file(id))
}

/// The name of a case's table in any folder.
pub(crate) fn case_file(id: impl std::fmt::Display) -> String {
    format!("{id}.csv")
}
