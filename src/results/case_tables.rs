//! The tables that a case leaves, as text.

use super::number;
use crate::quantities::{self, Quantity};
use crate::simulation::{EnvelopeRow, HistoryRow, NamedReading, ProbeColumn, ProbeTable, WaveRow};

/// The history.
pub(super) fn history(rows: &[HistoryRow]) -> String {
    let columns = quantities::history::ALL;
    let mut text = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        let values = columns.iter().map(|column| (column.read)(row));
        push_row(&mut text, values);
    }
    text
}

/// The probes over time.
pub(super) fn probe_table(probes: &ProbeTable) -> String {
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

/// The largest pressures up the wall; without a first impact its cells are empty.
pub(super) fn envelope_table(rows: &[EnvelopeRow]) -> String {
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
        assert_eq!(probe_columns(&probes.columns), "name,unit,method\np1,Pa,here\nlevel,m,there\n");
        assert_eq!(text, "time_s,p1,level\n0,1.5,0.1\n0.005,2,0.30000000000000004\n");
    }

    #[test]
    fn words_may_hold_commas() {
        let reading = NamedReading::new("arm", 0.5, "% of R, largest");
        assert_eq!(reading_table(&[reading]), "name,value,unit\narm,0.5,\"% of R, largest\"\n");
    }
}
