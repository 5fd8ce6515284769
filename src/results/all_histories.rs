//! `histories.csv.gz`: the histories of all cases in one table, for readers of a whole study.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use flate2::{Compression, GzBuilder};

use super::error::SweepError;
use super::{atomic_file, files};
use crate::disk::Writer;
use crate::disk::names::{ALL_HISTORIES, SUMMARY};
use crate::quantities::summary::CASE_ID;

/// Joins the histories of a directory in one table: `case_id`, and the columns of the single files
/// with the same numbers, text for text, in the order of the summary. The same files give the same
/// bytes. Returns the path, or `None` if no case has a history.
///
/// # Errors
/// A file that cannot be read or written, or histories with different columns.
pub fn write_all_histories(directory: &Path) -> Result<Option<PathBuf>, SweepError> {
    write_sound_histories(directory, &|_| false, &|_, _| false)
}

/// The same without some cases. A history that turns out to be wrong is an error, unless `spare`
/// allows to leave it out too.
///
/// # Errors
/// The same.
pub fn write_sound_histories(
    directory: &Path,
    is_left_out: &dyn Fn(&Path) -> bool,
    spare: &dyn Fn(&Path, &SweepError) -> bool,
) -> Result<Option<PathBuf>, SweepError> {
    let ids = ids(&directory.join(SUMMARY))?.into_iter();
    let cases = ids.map(|id| (files::history_path(directory, &id), id));
    let cases: Vec<_> = cases.filter(|(path, _)| path.is_file() && !is_left_out(path)).collect();
    let path = directory.join(ALL_HISTORIES);
    if cases.is_empty() {
        return Ok(None);
    }
    atomic_file::write_with(&path, |file| write(file, &path, &cases, spare))?;
    Ok(Some(path))
}

/// The cases of a summary.
fn ids(summary: &Path) -> Result<Vec<String>, SweepError> {
    let wrong = |error: csv::Error| SweepError::io(summary)(error.into());
    let mut reader = csv::Reader::from_path(summary).map_err(wrong)?;
    let place = reader.headers().map_err(wrong)?.iter().position(|name| name == CASE_ID.name);
    let missing = || SweepError::refused(summary, format_args!("no column {}", CASE_ID.name));
    let place = place.ok_or_else(missing)?;
    let cell = |row: csv::StringRecord| row.get(place).unwrap_or_default().to_owned();
    reader.records().map(|row| row.map(cell).map_err(wrong)).collect()
}

fn write(
    file: &File,
    path: &Path,
    cases: &[(PathBuf, String)],
    spare: &dyn Fn(&Path, &SweepError) -> bool,
) -> Result<(), SweepError> {
    // No time stamp and no name in its head. Slower levels save a twentieth.
    let mut table = GzBuilder::new().write(BufWriter::new(Writer(file)), Compression::fast());
    let mut columns: Option<String> = None;
    for (from, id) in cases {
        let text = match history(from, columns.as_deref()) {
            Ok(text) => text,
            Err(error) if spare(from, &error) => continue,
            Err(error) => return Err(error),
        };
        let (header, rows) = text.split_once('\n').unwrap_or((&text, ""));
        let mut lines = String::with_capacity(2 * text.len());
        if columns.is_none() {
            lines = format!("{},{header}\n", CASE_ID.name);
            columns = Some(header.to_owned());
        }
        for row in rows.lines() {
            lines.extend([id, ",", row, "\n"]);
        }
        table.write_all(lines.as_bytes()).map_err(SweepError::io(path))?;
    }
    let mut rest = table.finish().map_err(SweepError::io(path))?;
    rest.flush().map_err(SweepError::io(path))
}

/// The text of a history, which must have the columns of those before it.
fn history(from: &Path, columns: Option<&str>) -> Result<String, SweepError> {
    let text = fs::read_to_string(from).map_err(SweepError::io(from))?;
    match text.lines().next() {
        None => Err(SweepError::refused(from, "is empty")),
        Some(header) if columns.is_some_and(|columns| columns != header) => {
            Err(SweepError::refused(from, "has other columns than the histories before it"))
        }
        Some(_) => Ok(text),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::GzDecoder;

    use super::*;

    fn directory(histories: &[(&str, &str)]) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        let summary = "status,case_id\nok,b\nfailed,c\nok,a\n";
        fs::write(root.path().join("summary.csv"), summary).unwrap();
        fs::create_dir(root.path().join("histories")).unwrap();
        for (id, text) in histories {
            fs::write(root.path().join(format!("histories/{id}.csv")), text).unwrap();
        }
        root
    }

    #[test]
    fn all_histories_are_one_table_in_the_order_of_the_summary() {
        let root = directory(&[("a", "time_s,force\n0,1\n"), ("b", "time_s,force\n0,2\n1e-7,3\n")]);
        let path = write_all_histories(root.path()).unwrap().unwrap();
        let first = fs::read(&path).unwrap();
        let mut text = String::new();
        GzDecoder::new(&first[..]).read_to_string(&mut text).unwrap();
        assert_eq!(text, "case_id,time_s,force\nb,0,2\nb,1e-7,3\na,0,1\n");
        assert_eq!(first[4..8], [0; 4], "no time stamp");
        std::thread::sleep(std::time::Duration::from_millis(1100));
        write_all_histories(root.path()).unwrap();
        assert_eq!(fs::read(&path).unwrap(), first);
        let names = fs::read_dir(root.path()).unwrap().count();
        assert_eq!(names, 3, "nothing is left half written");
    }

    #[test]
    fn what_does_not_fit_together_is_told_and_leaves_the_old_table() {
        assert_eq!(write_all_histories(directory(&[]).path()).unwrap(), None);
        let root = directory(&[("a", "time_s,level\n0,1\n"), ("b", "time_s,force\n0,2\n")]);
        fs::write(root.path().join(ALL_HISTORIES), "old").unwrap();
        let told = write_all_histories(root.path()).unwrap_err().to_string();
        assert!(told.ends_with("a.csv: has other columns than the histories before it"), "{told}");
        assert_eq!(fs::read(root.path().join(ALL_HISTORIES)).unwrap(), b"old");
        let spare = |path: &Path, _: &SweepError| path.ends_with("a.csv");
        write_sound_histories(root.path(), &|_| false, &spare).unwrap();
        assert_ne!(fs::read(root.path().join(ALL_HISTORIES)).unwrap(), b"old");
        fs::write(root.path().join("summary.csv"), "case\na\n").unwrap();
        let told = write_all_histories(root.path()).unwrap_err().to_string();
        assert!(told.ends_with("summary.csv: no column case_id"), "{told}");
    }
}
