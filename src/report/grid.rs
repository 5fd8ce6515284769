//! Tables as HTML: symbols as headings, numbers aligned right, doubtful values marked. Each row is
//! one line, as the page's script expects.

use std::fmt::Write as _;

use super::markup::escape;
use super::number;
use super::tables::Table;
use crate::quantities::summary::{
    CASE_ID, DOUBTFUL, DOUBTFUL_REASON, LOG10_K_STAR, M_STAR, MEASURED_WAVE_HEIGHT_RATIO, STATUS,
    STOPS,
};
use crate::quantities::{Column, heading};

/// A table as HTML. Without scripts a table with a row per case stays as it is. With scripts, the
/// same text becomes a table that can be sorted and filtered.
pub(super) fn grid(table: &Table) -> String {
    let text = format!("<div class=\"wide\"><table>\n{}</table></div>", whole(table));
    let (name, rows, all) = (&table.name, table.rows.len(), table.rows.len() + table.left);
    let file = match name.as_str() {
        "" if rows < all => format!("<p>... and {} more.</p>", table.left),
        "" => String::new(),
        _ if rows == all && !table.is_part => format!("<p class=\"file\">tables/{name}.csv</p>"),
        _ => {
            let first = if table.is_part { "" } else { "the first " };
            let all = format!("{rows} of {all} rows; tables/{name}.csv has all");
            format!("<p class=\"file\">{first}{all}</p>")
        }
    };
    if table.header.first().is_none_or(|name| name != CASE_ID.name) || table.name.is_empty() {
        return text + &file;
    }
    format!("<div class=\"listing\" data-table=\"{name}\"><noscript>{text}</noscript></div>{file}")
}

/// Head and body. A case's id comes last, as it is needed least.
fn whole(table: &Table) -> String {
    let mut order: Vec<usize> = (0..table.header.len()).collect();
    // Measured values come before ratios that follow from the input.
    if table.name == "summary" {
        order.sort_by_key(|&at| RATIOS.iter().any(|column| column.name == table.header[at]));
    }
    if table.header.first().is_some_and(|name| name == CASE_ID.name) {
        order.rotate_left(1);
    }
    let numeric: Vec<_> = (0..table.header.len()).map(|at| is_numeric(table, at)).collect();
    let mut text = "<thead><tr>".to_owned();
    for &at in &order {
        let (name, class) = (&table.header[at], if numeric[at] { "number" } else { "words" });
        let title = escape(&heading(name));
        let name = escape(name);
        write!(text, "<th class=\"{class}\" data-column=\"{name}\">{title}</th>").expect(GROWS);
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        match order.last().filter(|last| **last == 0) {
            Some(_) => write!(text, "<tr data-case=\"{}\">", escape(&row[0])).expect(GROWS),
            None => text.push_str("<tr>"),
        }
        for &at in &order {
            let (name, cell) = (&table.header[at], &row[at]);
            let class = match numeric[at] {
                _ if doubtful(name, cell) => " class=\"doubtful\"",
                true if hit(name, cell) => " class=\"number hit\"",
                true => " class=\"number\"",
                false => "",
            };
            write!(text, "<td{class}>{}</td>", escape(&row[at])).expect(GROWS);
        }
        text.push_str("</tr>\n");
    }
    text + "</tbody>"
}

/// Ratios of a case's own parameters.
const RATIOS: [&Column; 3] = [&MEASURED_WAVE_HEIGHT_RATIO, &LOG10_K_STAR, &M_STAR];

const GROWS: &str = "a string grows";

/// Whether a column holds only numbers, written out or as powers of ten.
fn is_numeric(table: &Table, column: usize) -> bool {
    let mut cells = table.rows.iter().map(|row| row[column].as_str()).filter(|c| !c.is_empty());
    cells.clone().next().is_some() && cells.all(number::is_number)
}

fn doubtful(column: &str, cell: &str) -> bool {
    let told = column == DOUBTFUL_REASON.name && !cell.is_empty();
    told || column == STATUS.name && cell == DOUBTFUL.name
}

/// Whether the cell says that a wall has come back onto its stop.
fn hit(column: &str, cell: &str) -> bool {
    column == STOPS.name && !matches!(cell, "" | "0")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubtful_cases_are_marked() {
        assert!(doubtful("doubtful_reason", "energy gap -15.2 %"));
        assert!(!doubtful("doubtful_reason", ""));
        assert!(doubtful("status", "doubtful") && !doubtful("status", "ok"));
        assert!(!doubtful("force_gap_percent", "48.1"));
    }

    #[test]
    fn walls_that_hit_their_stops_are_marked() {
        assert!(hit("stops", "2") && !hit("stops", "0") && !hit("stops", "") && !hit("steps", "2"));
        let rows = [["a", "2"], ["b", "0"]].map(|row| row.map(str::to_owned).to_vec());
        let text = grid(&Table::new("summary", "Cases", &["case_id", "stops"], rows.into()));
        assert_eq!(text.matches("class=\"number hit\">2<").count(), 1, "{text}");
    }
}
