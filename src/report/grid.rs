//! Tables as HTML: headings in symbols, numbers to the right, doubtful values marked.

use std::fmt::Write as _;

use super::number;
use super::tables::Table;

/// Endings of columns and keys that tell their unit.
const UNITS: [(&str, &str); 10] = [
    ("_n_per_m", "N/m"),
    ("_kg_per_m", "kg/m"),
    ("_kg_per_m3", "kg/m³"),
    ("_m_per_s2", "m/s²"),
    ("_m_per_s", "m/s"),
    ("_percent", "%"),
    ("_deg", "°"),
    ("_j", "J"),
    ("_m", "m"),
    ("_s", "s"),
];

/// Lists longer than this are folded.
pub(super) const LONG: usize = 30;

/// What a column is called on the page and in figures.
pub(super) fn heading(column: &str) -> String {
    let words = match column {
        "case_id" => "case",
        "wave_height_ratio" => "H/h",
        "measured_wave_height_ratio" => "H/h measured",
        "spring_stiffness_n_per_m" => "k, N/m",
        "seawall_mass_kg_per_m" => "m, kg/m",
        "log10_k_star" => "log₁₀ k*",
        "m_star" => "m*",
        "first_force_max" => "first F*",
        "first_runup_max" => "first R*",
        "force_max" => "largest F*",
        "runup_max" => "largest R*",
        "displacement_max" => "largest X*",
        "displacement_truncated" => "still moving",
        "force_coupling" => "s",
        _ => {
            let unit = UNITS.iter().find_map(|(end, unit)| Some((column.strip_suffix(end)?, unit)));
            let (name, unit) = unit.unwrap_or((column, &""));
            let comma = if unit.is_empty() { "" } else { ", " };
            return format!("{}{comma}{unit}", name.replace('_', " "));
        }
    };
    words.to_owned()
}

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
    column == "doubtful_reason" && !cell.is_empty()
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
