//! A made figure in the terminal: its caption, and printed and computed numbers side by side.

use super::output::wrapped;
use super::table::Table;
use crate::report::Reproduced;

/// Columns of a terminal.
const WIDTH: usize = 80;

/// Caption, numbers and sentences.
pub(super) fn text(made: &Reproduced) -> String {
    let mut text = prose(&made.figure.caption);
    if !made.beside.rows.is_empty() {
        text.push_str(&format!("\n{}", numbers(made)));
    }
    made.sentences.iter().for_each(|said| text.push_str(&format!("\n{}", prose(said))));
    text + "\n"
}

/// Prose in lines of a terminal's width.
fn prose(text: &str) -> String {
    wrapped(text, WIDTH).join("\n") + "\n"
}

/// Printed and computed numbers, each with its difference. What all movable or all fixed walls have
/// in common is left out.
fn numbers(made: &Reproduced) -> String {
    let (header, rows) = (&made.beside.header, &made.beside.rows);
    let first = rows[0][0].split(',').next().unwrap_or_default();
    let source = |row: &[String]| row[0].replace(&format!("{first}, "), "").replace("Fig. ", "");
    let parts = |row: &[String]| row[2].split(", ").map(str::to_owned).collect::<Vec<_>>();
    let count = |row: &[String]| parts(row).len();
    let cases = rows.iter().map(|row| {
        let alike = || rows.iter().filter(|other| count(other) == count(row));
        let told = |part: &String| alike().any(|other| !parts(other).contains(part));
        let told: Vec<_> = parts(row).into_iter().filter(told).collect();
        let mixed = alike().count() < rows.len();
        let kind = if row[2].contains("m = ") { "movable" } else { "fixed" };
        if told.is_empty() && mixed { kind.to_owned() } else { told.join(", ") }
    });
    let heads = ["Fig.", "", "case", "printed"].map(str::to_owned).into_iter();
    let laws = header[4..].iter().step_by(2).map(|name| name.replace("computed, ", ""));
    let heads: Vec<_> = heads.chain(laws).collect();
    let lines: Vec<Vec<String>> = rows
        .iter()
        .zip(cases)
        .map(|(row, case)| {
            let cells = [source(row), row[1].clone(), case, row[3].clone()].into_iter();
            let pairs = row[4..].chunks(2).map(|pair| beside(&pair[0], &pair[1]));
            cells.chain(pairs).collect()
        })
        .collect();
    let table = fitting(&heads, &lines);
    if table.contains('✗') { table + "✗: not met\n" } else { table }
}

/// A value and its difference. A common unit stands once.
fn beside(value: &str, difference: &str) -> String {
    let unit = value.rfind(' ').map_or("", |at| &value[at..]);
    let difference = if unit.is_empty() { difference } else { &difference.replacen(unit, "", 1) };
    format!("{value} {difference}").trim().to_owned()
}

/// A table of numbers. Where it is too wide, what a number is stands in a line of its own over its values.
fn fitting(heads: &[String], lines: &[Vec<String>]) -> String {
    let render = |from: usize| {
        let mut table = Table::new(heads[from..].to_vec());
        lines.iter().for_each(|line| table.row(line[from..].to_vec()));
        table.render()
    };
    let whole = render(0);
    if whole.lines().all(|line| line.chars().count() <= WIDTH) {
        return whole;
    }
    let values = render(3);
    let mut values = values.lines();
    let mut text = format!("        {}\n", values.next().unwrap_or_default());
    for (line, values) in lines.iter().zip(values) {
        let what: Vec<_> =
            line[1..3].iter().map(String::as_str).filter(|part| !part.is_empty()).collect();
        let source = match line[0].split_once(", ") {
            Some((paper, number)) => format!("{paper}, Fig. {number}"),
            None => format!("Fig. {}", line[0]),
        };
        text.push_str(&prose(&format!("{source}: {}", what.join(", "))));
        text.push_str(&format!("        {values}\n"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_stands_once() {
        assert_eq!(beside("2.34 s", "+0.1 s ✗"), "2.34 s +0.1 ✗");
        assert_eq!(beside("3.27 m", "+10.6 % ✗"), "3.27 m +10.6 % ✗");
        assert_eq!(beside("2.30", "+1.2 %"), "2.30 +1.2 %");
        assert_eq!(beside("", ""), "");
    }

    #[test]
    fn a_table_that_is_too_wide_gives_each_number_a_line_of_its_own() {
        let owned = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>();
        let heads = owned(&["Fig.", "", "case", "printed", "s = 1"]);
        let short = owned(&["9", "onset", "movable", "2 s", "1.87 s"]);
        let one = fitting(&heads, std::slice::from_ref(&short));
        assert_eq!(
            one,
            "Fig.            case  printed   s = 1\n   9  onset  movable      2 s  1.87 s\n"
        );
        let long = "change of X* max below log₁₀ k* = -1.59";
        let wide = owned(&["13", long, "H/h = 0.6, k = 10 N/m, m = 50 kg/m", "0 %", "9.022 ✗"]);
        let both = fitting(&heads, &[short, wide]);
        assert!(both.lines().all(|line| line.chars().count() <= WIDTH), "{both}");
        assert!(both.starts_with("        printed    s = 1\nFig. 9: onset, movable\n"), "{both}");
        assert!(both.contains(&format!("\nFig. 13: {long}, H/h = 0.6, k")), "{both}");
    }
}
