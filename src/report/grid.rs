//! Tables as HTML: headings in symbols, numbers to the right, doubtful values marked.

use std::fmt::Write as _;

use super::number;
use super::tables::Table;
use crate::quantities::heading;
use crate::quantities::summary::DOUBTFUL_REASON;

/// Lists longer than this are folded.
pub(super) const LONG: usize = 30;

/// A table as HTML, folded where it is long.
pub(super) fn grid(table: &Table) -> String {
    let numeric: Vec<_> = (0..table.header.len()).map(|at| is_numeric(table, at)).collect();
    let mut text = "<div class=\"wide\"><table>\n<thead><tr>".to_owned();
    for (name, numeric) in table.header.iter().zip(&numeric) {
        let class = if *numeric { " class=\"number\"" } else { "" };
        write!(text, "<th{class}>{}</th>", escape(&heading(name))).expect("a string grows");
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        text.push_str("<tr>");
        for ((name, cell), numeric) in table.header.iter().zip(row).zip(&numeric) {
            let class = match (doubtful(name, cell), numeric) {
                (true, _) => " class=\"doubtful\"",
                (false, true) => " class=\"number\"",
                (false, false) => "",
            };
            write!(text, "<td{class}>{}</td>", escape(cell)).expect("a string grows");
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>");
    if !table.name.is_empty() {
        write!(text, "<p class=\"file\">tables/{}.csv</p>", table.name).expect("a string grows");
    }
    if table.rows.len() > LONG {
        let count = table.rows.len();
        text = format!("<details><summary>{count} rows</summary>{text}</details>");
    }
    text
}

/// Whether a column holds numbers and nothing else, be they written out or as powers of ten.
fn is_numeric(table: &Table, column: usize) -> bool {
    let mut cells = table.rows.iter().map(|row| row[column].as_str()).filter(|c| !c.is_empty());
    cells.clone().next().is_some() && cells.all(number::is_number)
}

fn doubtful(column: &str, cell: &str) -> bool {
    column == DOUBTFUL_REASON.name && !cell.is_empty()
}

/// Text as it may stand between tags and in attributes.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubtful_cases_are_marked() {
        assert!(doubtful("doubtful_reason", "energy gap -15.2 %"));
        assert!(!doubtful("doubtful_reason", ""));
        assert!(!doubtful("force_gap_percent", "48.1"));
    }
}
