//! The report of a sweep: tables, figures and one page, from the files of an output directory
//! alone. It knows nothing of solvers, so that any figure can be drawn again without simulating.
//!
//! [`write()`] does it all. [`load`] reads, [`curves`] sorts, [`tables`] and [`plots`] present, and
//! a page joins them. The same files give the same bytes.

pub mod accuracy;
pub mod curves;
mod error;
#[cfg(test)]
mod fixture;
mod grid;
mod html;
pub mod load;
mod number;
pub mod plots;
mod row;
pub mod series;
pub mod study;
pub mod tables;

use std::fs;
use std::path::{Path, PathBuf};

pub use error::ReportError;
pub use number::{plain, with_error};
pub use row::Row;

use load::Loaded;

/// Writes `figures/*.svg`, `tables/*.csv` and `report.html` into an output directory that holds
/// at least a `summary.csv`, and returns the page's path.
pub fn write(out_dir: &Path) -> Result<PathBuf, ReportError> {
    let data = Loaded::read(out_dir)?;
    let figures = plots::all(&data)?;
    let tables = tables::all(&data)?;
    let (figures_dir, tables_dir) = (out_dir.join("figures"), out_dir.join("tables"));
    make(&figures_dir)?;
    make(&tables_dir)?;
    for figure in &figures {
        save(&figures_dir.join(format!("{}.svg", figure.name)), &figure.standalone())?;
    }
    for table in &tables {
        save(&tables_dir.join(format!("{}.csv", table.name)), &table.csv())?;
    }
    let path = out_dir.join("report.html");
    save(&path, &html::page(&data, &figures, &tables))?;
    Ok(path)
}

fn make(directory: &Path) -> Result<(), ReportError> {
    let wrong = |source| ReportError::Write { path: directory.to_owned(), source };
    fs::create_dir_all(directory).map_err(wrong)
}

fn save(path: &Path, text: &str) -> Result<(), ReportError> {
    fs::write(path, text).map_err(|source| ReportError::Write { path: path.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_files_give_the_same_bytes() {
        let directory = fixture::sweep();
        let read = |name: &str| fs::read(directory.path().join(name)).unwrap();
        let page = write(directory.path()).unwrap();
        assert_eq!(page, directory.path().join("report.html"));
        let names = ["report.html", "figures/response-force.svg", "tables/summary.csv"];
        let first = names.map(read);
        write(directory.path()).unwrap();
        assert_eq!(first, names.map(read));
    }

    #[test]
    fn a_sweep_in_which_every_case_failed_still_has_a_page() {
        let directory = fixture::sweep();
        let path = directory.path().join("summary.csv");
        let text = fs::read_to_string(&path).unwrap();
        let lines: Vec<_> = text.lines().collect();
        fs::write(&path, format!("{}\n{}\n", lines[0], lines[lines.len() - 1])).unwrap();
        let page = fs::read_to_string(write(directory.path()).unwrap()).unwrap();
        assert!(page.contains("0 finished, 1 failed"));
    }
}
