//! What was run, and what failed.

use crate::math::lists::{counts, rising};
use crate::math::words::{counted, listed};
use crate::quantities::summary::{PARTICLE_SPACING, REASON};
use crate::quantities::{heading, named};
use crate::report::curves::distinct;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::data::swept;
use crate::report::page::words::range;
use crate::report::row::Row;
use crate::report::study::Key;

/// How many cases there are, what was swept, and how many cases are finished.
pub fn what(data: &Loaded) -> String {
    let cases = data.rows.len() + data.left();
    // Other kinds of scenes are named: their waves and walls do not show what they are.
    let kind = data.file.as_ref().and_then(|file| file.kind()).filter(|kind| *kind != "seawall");
    let mut over: Vec<_> = kind.map(|kind| kind.replace('-', " ")).into_iter().collect();
    over.extend(swept(data).iter().map(key));
    let over = if over.is_empty() { String::new() } else { format!(": {}", over.join("; ")) };
    format!("{}{over}.{} {}", counted(cases, "case"), spacing(data), ended(data, cases))
}

/// A swept key: a range of numbers, or the words that it took.
fn key(key: &Key) -> String {
    let cells: Vec<_> = key.cells.different().filter(|cell| !cell.is_empty()).collect();
    let read: Option<Vec<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
    if let Some(values) = read {
        let (symbol, unit) = symbol(&key.name);
        return format!("{symbol} = {}", range(&rising(values), &unit));
    }
    let words: Vec<String> = cells.into_iter().map(str::to_owned).collect();
    format!("{} = {}", symbol(&key.name).0, listed(&words))
}

/// How a key is written in a sentence, and its unit.
fn symbol(key: &str) -> (String, String) {
    if let Some(column) = named(key).filter(|column| !column.symbol.is_empty()) {
        return (column.symbol.to_owned(), column.unit.symbol().to_owned());
    }
    let heading = heading(key);
    let (name, unit) = heading.rsplit_once(", ").unwrap_or((&heading, ""));
    (name.to_owned(), unit.to_owned())
}

fn spacing(data: &Loaded) -> String {
    if data.keys.iter().any(|key| key.name == PARTICLE_SPACING.name) {
        return String::new();
    }
    let spacings = distinct(data.rows.iter(), &PARTICLE_SPACING);
    let words: Vec<_> = spacings.iter().map(|spacing| 1000.0 * spacing).collect();
    match &words[..] {
        [] => String::new(),
        [one] => format!(" Particles stand {} mm apart.", number::as_typed(*one)),
        many => format!(" Particles stand {} apart.", range(many, "mm")),
    }
}

fn ended(data: &Loaded, cases: usize) -> String {
    let (done, failed) = (data.finished().count(), data.failed().count());
    match (done, failed, data.left()) {
        (_, 0, 0) if cases == 1 => "It is finished.".to_owned(),
        (_, 0, 0) if cases > 0 => "All are finished.".to_owned(),
        (0, 0, _) => "None is finished yet.".to_owned(),
        (0, _, 0) => "None came to its end.".to_owned(),
        (_, _, 0) => format!("{done} finished, {failed} failed."),
        (_, _, left) => format!("{done} finished, {failed} failed, {left} left to run."),
    }
}

/// How many cases failed, by the kind of failure.
pub fn failed(data: &Loaded) -> Option<String> {
    let kind = |row| {
        let reason: &str = Row::text(row, &REASON);
        let kind = reason.split(" at t = ").next().unwrap_or(reason);
        kind.split(':').next().unwrap_or(kind)
    };
    let kinds = counts(data.failed().map(kind)).into_iter();
    let kinds: Vec<_> = kinds.map(|(kind, count)| format!("{kind} ({count})")).collect();
    let cases = counted(data.failed().count(), "case");
    let they = if cases == "1 case" { "It has" } else { "They have" };
    (!kinds.is_empty()).then(|| format!("{cases} failed: {}. {they} no results.", listed(&kinds)))
}
