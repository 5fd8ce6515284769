//! The tables of columns in `docs/files.md`, made from the declarations.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::{Quantity, energy, history, summary};

fn line(text: &mut String, names: &str, unit: &str, meaning: &str) {
    writeln!(text, "| {names} | {unit} | {} |", meaning.trim()).unwrap();
}

fn table<R: Copy>(all: &[&Quantity<R>], names: impl Fn(&Quantity<R>) -> String) -> String {
    let mut text = "| column | unit | what |\n|---|---|---|\n".to_owned();
    for column in all {
        line(&mut text, &names(column), column.unit.symbol(), column.meaning);
    }
    text
}

/// The text with the lines between two markers replaced.
fn replaced(text: &str, name: &str, table: &str) -> String {
    let (start, end) = (format!("<!-- columns of {name} -->\n"), "<!-- end of columns -->");
    let (before, rest) = text.split_once(&start).unwrap_or_else(|| panic!("no {start}"));
    let (_, after) = rest.split_once(end).unwrap_or_else(|| panic!("no {end}"));
    format!("{before}{start}\n{table}\n{end}{after}")
}

#[test]
fn the_columns_in_the_documentation_are_those_that_are_declared() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/files.md");
    let text = fs::read_to_string(&path).unwrap();
    let with_time = |column: &super::Column| match column.time_name() {
        Some(time) => format!("`{}`, `{time}`", column.name),
        None => format!("`{}`", column.name),
    };
    let mut new = replaced(&text, "summary.csv", &table(summary::ALL, with_time));
    new = replaced(&new, "histories", &table(history::ALL, |c| format!("`{}`", c.name)));
    new = replaced(&new, "energy.csv", &table(energy::ALL, |c| format!("`{}`", c.name)));
    if std::env::var_os("RENEW_DOCS").is_some() {
        fs::write(&path, new).unwrap();
    } else if new != text {
        panic!("docs/files.md is out of date: RENEW_DOCS=1 cargo test --lib quantities::docs");
    }
}
