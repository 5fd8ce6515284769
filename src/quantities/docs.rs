//! The tables of columns in `docs/files.md`, and what the Python package knows of columns, made from
//! the declarations.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::unit::ENDINGS;
use super::{Column, Quantity, Read, Unit, energy, envelope, history, summary, wave};

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
    new = replaced(&new, "envelopes", &table(envelope::ALL, |c| format!("`{}`", c.name)));
    new = replaced(&new, "waves", &table(wave::ALL, |c| format!("`{}`", c.name)));
    if std::env::var_os("RENEW_DOCS").is_some() {
        fs::write(&path, new).unwrap();
    } else if new != text {
        panic!(
            "docs/files.md is out of date: RENEW_DOCS=1 cargo test --release --lib quantities::docs"
        );
    }
}

/// A column for readers in other languages.
fn declared<R: Copy>(column: &Quantity<R>, kind: &str) -> Value {
    let what = column.meaning.trim();
    let (name, heading, unit) = (column.name, column.heading(), column.unit.symbol());
    let (bar, bound) = (column.bar, column.bound);
    json!({ "name": name, "kind": kind, "heading": heading, "unit": unit, "what": what, "bar": bar,
        "bound": bound })
}

fn kind(column: &Column) -> &'static str {
    match column.read {
        Read::Text(_) => "text",
        Read::Count(_) => "count",
        Read::Flag(_) => "flag",
        Read::Number(_) | Read::Maximum(_) => "number",
    }
}

/// When a maximum was reached.
fn time(of: &Column) -> Option<Value> {
    let (name, what) = (of.time_name()?, format!("when `{}` was reached", of.name));
    let (heading, unit) = (super::heading(&name), Unit::Seconds.symbol());
    Some(json!({ "name": name, "kind": "number", "heading": heading, "unit": unit, "what": what,
        "bar": null, "bound": null }))
}

#[test]
fn the_python_package_knows_the_columns_that_are_declared() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/src/seawall/quantities.json");
    let summary = summary::ALL.iter().flat_map(|c| [Some(declared(c, kind(c))), time(c)]).flatten();
    let all = json!({
        "summary": summary.collect::<Vec<_>>(),
        "histories": history::ALL.iter().map(|c| declared(c, "number")).collect::<Vec<_>>(),
        "envelopes": envelope::ALL.iter().map(|c| declared(c, "number")).collect::<Vec<_>>(),
        "waves": wave::ALL.iter().map(|c| declared(c, "number")).collect::<Vec<_>>(),
        "energy": energy::ALL.iter().map(|c| declared(c, "number")).collect::<Vec<_>>(),
        "endings": ENDINGS,
    });
    let new = format!("{}\n", serde_json::to_string_pretty(&all).unwrap());
    if std::env::var_os("RENEW_DOCS").is_some() {
        fs::write(&path, new).unwrap();
    } else if fs::read_to_string(&path).ok() != Some(new) {
        let (file, renew) =
            (path.display(), "RENEW_DOCS=1 cargo test --release --lib quantities::docs");
        panic!("{file} is out of date: {renew}");
    }
}
