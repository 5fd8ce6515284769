//! Speed against error, from `accuracy.csv` alone: a figure and a page of tables.

use std::path::{Path, PathBuf};

use super::error::ReportError;
use super::load::read_raw;
use super::plots::{self, Dot};
use super::{make, save};

/// The columns of `accuracy.csv`. Rows of the cases `all` and `loads` are a method's sums.
pub const HEADER: [&str; 10] = [
    "case",
    "method",
    "force_error_percent",
    "runup_error_percent",
    "displacement_error_percent",
    "flow_error_percent",
    "error_percent",
    "cpu_time_s",
    "pareto",
    "reason",
];

/// What stands in place of a case for sums.
const GROUPS: [&str; 2] = ["all", "loads"];

/// Error bounds of the tables, percent.
const TARGETS: [f64; 3] = [1.0, 3.0, 10.0];

struct Line<'a> {
    case: &'a str,
    method: &'a str,
    errors: [&'a str; 4],
    error: Option<f64>,
    time: Option<f64>,
    pareto: bool,
    reason: &'a str,
}

/// Writes `figures/error-against-time.svg` and `accuracy.md` into a directory that holds
/// `accuracy.csv`; `about` says what each case is. Returns the page's path.
///
/// # Errors
/// An input that cannot be read, an output that cannot be written.
pub fn write(directory: &Path, about: &[(String, String)]) -> Result<PathBuf, ReportError> {
    let table = read_raw(&directory.join("accuracy.csv"), &HEADER)?;
    let cell = |row: usize, column: usize| table.rows[row].get(column).map_or("", String::as_str);
    let lines: Vec<Line<'_>> = (0..table.rows.len())
        .map(|row| Line {
            case: cell(row, 0),
            method: cell(row, 1),
            errors: [cell(row, 2), cell(row, 3), cell(row, 4), cell(row, 5)],
            error: cell(row, 6).parse().ok(),
            time: cell(row, 7).parse().ok(),
            pareto: cell(row, 8) == "yes",
            reason: cell(row, 9),
        })
        .collect();
    let dots: Vec<Dot<'_>> = lines
        .iter()
        .filter(|line| line.case == "all")
        .filter_map(|line| {
            let (name, pareto) = (line.method, line.pareto);
            Some(Dot { name, x: line.time?, y: line.error?, filled: pareto })
        })
        .collect();
    let figures = directory.join("figures");
    make(&figures)?;
    if let Some(figure) = plots::error_against_time(&dots)? {
        save(&figures.join(format!("{}.svg", figure.name)), &figure.standalone())?;
    }
    let path = directory.join("accuracy.md");
    save(&path, &page(&lines, about))?;
    Ok(path)
}

fn page(lines: &[Line<'_>], about: &[(String, String)]) -> String {
    let mut text = "# Speed against error\n\nWritten by `seawall accuracy` from `accuracy.csv`. \
        Errors are percent of the truth, of the still water depth for runups;\na method's error is \
        the root mean square over all cases and quantities. Times are processor seconds.\n\n\
        ![error against processor time](figures/error-against-time.svg)\n"
        .to_owned();
    for (group, title) in
        [("all", "Methods, all quantities"), ("loads", "Methods, force and displacement alone")]
    {
        let mut sorted: Vec<_> = lines.iter().filter(|line| line.case == group).collect();
        let key = |line: &Line<'_>| line.error.unwrap_or(f64::INFINITY);
        sorted.sort_by(|a, b| key(a).total_cmp(&key(b)));
        text.push_str(&format!(
            "\n## {title}\n\n| method | error, % | processor time, s | on the Pareto front |\n\
             |---|---|---|---|\n"
        ));
        for line in &sorted {
            let mark = if line.pareto { "yes" } else { "" };
            let error = line.error.map_or("a case failed".to_owned(), |e| format!("{e:.2}"));
            let time = number(line.time);
            text.push_str(&format!("| {} | {error} | {time} | {mark} |\n", line.method));
        }
    }
    text.push_str(
        "\n## Cheapest within an error\n\n| case | 1 % | 3 % | 10 % |\n|---|---|---|---|\n",
    );
    let mut cases: Vec<&str> = Vec::new();
    for line in lines {
        if !cases.contains(&line.case) {
            cases.push(line.case);
        }
    }
    for case in &cases {
        let best = TARGETS.map(|target| {
            let good =
                lines.iter().filter(|l| l.case == *case && l.error.is_some_and(|e| e <= target));
            let time = |l: &&Line<'_>| l.time.unwrap_or(f64::INFINITY);
            let best = good.min_by(|a, b| time(a).total_cmp(&time(b)));
            best.map_or("none".to_owned(), |l| format!("{} ({} s)", l.method, number(l.time)))
        });
        text.push_str(&format!("| {case} | {} |\n", best.join(" | ")));
    }
    text.push_str("\n## Every pair\n\n| case | method | F, % | R, % of h | X, % | flow, % | time, s |\n|---|---|---|---|---|---|---|\n");
    for line in lines.iter().filter(|line| !GROUPS.contains(&line.case)) {
        let errors = line.errors.map(|e| number(e.parse().ok()));
        let note = if line.reason.is_empty() {
            errors.join(" | ")
        } else {
            format!("{} | | | ", line.reason)
        };
        text.push_str(&format!(
            "| {} | {} | {note} | {} |\n",
            line.case,
            line.method,
            number(line.time)
        ));
    }
    text.push_str("\n## Cases\n\n");
    for (name, about) in about.iter().filter(|(name, _)| cases.contains(&name.as_str())) {
        text.push_str(&format!("- **{name}**: {about}\n"));
    }
    text
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.2}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_becomes_a_page_and_a_figure() {
        let root = tempfile::tempdir().unwrap();
        let rows = "a,fast,2.0,,,,2.0,1.0,,\na,slow,0.5,,,,0.5,8.0,,\na,sick,,,,,,0.1,,energy-growth\n\
            all,fast,,,,,2.0,1.0,yes,\nall,slow,,,,,0.5,8.0,yes,\nall,sick,,,,,,0.1,no,\n";
        let text = format!("{}\n{rows}", HEADER.join(","));
        std::fs::write(root.path().join("accuracy.csv"), text).unwrap();
        let about = [("a".to_owned(), "a case".to_owned())];
        let page = std::fs::read_to_string(write(root.path(), &about).unwrap()).unwrap();
        assert!(page.contains("| all | slow (8.00 s) | fast (1.00 s) | fast (1.00 s) |"), "{page}");
        assert!(page.contains("| a | sick | energy-growth"));
        let svg = root.path().join("figures/error-against-time.svg");
        let svg = std::fs::read_to_string(svg).unwrap();
        assert!(svg.contains("fast") && svg.contains("slow") && !svg.contains("sick"));
    }
}
