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
        "gaps_s",
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
        cells.push(column.gaps.seconds().to_string());
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
        // A line for each piece between gaps, of which the first is in the legend.
        let lines = |index: usize, label: &str, points: &[(f64, f64)]| -> Vec<Line> {
            let label = |at| if at == 0 { label } else { "" };
            let pieces = column.gaps.pieces(points).enumerate();
            pieces.map(|(at, of)| Line::new(index, label(at), case_id, scaled(of))).collect()
        };
        let curves =
            [lines(1, "measured", &column.measured), lines(0, "computed", &column.computed)];
        Strip {
            title: format!("{}: {title}", column.name),
            name: column.name.clone(),
            curves: curves.concat(),
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
