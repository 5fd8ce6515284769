//! A comparison as a table: one line per pair of cases.

use super::{COMPARED, Comparison, Difference};
use crate::report::row::PLACE;
use crate::report::tables::Table;

/// The table: the point, both cases, and for each quantity both values and what they differ by.
pub fn table(comparison: &Comparison) -> Table {
    let mut header: Vec<String> = PLACE.iter().map(|column| column.name.to_owned()).collect();
    header.extend(["case_id_a", "case_id_b", "case"].map(str::to_owned));
    for (column, _) in COMPARED {
        let ends =
            ["a", "b", "difference", "percent", "error_a", "error_b", "bound", "within_bars"];
        header.extend(ends.iter().map(|end| format!("{}_{end}", column.name)));
    }
    let row = |pair: &super::Pair| {
        let mut cells = [pair.place.to_vec(), pair.ids.to_vec(), vec![pair.words.clone()]].concat();
        pair.differences.iter().for_each(|difference| cells.extend(of(difference.as_ref())));
        cells
    };
    Table::new("compare", "Comparison", &header, comparison.pairs.iter().map(row).collect())
}

fn of(difference: Option<&Difference>) -> [String; 8] {
    let Some(one) = difference else { return Default::default() };
    let cell = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
    let [a, b] = one.values.map(|value| value.to_string());
    let [error_a, error_b] = one.bars.map(cell);
    let bound = one.bounds.iter().any(|bound| *bound).to_string();
    let within = one.is_within().map(|is| is.to_string()).unwrap_or_default();
    [a, b, one.absolute().to_string(), cell(one.percent()), error_a, error_b, bound, within]
}
