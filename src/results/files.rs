//! Per-case files: histories, probes, readings, envelopes and waves.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::checksum::checksum;
use super::error::SweepError;
use super::{atomic_file, disk, number};
use crate::quantities::{self, Quantity};
use crate::simulation::{
    CaseResult, EnvelopeRow, HistoryRow, NamedReading, ProbeColumn, ProbeTable, WaveRow,
};
use crate::study::CaseId;

/// What a file was when it was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Seal {
    /// Its length, bytes, and the start of its SHA-256.
    Whole {
        /// Length.
        bytes: u64,
        /// 16 hex digits.
        sum: String,
    },
    /// Its length alone, as earlier versions wrote it.
    Length(u64),
}

impl Seal {
    fn of(content: &[u8]) -> Seal {
        Seal::Whole { bytes: content.len() as u64, sum: checksum(content) }
    }

    /// Length of the file.
    fn bytes(&self) -> u64 {
        match self {
            Seal::Whole { bytes, .. } | Seal::Length(bytes) => *bytes,
        }
    }

    /// Whether a file is as it was written; `None` where it cannot be read.
    fn fits(&self, path: &Path) -> Option<bool> {
        let mut file = File::open(path).ok()?;
        if self.bytes() > ASKED && file.metadata().ok()?.len() != self.bytes() {
            return Some(false);
        }
        let length = usize::try_from(self.bytes()).ok()?;
        // One byte more tells at once where it ends: of a million small files each call counts.
        let mut content = vec![0; length + 1];
        let mut read = 0;
        while read < length {
            match file.read(&mut content[read..]) {
                Ok(0) => return Some(false),
                Ok(more) => read += more,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return None,
            }
        }
        content.truncate(read);
        Some(match self {
            _ if read > length => false,
            Seal::Length(_) => true,
            Seal::Whole { sum, .. } => *sum == checksum(&content),
        })
    }
}

