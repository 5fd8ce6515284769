//! Reads an output directory: `summary.csv`, `energy.csv` and `manifest.json`. Histories, gauges
//! and readings are read one case at a time, in [`super::series`].

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use csv::{ErrorKind, StringRecord};
use serde::Deserialize;
use serde_json::Value;

use super::chosen::chosen;
use super::column::Cells;
use super::error::ReportError;
use super::omitted::Omitted;
use super::row::{Header, RECORDED, REGULAR, Row};
use super::study::{Key, StudyFile, keys};
use super::variant::name_variants;
use crate::disk::names::{ENERGY, FILM_PAGE, FILMS, MANIFEST, MAX_ERROR, SUMMARY, film_file};
use crate::keys::number;
use crate::quantities::{named, summary};

/// All that the report knows about a sweep.
#[derive(Debug, Clone, Default)]
pub struct Loaded {
    /// Rows of `summary.csv`, in its order.
    pub rows: Vec<Row>,
    /// Where `energy.csv` is, if there is one.
    pub energy: Option<PathBuf>,
    /// `manifest.json`, where there is one that can be read.
    pub manifest: Option<Value>,
    /// What was swept, in the grid's order; empty without a manifest.
    pub keys: Vec<Key>,
    /// The file that the study was made from, with the settings of the command line.
    pub(super) file: Option<Arc<StudyFile>>,
    /// The numerics of each row, if they were chosen case by case.
    pub(super) chosen: Option<Cells>,
    pub(super) directory: PathBuf,
    /// Whether these are only some of the study's rows.
    pub(super) is_part: bool,
    /// Files of cases that are left out.
    pub(super) omitted: Omitted,
}

impl Loaded {
    /// Reads everything but the files of single cases.
    pub fn read(directory: &Path) -> Result<Loaded, ReportError> {
        let energy = directory.join(ENERGY);
        let energy = Some(energy).filter(|path| path.exists());
        if let Some(path) = &energy {
            demand(path, &stream(path)?.0, std::iter::once(summary::CASE_ID.name))?;
        }
        let manifest = read_manifest(&directory.join(MANIFEST));
        let (mut rows, keys) = read_summary(&directory.join(SUMMARY), manifest.as_ref())?;
        let file = StudyFile::of(manifest.as_ref()).map(Arc::new);
        let angle = file.as_ref().and_then(|file| number(file.scene.get("wall_angle_deg")?));
        let paddle = file.as_ref().and_then(|file| file.scene.get("paddle")?.as_str());
        let wall = file.as_ref().and_then(|file| file.scene.get("wall")?.as_str());
        let wall: Option<Arc<str>> = wall.map(Arc::from);
        let asks = file.as_ref().is_none_or(|file| file.gives(summary::WAVE_HEIGHT_RATIO.name));
        for row in &mut rows {
            row.wall.clone_from(&wall);
            row.wall_angle_deg = row.wall_angle_deg.or(angle);
            row.regular |= paddle == Some(REGULAR);
            row.unasked = !asks && (row.unasked || paddle == Some(RECORDED));
        }
        let chosen = chosen(&directory.join(MAX_ERROR), &rows);
        let directory = directory.to_owned();
        Ok(Loaded { rows, energy, manifest, keys, file, chosen, directory, ..Loaded::default() })
    }

    /// The same data, where the files of cases in `omitted` are left out.
    pub fn without(self, omitted: &Omitted) -> Loaded {
        Loaded { omitted: omitted.clone(), ..self }
    }

    /// The sweep's name, as its manifest states it.
    pub fn name(&self) -> Option<&str> {
        self.manifest.as_ref()?.get("name")?.as_str()
    }

    /// How many cases are neither finished nor failed.
    pub fn left(&self) -> usize {
        let cases = self.manifest.as_ref().and_then(|manifest| manifest.get("cases")?.as_u64());
        let cases = cases.and_then(|cases| usize::try_from(cases).ok()).unwrap_or(0);
        cases.saturating_sub(self.rows.len())
    }

    /// Rows of cases that ran to their end.
    pub fn finished(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.is_ok())
    }

    /// Rows of cases that ran to their end, each with its place among all rows.
    pub(super) fn placed(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.rows.iter().enumerate().filter(|(_, row)| row.is_ok())
    }

    /// Finished rows of one variant.
    pub fn of_variant(&self, variant: &str) -> impl Iterator<Item = &Row> {
        self.finished().filter(move |row| *row.variant == *variant)
    }

    /// The same data with only the rows at these places.
    pub(super) fn part(&self, places: &[usize]) -> Loaded {
        let part = |cells: &Cells| places.iter().map(|&place| &cells[place]).collect();
        let key = |Key { name, cells }: &Key| Key { name: name.clone(), cells: part(cells) };
        Loaded {
            rows: places.iter().map(|&place| self.rows[place].clone()).collect(),
            energy: self.energy.clone(),
            manifest: self.manifest.clone(),
            keys: self.keys.iter().map(key).collect(),
            file: self.file.clone(),
            chosen: self.chosen.as_ref().map(part),
            directory: self.directory.clone(),
            is_part: true,
            omitted: self.omitted.clone(),
        }
    }

    /// The ids of the cases that were filmed.
    pub(super) fn filmed(&self) -> Vec<String> {
        let entries = fs::read_dir(self.directory.join(FILMS)).into_iter().flatten().flatten();
        let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
        names.filter_map(|name| Some(name.strip_suffix(FILM_PAGE)?.to_owned())).collect()
    }

    /// Whether a case was filmed.
    pub fn has_film(&self, row: &Row) -> bool {
        film_file(&self.directory.join(FILMS), row.id(), FILM_PAGE).is_file()
    }

    /// The text of a file of a case's film, by how its name ends.
    pub(super) fn film(&self, row: &Row, ending: &str) -> Option<String> {
        fs::read_to_string(film_file(&self.directory.join(FILMS), row.id(), ending)).ok()
    }

    /// Rows of cases that failed.
    pub fn failed(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.is_ok())
    }
}

