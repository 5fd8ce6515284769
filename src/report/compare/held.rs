//! A case and its measurements as a table, one line per column, and as a figure over time.

use super::{Beside, Held};
use crate::report::plots::{Figure, Line, Strip, strips};
use crate::report::tables::{Table, or_empty};

/// The table.
pub fn table(held: &Held) -> Table {
    let header = [
        "column",
        "unit",
        "from_s",
        "to_s",
        "measured_max",
        "measured_max_time_s",
        "computed_max",
        "computed_max_time_s",
        "off_percent",
        "measured_min",
        "measured_min_time_s",
        "computed_min",
        "computed_min_time_s",
        "rms",
        "rms_percent",
    ];
    let row = |column: &Beside| {
        let [from, to] = column.times();
        let [high, low] = [column.highest(), column.lowest()]
            .map(|ends| ends.map(|(time, value)| [value, time]).concat());
        let mut cells = vec![column.name.clone(), column.unit.clone()];
        cells.extend([from, to].iter().chain(&high).map(f64::to_string));
        cells.push(or_empty(column.off_percent()));
        cells.extend(low.iter().chain(&[column.rms]).map(f64::to_string));
        cells.push(or_empty(column.rms_percent()));
        cells
    };
    Table::new("compare", "Measured", &header, held.columns.iter().map(row).collect())
}

/// The figure: a panel for each column.
pub fn figure(held: &Held, case_id: &str) -> Figure {
    let strip = |column: &Beside| {
        let (title, factor) = &column.axis;
        let scaled = |points: &[(f64, f64)]| {
            points.iter().map(|&(time, value)| (time, value * factor)).collect()
        };
        let line = |index, label: &str, points| Line::new(index, label, case_id, scaled(points));
        Strip {
            title: format!("{}: {title}", column.name),
            name: column.name.clone(),
            curves: vec![
                line(1, "measured", &column.measured),
                line(0, "computed", &column.computed),
            ],
            peaks: true,
            ..Strip::default()
        }
    };
    let panels: Vec<_> = held.columns.iter().map(strip).collect();
    Figure {
        drawing: strips(&panels),
        name: "compare".to_owned(),
        title: "Measured and computed".to_owned(),
        caption: format!("What was measured, and the same columns of case {case_id}."),
    }
}