/// By hand: what `untagged` makes of it holds every value twice before it knows which it is.
impl<'de> Deserialize<'de> for Seal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Seal, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Seal;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a length, or a length and a sum")
            }
            fn visit_u64<E: de::Error>(self, bytes: u64) -> Result<Seal, E> {
                Ok(Seal::Length(bytes))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Seal, A::Error> {
                #[derive(Deserialize)]
                struct Whole {
                    bytes: u64,
                    sum: String,
                }
                let Whole { bytes, sum } =
                    Whole::deserialize(de::value::MapAccessDeserializer::new(map))?;
                Ok(Seal::Whole { bytes, sum })
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// A larger file is asked for its length before there is room made for it.
const ASKED: u64 = 1 << 20;

/// Seals of a case's files by their folders.
pub(super) type Seals = BTreeMap<String, Seal>;

const HISTORIES: &str = "histories";
const PROBES: &str = "probes";
const READINGS: &str = "readings";
const ENVELOPES: &str = "envelopes";
const WAVES: &str = "waves";
/// All folders.
const FOLDERS: [&str; 5] = [HISTORIES, PROBES, READINGS, ENVELOPES, WAVES];

/// What writing a case's files left to be done and told.
#[derive(Debug, Default)]
pub(super) struct Written {
    pub(super) seals: Seals,
    /// What the columns of its probes hold.
    pub(super) probe_columns: Option<String>,
}

/// Writes what a case leaves besides its journal line; onto the disk itself if `durable`.
pub(super) fn write(
    directory: &Path,
    id: CaseId,
    result: &CaseResult,
    durable: bool,
) -> Result<Written, SweepError> {
    let mut texts = vec![(HISTORIES, history(&result.history))];
    if let Some(probes) = &result.probes {
        texts.push((PROBES, probe_table(probes)));
    }
    if !result.readings.is_empty() {
        texts.push((READINGS, reading_table(&result.readings)));
    }
    if !result.envelope.is_empty() {
        texts.push((ENVELOPES, envelope_table(&result.envelope)));
    }
    if !result.waves.is_empty() {
        texts.push((WAVES, wave_table(&result.waves)));
    }
    let put = if durable { atomic_file::write } else { atomic_file::write_unsynced };
    let mut seals = Seals::new();
    for (name, text) in texts {
        let folder = directory.join(name);
        if !folder.is_dir() {
            disk::create_folder(&folder).map_err(SweepError::io(&folder))?;
        }
        put(&folder.join(format!("{id}.csv")), text.as_bytes())?;
        seals.insert(name.to_owned(), Seal::of(text.as_bytes()));
    }
    Ok(Written { seals, probe_columns: result.probes.as_ref().map(probe_columns) })
}

/// Writes what the columns of probes hold. It is the same for all cases of a sweep, but that some walls may
/// have a crest and some not.
pub(super) fn write_probe_columns(directory: &Path, text: &str) -> Result<(), SweepError> {
    let path = directory.join(PROBES).join("columns.csv");
    let known = fs::metadata(&path).map_or(0, |file| file.len());
    if known < text.len() as u64 { atomic_file::write(&path, text.as_bytes()) } else { Ok(()) }
}

/// So many files go to the disk with all else that waits to: one by one they take seven times as long.
const MANY: usize = 32;

/// Files that cases have left and that may not be on the disk yet. They go there in groups. One by one, the
/// coordinator of many ranks would do little but wait for the disk.
#[derive(Debug)]
pub(super) struct Unsynced {
    /// Open from before the first file on: failures since then are told.
    directory: Arc<File>,
    paths: Vec<PathBuf>,
}

impl Unsynced {
    /// None in this directory yet.
    pub(super) fn new(directory: &Path) -> Result<Unsynced, SweepError> {
        let opened = File::open(directory).map_err(SweepError::io(directory))?;
        Ok(Unsynced { directory: Arc::new(opened), paths: Vec::new() })
    }

    /// A case has left its files.
    pub(super) fn add(&mut self, directory: &Path, id: CaseId, seals: &Seals) {
        let path = |name: &String| directory.join(name).join(format!("{id}.csv"));
        self.paths.extend(seals.keys().map(path));
    }

    /// All of them; none are left.
    pub(super) fn take(&mut self) -> Unsynced {
        let paths = std::mem::take(&mut self.paths);
        Unsynced { directory: self.directory.clone(), paths }
    }

    /// Puts them on the disk.
    pub(super) fn sync(&self, directory: &Path) -> Result<(), SweepError> {
        if self.paths.len() >= MANY && disk::sync_all(&self.directory) {
            return Ok(());
        }
        self.paths.iter().try_for_each(|path| atomic_file::sync(path))?;
        let folders = FOLDERS.map(|name| directory.join(name));
        folders.iter().filter(|path| path.is_dir()).try_for_each(|path| atomic_file::sync(path))
    }
}

/// The first file of a case that is not as it was written: its path, and what is wrong with it.
pub(super) fn damage(
    directory: &Path,
    id: CaseId,
    seals: &Seals,
) -> Option<(PathBuf, &'static str)> {
    let file = format!("{id}.csv");
    let path = |name: &str| directory.join(name).join(&file);
    let damage = seals.iter().find_map(|(name, seal)| {
        let path = path(name);
        match seal.fits(&path) {
            Some(true) => None,
            Some(false) => Some((path, "is damaged")),
            None => Some((path, "is missing")),
        }
    });
    let read = damage.is_none() && seals.contains_key(HISTORIES);
    if !read && !path(HISTORIES).is_file() {
        return Some((path(HISTORIES), "is missing"));
    }
    damage
}

/// Whether there is any history.
pub(super) fn any(directory: &Path) -> bool {
    fs::read_dir(directory.join(HISTORIES)).is_ok_and(|mut entries| entries.next().is_some())
}

/// Removes what a killed process left half written.
pub(super) fn clean(directory: &Path) -> Result<(), SweepError> {
    let folders = FOLDERS.map(|name| directory.join(name));
    let all = std::iter::once(directory.to_owned()).chain(folders);
    all.into_iter().try_for_each(|folder| atomic_file::clean(&folder))
}

/// Where a case's history is.
pub(super) fn history_path(directory: &Path, id: impl std::fmt::Display) -> PathBuf {
    directory.join(HISTORIES).join(format!("{id}.csv"))
}

/// Its text.
pub(super) fn history(rows: &[HistoryRow]) -> String {
    let columns = quantities::history::ALL;
    let mut text = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        let values = columns.iter().map(|column| (column.read)(row));
        push_row(&mut text, values);
    }
    text
}

fn probe_table(probes: &ProbeTable) -> String {
    let mut text = "time_s".to_owned();
    for column in &probes.columns {
        text.push(',');
        text.push_str(&column.name);
    }
    text.push('\n');
    for (time, row) in probes.rows() {
        push_row(&mut text, std::iter::once(time).chain(row.iter().copied()));
    }
    text
}

/// What a column of the probes' tables holds.
fn probe_columns(probes: &ProbeTable) -> String {
    let row = |ProbeColumn { name, unit, method }: &ProbeColumn| {
        [name.clone(), unit.clone(), method.clone()]
    };
    worded(["name", "unit", "method"], probes.columns.iter().map(row))
}

fn reading_table(readings: &[NamedReading]) -> String {
    let row = |reading: &NamedReading| {
        [reading.name.clone(), number::text(reading.value), reading.unit.clone()]
    };
    worded(["name", "value", "unit"], readings.iter().map(row))
}

/// Each whole period of regular waves.
fn wave_table(rows: &[WaveRow]) -> String {
    declared(quantities::wave::ALL, rows, |column, row| Some((column.read)(row)))
}

/// The largest pressures up the wall; without a first impact its cells are empty.
fn envelope_table(rows: &[EnvelopeRow]) -> String {
    declared(quantities::envelope::ALL, rows, |column, row| (column.read)(row))
}

/// A table of declared columns.
fn declared<Read, Row>(
    columns: &[&Quantity<Read>],
    rows: &[Row],
    cell: impl Fn(&Quantity<Read>, &Row) -> Option<f64>,
) -> String {
    let mut text = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        let cells = columns.iter().map(|column| cell(column, row));
        let cells: Vec<_> =
            cells.map(|value| value.map(number::text).unwrap_or_default()).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// A table with words in it, which may hold commas.
fn worded(header: [&str; 3], rows: impl Iterator<Item = [String; 3]>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in std::iter::once(header.map(str::to_owned)).chain(rows) {
        writer.write_record(row).expect("rows of three cells go into memory");
    }
    let bytes = writer.into_inner().expect("memory takes it all");
    String::from_utf8(bytes).expect("made of text")
}

fn push_row(text: &mut String, values: impl IntoIterator<Item = f64>) {
    for (column, value) in values.into_iter().enumerate() {
        if column > 0 {
            text.push(',');
        }
        number::push(text, value);
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probes_have_a_column_each() {
        let probes = ProbeTable {
            columns: vec![
                ProbeColumn { name: "p1".into(), unit: "Pa".into(), method: "here".into() },
                ProbeColumn { name: "level".into(), unit: "m".into(), method: "there".into() },
            ],
            time_s: vec![0.0, 0.005],
            values: vec![1.5, 0.1, 2.0, 0.30000000000000004],
        };
        let text = probe_table(&probes);
        assert_eq!(probe_columns(&probes), "name,unit,method\np1,Pa,here\nlevel,m,there\n");
        assert_eq!(text, "time_s,p1,level\n0,1.5,0.1\n0.005,2,0.30000000000000004\n");
    }

    #[test]
    fn words_may_hold_commas() {
        let reading = NamedReading::new("arm", 0.5, "% of R, largest");
        assert_eq!(reading_table(&[reading]), "name,value,unit\narm,0.5,\"% of R, largest\"\n");
    }
}
