//! A measured record, as loggers and spreadsheets write it.

use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::quantities::history;
use crate::report::error::ReportError;
use crate::report::load::demand;
use crate::report::series::{Series, series_of};

/// The columns of a record, each over its own times. Spaces beside commas are nothing.
///
/// # Errors
/// A file that cannot be read, has no times, has no commas, or has two columns of one name.
pub(super) fn read(path: &Path) -> Result<Vec<Series>, ReportError> {
    let wrong = |source| ReportError::Table { path: path.to_owned(), source };
    let text =
        std::fs::read(path).map_err(|error| ReportError::Read { path: path.to_owned(), error })?;
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(text.as_slice());
    let header = reader.headers().map_err(wrong)?.clone();
    if let Some(reason) = unfit(&header) {
        return Err(ReportError::Record { path: path.to_owned(), reason });
    }
    demand(path, &header, [history::TIME.name].into_iter())?;
    let records = reader.records().map(|record| record.map_err(wrong));
    let records = records.collect::<Result<Vec<_>, _>>()?;
    Ok(series_of(path, &header, &records)?.0)
}

/// What is wrong with a first line.
fn unfit(header: &StringRecord) -> Option<String> {
    if header.len() == 1 && header[0].contains([';', '\t']) {
        let has = &header[0];
        return Some(format!(
            "must have commas between its columns and points in its numbers; its first line is {has:?}"
        ));
    }
    let mut names = header.iter().enumerate().filter(|(_, name)| !name.is_empty());
    let (_, twice) = names.find(|(at, name)| header.iter().take(*at).any(|one| one == *name))?;
    Some(format!("has two columns {twice}: name each once"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Vec<Series>, String> {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("gauges.csv");
        std::fs::write(&path, text).unwrap();
        read(&path).map_err(|error| error.to_string())
    }

    /// The story: of "time_s, WG1" the command said that the case had no column " WG1". Strokes
    /// took such lines.
    #[test]
    fn spaces_beside_commas_are_nothing() {
        let columns = of("time_s, WG1, P1\n0, 0.1 ,\n0.1,0.2, 7\n").unwrap();
        assert_eq!(columns[0].name, "WG1");
        assert_eq!(columns[0].points, [(0.0, 0.1), (0.1, 0.2)]);
        assert_eq!(columns[1].points, [(0.1, 7.0)]);
    }

    /// The story: a table with semicolons was "found record with 8 fields, but the previous record
    /// has 1 fields". Of two columns of one name both were held against the gauge.
    #[test]
    fn first_lines_that_do_not_fit_are_told_plainly() {
        let told = of("time_s;WG1\n0,5;0,1\n").unwrap_err();
        assert!(
            told.contains("must have commas between") && told.contains("\"time_s;WG1\""),
            "{told}"
        );
        assert!(of("time_s\tWG1\n0\t1\n").unwrap_err().contains("must have commas"));
        let told = of("time_s,WG1,WG1\n0,1,2\n").unwrap_err();
        assert!(told.ends_with("gauges.csv: has two columns WG1: name each once"), "{told}");
        assert!(of("time_s,WG1,,\n0,1,,\n").is_ok(), "a spreadsheet's empty columns");
        assert!(of("t,WG1\n0,1\n").unwrap_err().contains("no column \"time_s\""));
        let told = of("time_s,WG1\n0,1\n1,n.a.\n").unwrap_err();
        assert!(told.contains("line 3") && told.contains("WG1"), "{told}");
    }
}