/// The rows, and the swept keys that the manifest names.
fn read_summary(
    path: &Path,
    manifest: Option<&Value>,
) -> Result<(Vec<Row>, Vec<Key>), ReportError> {
    let (header, records) = stream(path)?;
    demand(path, &header, summary::first_version().map(|column| column.name))?;
    let columns = Arc::new(Header::new(header.iter()));
    // Swept keys follow the columns that every summary has.
    let declared = header.iter().enumerate().filter(|(_, name)| named(name).is_some());
    let known = declared.last().map_or(0, |(at, _)| at + 1);
    let key = |column: usize| Key::new(&header[column], [""; 0]);
    let place = |name: &String| header.iter().position(|column| column == name);
    let grid = manifest.map(keys).unwrap_or_default();
    let swept: Vec<_> = grid.iter().filter_map(place).collect();
    let mut swept_keys: Vec<_> = swept.iter().map(|&column| key(column)).collect();
    let mut further: Vec<_> = (known..header.len()).map(key).collect();
    let mut rows = Vec::new();
    for record in records {
        let record = record?;
        let wrong = |(place, reason): (usize, String)| ReportError::Cell {
            path: path.to_owned(),
            line: record.position().map_or(0, csv::Position::line),
            column: header[place].to_owned(),
            reason,
        };
        rows.push(Row::new(&columns, record.iter()).map_err(wrong)?);
        swept_keys.iter_mut().zip(&swept).for_each(|(key, &at)| key.cells.push(&record[at]));
        further.iter_mut().zip(known..).for_each(|(key, at)| key.cells.push(&record[at]));
    }
    name_variants(&mut rows, &further, &grid);
    Ok((rows, swept_keys))
}

/// A report can do without a damaged manifest: it tells only where the numbers come from.
fn read_manifest(path: &Path) -> Option<Value> {
    serde_json::from_slice(&std::fs::read(path).ok()?).ok()
}

/// The columns of a table and its rows.
pub(super) fn read_records(path: &Path) -> Result<(StringRecord, Vec<StringRecord>), ReportError> {
    let wrong = |source| ReportError::Table { path: path.to_owned(), source };
    let text =
        fs::read(path).map_err(|error| ReportError::Read { path: path.to_owned(), error })?;
    let mut reader = csv::Reader::from_reader(text.as_slice());
    let header = reader.headers().map_err(wrong)?.clone();
    let records = reader.records().map(|record| record.map_err(wrong));
    Ok((header, records.collect::<Result<_, _>>()?))
}

/// The columns of a table, and its rows read one by one: a large table is never held whole.
pub(super) fn stream(
    path: &Path,
) -> Result<(StringRecord, impl Iterator<Item = Result<StringRecord, ReportError>>), ReportError> {
    let wrong = |source| ReportError::Table { path: path.to_owned(), source };
    let unread = |error| ReportError::Read { path: path.to_owned(), error };
    let file = fs::File::open(path).map_err(unread)?;
    let mut reader = csv::ReaderBuilder::new().buffer_capacity(1 << 20).from_reader(file);
    let header = reader.headers().map_err(wrong)?.clone();
    let own = path.to_owned();
    let wrong = move |source| ReportError::Table { path: own.clone(), source };
    Ok((header, reader.into_records().map(move |record| record.map_err(&wrong))))
}

/// Refuses a table that lacks a wanted column, and names the first one.
pub(super) fn demand(
    path: &Path,
    header: &StringRecord,
    mut columns: impl Iterator<Item = &'static str>,
) -> Result<(), ReportError> {
    match columns.find(|column| !header.iter().any(|name| name == *column)) {
        Some(column) => Err(ReportError::MissingColumn { path: path.to_owned(), column }),
        None => Ok(()),
    }
}

pub(super) fn deserialize<T: for<'de> Deserialize<'de>>(
    path: &Path,
    header: &StringRecord,
    records: &[StringRecord],
) -> Result<Vec<T>, ReportError> {
    records
        .iter()
        .map(|record| record.deserialize(Some(header)).map_err(|e| narrate(path, header, e)))
        .collect()
}

/// Names the cell that the reader refused.
fn narrate(path: &Path, header: &StringRecord, source: csv::Error) -> ReportError {
    let path = path.to_owned();
    if let ErrorKind::Deserialize { pos: Some(position), err } = source.kind()
        && let Some(column) = err.field().and_then(|field| header.get(field as usize))
    {
        let (line, column) = (position.line(), column.to_owned());
        return ReportError::Cell { path, line, column, reason: err.kind().to_string() };
    }
    ReportError::Table { path, source }
}

#[cfg(test)]
mod tests;
