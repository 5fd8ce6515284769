//! The files of single cases: `histories/`, `probes/`, `readings/` and `envelopes/`.

use std::collections::BTreeMap;
use std::path::Path;

use csv::StringRecord;
use serde::Deserialize;

use super::error::ReportError;
use super::load::{Loaded, demand, deserialize, read_records};
use crate::disk::names::{ENVELOPES, HISTORIES, PROBE_COLUMNS, PROBES, READINGS, of_case};
use crate::quantities::{envelope, history};

/// Values over time: of a history, or of a gauge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Name of its column.
    pub name: String,
    /// Unit of its values: `Pa`, `m`, or what `probes/columns.csv` says; empty where that says
    /// none.
    pub unit: String,
    /// How a gauge measures, as `probes/columns.csv` says; empty otherwise.
    pub method: String,
    /// Time in seconds and value, pair by pair; empty cells are left out.
    pub points: Vec<(f64, f64)>,
}

/// Series of one case, in the order of their columns; empty where it has no such file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History(pub Vec<Series>);

impl History {
    /// The points of a column; empty where the column is missing.
    pub fn points(&self, name: &str) -> &[(f64, f64)] {
        self.0.iter().find(|series| series.name == name).map_or(&[], |series| &series.points)
    }
}

/// A number of a case that has no column in the summary.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Reading {
    /// What it is.
    pub name: String,
    /// Its value; `None` where the scene has none.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
}

/// The largest pressures at one height of the wall, as `envelopes/*.csv` has them.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub struct Pressed {
    /// Above the bed at the paddle, m.
    pub height_m: f64,
    /// In the whole run, Pa.
    pub pressure_max_pa: f64,
    /// In the first impact, Pa.
    pub first_pressure_max_pa: Option<f64>,
}

impl Loaded {
    /// Whether a case has a file of gauges.
    pub fn has_gauges(&self, case_id: &str) -> bool {
        let path = of_case(&self.directory, PROBES, case_id);
        path.exists() && !self.omitted.has(&path)
    }

    /// The gauges of a case.
    pub fn gauges(&self, case_id: &str) -> Result<History, ReportError> {
        let mut gauges = self.series(PROBES, case_id, &[history::TIME.name])?;
        if !gauges.0.is_empty() {
            let mut columns = self.columns()?;
            for gauge in &mut gauges.0 {
                [gauge.unit, gauge.method] = columns.remove(&gauge.name).unwrap_or_default();
            }
        }
        Ok(gauges)
    }

    /// The history of a case.
    pub fn history(&self, case_id: &str) -> Result<History, ReportError> {
        let needed = [&history::TIME, &history::FORCE, &history::RUNUP, &history::DISPLACEMENT];
        self.series(HISTORIES, case_id, &needed.map(|column| column.name))
    }

