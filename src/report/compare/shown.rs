//! A comparison as a table, one line per pair of cases, and as a figure: the differences against
//! the values in the first study.

use super::{Comparison, Difference, Pair};
use crate::quantities::Column;
use crate::quantities::summary::RESULTS;
use crate::report::plots::{Axis, Chart, Curve, Drawing, Entry, Figure, Layout, Look, Point};
use crate::report::row::PLACE;
use crate::report::tables::{Table, or_empty};

/// The table: the point, both cases, and for each quantity both values and their difference.
pub fn table(comparison: &Comparison) -> Table {
    let mut header: Vec<String> = PLACE.iter().map(|column| column.name.to_owned()).collect();
    header.extend(["case_id_a", "case_id_b", "case"].map(str::to_owned));
    for column in (0..RESULTS.len()).map(|at| comparison.column(at)) {
        let ends =
            ["a", "b", "difference", "percent", "error_a", "error_b", "bound", "within_bars"];
        header.extend(ends.iter().map(|end| format!("{}_{end}", column.name)));
    }
    let row = |pair: &Pair| {
        let mut cells = [pair.place.to_vec(), pair.ids.to_vec(), vec![pair.words.clone()]].concat();
        pair.differences.iter().for_each(|difference| cells.extend(of(difference.as_ref())));
        cells
    };
    Table::new("compare", "Comparison", &header, comparison.pairs.iter().map(row).collect())
}

fn of(difference: Option<&Difference>) -> [String; 8] {
    let Some(one) = difference else { return Default::default() };
    let [a, b] = one.values.map(|value| value.to_string());
    let [error_a, error_b] = one.bars.map(or_empty);
    let bound = one.bounds.iter().any(|bound| *bound).to_string();
    let [difference, percent] = [one.absolute().to_string(), or_empty(one.percent())];
    [a, b, difference, percent, error_a, error_b, bound, or_empty(one.is_within())]
}

/// The figure; `None` where no pair has both numbers.
pub fn figure(comparison: &Comparison) -> Option<Figure> {
    let columns = (0..RESULTS.len()).map(|at| (at, comparison.column(at)));
    let charts = columns.filter_map(|(at, column)| chart(comparison, at, column)).collect();
    let [a, b] = &comparison.names;
    Some(Figure {
        drawing: Drawing::filled(charts, Layout { columns: 3, size: (296.0, 236.0) })?,
        name: "compare".to_owned(),
        title: format!("{b} less {a}"),
        caption:
            "What cases of the same point differ by, against their value in the first study. Bars: \
                  the error bars of both added up. Open markers: lower bounds."
                .to_owned(),
    })
}

fn chart(comparison: &Comparison, at: usize, column: &Column) -> Option<Chart> {
    let point = |pair: &Pair| {
        let one = pair.differences[at]?;
        let (x, y) = (one.values[0], one.absolute());
        let case = pair.ids.join(" ");
        let told = format!("{}: {} and {}", pair.words, one.values[0], one.values[1]);
        let (error, open) = (one.bar().unwrap_or(0.0), one.bounds.iter().any(|bound| *bound));
        Some(Point { error, open, case, told, ..(x, y).into() })
    };
    let points: Vec<Point> = comparison.pairs.iter().filter_map(point).collect();
    let x = Axis::around(points.iter().map(|point| point.x), 5.0)?;
    let dots = Curve { entry: Entry::dots("", Look::of(0), false).keyed("difference"), points };
    let y = Axis::around(dots.reach().chain([0.0]), 5.0)?;
    let same = Curve::level("no difference", 0.0, std::slice::from_ref(&dots));
    let title = column.unit.axis();
    let titles = [format!("{title}, first study"), format!("second less first, {title}")];
    let names = [column.name, "difference"];
    let chart = Chart::new((x, y), titles.each_ref().map(String::as_str), names, vec![same, dots]);
    Some(chart.under(column.symbol, ""))
}
