//! The tables of a case, as text.

use super::number;
use crate::math::comma::csv;
use crate::quantities::{self, Quantity};
use crate::simulation::{EnvelopeRow, HistoryRow, NamedReading, ProbeColumn, ProbeTable, WaveRow};

/// The history.
pub(super) fn history(rows: &[HistoryRow]) -> String {
    declared(quantities::history::ALL, rows, |column, row| Some((column.read)(row)))
}

/// The probes over time.
pub(super) fn probe_table(probes: &ProbeTable) -> String {
    let names = probes.columns.iter().map(|column| column.name.as_str());
    let rows = probes.rows().map(|(time, row)| [time].into_iter().chain(row.iter().copied()));
    table(["time_s"].into_iter().chain(names), rows.map(|row| row.map(Some)))
}

/// The contents of the columns of the probes' tables.
pub(super) fn probe_columns(columns: &[ProbeColumn]) -> String {
    let row = |ProbeColumn { name, unit, method }: &ProbeColumn| {
        [name.clone(), unit.clone(), method.clone()]
    };
    worded(["name", "unit", "method"], columns.iter().map(row))
}

/// The readings.
pub(super) fn reading_table(readings: &[NamedReading]) -> String {
    let row = |reading: &NamedReading| {
        [reading.name.clone(), number::text(reading.value), reading.unit.clone()]
    };
    worded(["name", "value", "unit"], readings.iter().map(row))
}

/// Each whole period of regular waves.
pub(super) fn wave_table(rows: &[WaveRow]) -> String {
    declared(quantities::wave::ALL, rows, |column, row| Some((column.read)(row)))
}

/// The largest pressures up the wall. Without a first impact its cells are empty.
pub(super) fn envelope_table(rows: &[EnvelopeRow]) -> String {
    declared(quantities::envelope::ALL, rows, |column, row| (column.read)(row))
}

/// A table of declared columns.
fn declared<Read, Row>(
    columns: &[&Quantity<Read>],
    rows: &[Row],
    cell: impl Fn(&Quantity<Read>, &Row) -> Option<f64>,
) -> String {
    let cell = &cell;
    let cells = rows.iter().map(|row| columns.iter().map(move |column| cell(column, row)));
    table(columns.iter().map(|column| column.name), cells)
}

/// A table of numbers; a missing number is an empty cell.
fn table<'a>(
    names: impl Iterator<Item = &'a str>,
    rows: impl Iterator<Item = impl Iterator<Item = Option<f64>>>,
) -> String {
    let mut text = names.collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        for (column, value) in row.enumerate() {
            if column > 0 {
                text.push(',');
            }
            value.into_iter().for_each(|value| number::push(&mut text, value));
        }
        text.push('\n');
    }
    text
}

/// A table with words, which may have commas.
fn worded(header: [&str; 3], rows: impl Iterator<Item = [String; 3]>) -> String {
    csv(std::iter::once(header.map(str::to_owned)).chain(rows))
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
        assert_eq!(probe_columns(&probes.columns), "name,unit,method\np1,Pa,here\nlevel,m,there\n");
        assert_eq!(text, "time_s,p1,level\n0,1.5,0.1\n0.005,2,0.30000000000000004\n");
    }

    #[test]
    fn words_may_hold_commas() {
        let reading = NamedReading::new("arm", 0.5, "% of R, largest");
        assert_eq!(reading_table(&[reading]), "name,value,unit\narm,0.5,\"% of R, largest\"\n");
    }
}