    fn series(
        &self,
        folder: &str,
        case_id: &str,
        needed: &[&'static str],
    ) -> Result<History, ReportError> {
        let path = of_case(&self.directory, folder, case_id);
        self.omitted.read(&path, |path| series(path, needed))
    }

    /// The readings of a case besides its row, in the file's order.
    pub fn readings(&self, case_id: &str) -> Result<Vec<Reading>, ReportError> {
        let path = of_case(&self.directory, READINGS, case_id);
        self.omitted.read(&path, |path| {
            let (header, records) = read_records(path)?;
            demand(path, &header, ["name", "value", "unit"].into_iter())?;
            deserialize(path, &header, &records)
        })
    }

    /// The largest pressures up the wall of a case; empty where it has no such file.
    pub fn envelope(&self, case_id: &str) -> Result<Vec<Pressed>, ReportError> {
        let path = of_case(&self.directory, ENVELOPES, case_id);
        self.omitted.read(&path, |path| {
            let (header, records) = read_records(path)?;
            demand(path, &header, envelope::ALL.iter().map(|column| column.name))?;
            deserialize(path, &header, &records)
        })
    }

    /// Units and methods of the gauges' columns, by name.
    fn columns(&self) -> Result<BTreeMap<String, [String; 2]>, ReportError> {
        let path = self.directory.join(PROBE_COLUMNS);
        self.omitted.read(&path, |path| {
            let (header, records) = read_records(path)?;
            demand(path, &header, ["name", "unit"].into_iter())?;
            let at = |name: &str| header.iter().position(|column| column == name);
            let cell = |record: &StringRecord, name| {
                at(name).and_then(|at| record.get(at)).unwrap_or_default().to_owned()
            };
            let told =
                |record| (cell(record, "name"), ["unit", "method"].map(|of| cell(record, of)));
            Ok(records.iter().map(told).collect())
        })
    }
}

/// Reads a table over time.
pub(super) fn series(path: &Path, needed: &[&'static str]) -> Result<History, ReportError> {
    let (header, records) = read_records(path)?;
    demand(path, &header, needed.iter().copied())?;
    series_of(path, &header, &records)
}

/// The series of a table over time that has been read.
pub(super) fn series_of(
    path: &Path,
    header: &StringRecord,
    records: &[StringRecord],
) -> Result<History, ReportError> {
    let rows: Vec<Vec<Option<f64>>> = deserialize(path, header, records)?;
    let time = header.iter().position(|name| name == history::TIME.name).unwrap_or(0);
    let series = |(column, name): (usize, &str)| Series {
        name: name.to_owned(),
        points: rows
            .iter()
            .filter_map(|row| row[time].zip(row[column]))
            .filter(|(time, value)| time.is_finite() && value.is_finite())
            .collect(),
        ..Series::default()
    };
    let columns = header.iter().enumerate().filter(|(column, _)| *column != time);
    Ok(History(columns.map(series).collect()))
}

/// The value at a time, interpolated between samples; `None` where the run had ended by then.
pub fn at(points: &[(f64, f64)], time: f64) -> Option<f64> {
    /// The last sample may be a step before the end.
    const SLACK_S: f64 = 0.02;
    let after = points.partition_point(|point| point.0 < time);
    let last = points.last().filter(|last| time <= last.0 + SLACK_S)?;
    let next = points.get(after).unwrap_or(last);
    let before = points[after.saturating_sub(1).min(points.len() - 1)];
    let share = if next.0 > before.0 { (time - before.0) / (next.0 - before.0) } else { 0.0 };
    Some(before.1 + share.clamp(0.0, 1.0) * (next.1 - before.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn values_lie_between_samples_and_end_with_the_run() {
        let points = [(0.0, 1.0), (1.0, 3.0), (2.0, 2.0)];
        assert_eq!(at(&points, 0.5), Some(2.0));
        assert_eq!(at(&points, 2.0), Some(2.0));
        assert_eq!(at(&points, 2.01), Some(2.0), "a step before the end");
        assert_eq!(at(&points, 2.5), None);
        assert_eq!(at(&[], 0.0), None);
    }

    #[test]
    fn gauges_have_units_and_readings_their_order() {
        let (_directory, data) = fixture::read(fixture::dam_breaks(1));
        let History(gauges) = data.gauges("case-0000").unwrap();
        let told: Vec<_> = gauges.iter().map(|g| (g.name.as_str(), g.unit.as_str())).collect();
        assert_eq!(told, [("P1", "Pa"), ("front", "m")]);
        assert_eq!(gauges[0].points.len(), 400);
        assert_eq!(gauges[1].points.len(), 399, "an empty cell is no point");
        let readings = data.readings("case-0000").unwrap();
        assert_eq!(readings[0].name, "front_at_wall");
        assert_eq!(readings[1].value, None);
        assert!(data.gauges("no-such-case").unwrap().0.is_empty());
        assert!(data.readings("no-such-case").unwrap().is_empty());
    }

    #[test]
    fn a_gauge_that_holds_no_numbers_is_named_with_file_and_line() {
        let directory = fixture::dam_breaks(1);
        let path = directory.path().join("probes/case-0000.csv");
        std::fs::write(&path, "time_s,P1\n0,high\n").unwrap();
        let data = Loaded::read(directory.path()).unwrap();
        let told = data.gauges("case-0000").unwrap_err().to_string();
        assert!(told.contains("case-0000.csv") && told.contains("P1"), "{told}");
    }

    #[test]
    fn a_reading_that_is_no_number_is_named_with_its_place() {
        let directory = fixture::dam_breaks(1);
        let path = directory.path().join("readings/case-0000.csv");
        std::fs::write(&path, "name,value,unit\nmass,1,kg\nfront,high,m\n").unwrap();
        let told = Loaded::read(directory.path()).unwrap().readings("case-0000").unwrap_err();
        let told = told.to_string();
        assert!(
            ["case-0000.csv", "line 3", "value"].iter().all(|part| told.contains(part)),
            "{told}"
        );
    }
}
