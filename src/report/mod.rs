//! The report of a sweep: tables, figures and one page, from the files of an output directory
//! alone. It knows nothing of solvers, so that figures can be drawn again without simulating.
//!
//! [`write()`] does it all. [`load`] reads, [`curves`] sorts, [`tables`] and [`plots`] present, and
//! a page joins them. The same files give the same bytes.

pub mod accuracy;
mod case;
mod chosen;
mod column;
pub mod compare;
mod config;
pub mod curves;
mod doubts;
mod error;
#[cfg(feature = "print")]
mod export;
pub mod find;
#[cfg(test)]
mod fixture;
mod froude;
mod goda;
mod grid;
pub mod load;
mod markup;
pub mod newtons;
mod number;
mod omitted;
mod page;
pub mod papers;
pub mod plots;
pub mod reproduce;
mod row;
mod scene_file;
mod scene_values;
mod selection;
pub mod series;
mod spoken;
pub mod study;
pub mod tables;
mod variant;

use std::fs;
use std::path::{Path, PathBuf};

pub use error::ReportError;
pub use froude::Froude;
pub use number::{as_typed, as_typed_to, digits_apart, with_error};
pub use omitted::Omitted;
pub use plots::Figure;
pub use reproduce::Reproduced;
pub use row::Row;
pub use scene_values::{scene_values, wall_of};
pub use spoken::spoken;

use crate::disk;
use crate::disk::names::{FIGURES, PAGE, TABLES};
use load::Loaded;
use tables::Lines;

/// Writes `figures/*.svg`, `tables/*.csv` and `report.html` into an output directory that holds
/// at least a `summary.csv`.
pub fn write(out_dir: &Path) -> Result<Written, ReportError> {
    write_with(out_dir, None, &[], &Omitted::default())
}

/// Writes the same. A Froude scale adds tables in the units of a prototype. Figures for print have
/// the widths of a journal's column (84 mm) and page (174 mm). Files in `omitted` are left out.
pub fn write_with(
    out_dir: &Path,
    scale: Option<Froude>,
    formats: &[Print],
    omitted: &Omitted,
) -> Result<Written, ReportError> {
    let data = Loaded::read(out_dir)?.without(omitted);
    let part = selection::of(&data);
    let shown = part.as_ref().unwrap_or(&data);
    let figures = plots::all(shown)?;
    for name in Froude::TABLES {
        // A table of an earlier scale may be there.
        let _ = fs::remove_file(out_dir.join(TABLES).join(format!("{name}.csv")));
    }
    let papers = papers::papers(shown)?;
    let (figures_dir, tables_dir) = (out_dir.join(FIGURES), out_dir.join(TABLES));
    make(&figures_dir)?;
    make(&tables_dir)?;
    let drawn: Vec<_> = figures.iter().chain(&papers.figures).collect();
    for figure in &drawn {
        redraw(figure, &figures_dir)?;
    }
    let scaled = scale.map_or(Ok(Vec::new()), |scale| scale.tables(&data))?;
    // If only part of a study is shown, the page has the rows of that part.
    let most = if part.is_some() { 0 } else { page::MOST_ROWS };
    let lines = tables::all(&data).into_iter().map(|lines| (lines, most));
    let lines = lines.chain(scaled.into_iter().map(|table| (table.into(), page::MOST_ROWS)));
    let write = |(lines, most): (Lines<'_>, usize)| {
        let path = tables_dir.join(format!("{}.csv", lines.head.name));
        lines.write(&path, most)
    };
    let mut tables = lines.map(write).collect::<Result<Vec<_>, _>>()?;
    for lines in part.iter().flat_map(tables::all) {
        if let Some(whole) = tables.iter_mut().find(|table| table.name == lines.head.name) {
            *whole = lines.whole()?.part_of(whole);
        }
    }
    if let Some(table) = &papers.tidy {
        save(&tables_dir.join(format!("{}.csv", table.name)), &table.csv())?;
    }
    let path = out_dir.join(PAGE);
    save(&path, &page::page([&data, shown], &figures, &tables, &papers)?)?;
    let mut printed = Vec::new();
    for format in formats {
        let figures = drawn.iter().map(|figure| print(figure, *format, &figures_dir));
        let mut paths = figures.collect::<Result<Vec<_>, _>>()?.concat();
        paths.sort();
        printed.extend(paths);
    }
    let figures = drawn.iter().flat_map(|figure| {
        let names = printed_names(figure, &figures_dir).into_iter();
        names.chain([format!("{}.svg", figure.name)]).map(|name| format!("{FIGURES}/{name}"))
    });
    let tables =
        tables.iter().chain(&papers.tidy).map(|table| format!("{TABLES}/{}.csv", table.name));
    Ok(Written { page: path, printed, made: figures.chain(tables).collect() })
}

/// What a report has written.
#[derive(Debug)]
pub struct Written {
    /// The path of the page.
    pub page: PathBuf,
    /// The paths of figures for print.
    pub printed: Vec<PathBuf>,
    /// Paths of figures and tables within the directory. Files for print of an earlier report are
    /// included where they still hold.
    pub made: Vec<String>,
}

/// A format of figures for print.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Print {
    /// Lines and outlines.
    Pdf,
    /// Pixels, 600 per inch.
    Png,
}

impl Print {
    /// Whether this build of the program can write figures for print.
    pub const BUILT: bool = cfg!(feature = "print");
    /// Widths in millimetres, and the most panels side by side.
    const WIDTHS: [(f64, usize); 2] = [(84.0, 1), (174.0, 3)];

    /// How its files' names end.
    pub fn ending(self) -> &'static str {
        match self {
            Print::Pdf => "pdf",
            Print::Png => "png",
        }
    }
}

/// Writes one figure for print into a directory, and returns the files' paths; none where the
/// program was built without this feature.
#[cfg_attr(not(feature = "print"), expect(unused_variables))]
pub fn print(
    figure: &Figure,
    format: Print,
    directory: &Path,
) -> Result<Vec<PathBuf>, ReportError> {
    #[cfg(feature = "print")]
    return export::write(figure, format, directory);
    #[cfg(not(feature = "print"))]
    Ok(Vec::new())
}

/// Writes a figure for the screen. Files for print that show an older version are removed.
fn redraw(figure: &Figure, directory: &Path) -> Result<(), ReportError> {
    let (path, svg) = (directory.join(format!("{}.svg", figure.name)), figure.svg());
    let printed = printed_names(figure, directory);
    if !printed.is_empty() && fs::read(&path).ok().as_deref() != Some(svg.as_bytes()) {
        for name in printed {
            let _ = fs::remove_file(directory.join(name));
        }
    }
    save(&path, &svg)
}

/// The names of a figure's files for print in a directory.
fn printed_names(figure: &Figure, directory: &Path) -> Vec<String> {
    let starts = Print::WIDTHS.map(|(width, _)| format!("{}-{width}mm", figure.name));
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    names.filter(|name| starts.iter().any(|start| name.starts_with(start))).collect()
}

fn make(directory: &Path) -> Result<(), ReportError> {
    let wrong = |error| ReportError::Write { path: directory.to_owned(), error };
    if directory.is_dir() { Ok(()) } else { fs::create_dir(directory).map_err(wrong) }
}

fn save(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<(), ReportError> {
    disk::put(path, content).map_err(|error| ReportError::Write { path: path.to_owned(), error })
}

#[cfg(test)]
mod tests;
