//! `seawall explain`: what a key of a file or a column of a table means, from its declaration.

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::glossary::{Entry, entries, joined};
use super::output::{Output, wrapped};
use super::readme_words::{names, thing};
use crate::keys::hint;
use crate::quantities::{is_meant, meant_by};

/// Explain a key of a sweep or scene file, or a column of a table: its meaning, unit, range and default. It explains
/// the words of the README, too, such as caisson or companion. Without a name, list all keys and columns.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall explain spring_stiffness_n_per_m
  seawall explain force_max
  seawall explain 'F*'
  seawall explain 'error bar'
  seawall explain
  seawall explain numerics.courant_number --format json")]
pub(super) struct ExplainArgs {
    /// The key or the column, its symbol, what `check` calls it, or a word of the README. A key may have its section before it, as in
    /// numerics.kernel.
    #[arg(value_name = "KEY|COLUMN|WORD")]
    name: Option<String>,
}

pub(super) fn main(args: &ExplainArgs, output: &Output) -> anyhow::Result<u8> {
    let all = entries();
    let Some(name) = &args.name else {
        output.result(&list(&all), &json!({ "entries": all }))?;
        return Ok(SUCCESS);
    };
    let picked =
        |is_one: &dyn Fn(&&Entry) -> bool| joined(all.iter().filter(is_one).cloned().collect());
    let mut found = picked(&|entry| entry.is_called(name));
    if found.is_empty() {
        found = picked(&|entry| is_meant(name, &entry.symbol));
    }
    if found.is_empty() {
        found = picked(&|entry| entry.label.eq_ignore_ascii_case(name));
    }
    if found.is_empty() {
        found = thing(name, &all).into_iter().collect();
    }
    if found.is_empty() {
        let leaf = name.rsplit('.').next().unwrap_or(name);
        let mut known: Vec<&str> = all.iter().map(|entry| entry.name.as_str()).collect();
        names().for_each(|name| known.push(name));
        let near = meant_by(name).unwrap_or_else(|| hint(leaf, &known));
        let told = "no key, no column and no word of the README has this name";
        let list = " (`seawall explain` lists all)";
        return Err(BadInput(format!("{name}: {told}{near}{list}")).into());
    }
    let texts: Vec<_> = found.iter().map(explained).collect();
    output.result(&texts.join("\n"), &json!({ "entries": found }))?;
    Ok(SUCCESS)
}

/// The width of a line, characters.
const WIDTH: usize = 80;
/// The column where a meaning, a unit or a default begins.
const INDENT: usize = 11;

fn explained(entry: &Entry) -> String {
    let mut text = format!("{}: {}\n", entry.name, entry.of);
    let mut lines = vec![
        ("symbol", &entry.symbol),
        ("meaning", &entry.meaning),
        ("unit", &entry.unit),
        ("allowed", &entry.allowed),
        ("default", &entry.default),
    ];
    let of_preset = |(name, value): (&&str, &String)| format!("{value} with preset = \"{name}\"");
    let presets: Vec<_> = entry.presets.iter().map(of_preset).collect();
    lines.extend(presets.iter().chain(&entry.suited).map(|told| ("or", told)));
    let read = if entry.read_only.is_empty() { "" } else { "with " }.to_owned() + &entry.read_only;
    lines.extend([("only with", &entry.only), ("read only", &read), ("see also", &entry.besides)]);
    for (label, value) in lines.into_iter().filter(|(_, value)| !value.is_empty()) {
        let lines = wrapped(value, WIDTH - INDENT - 2);
        for (number, line) in lines.iter().enumerate() {
            let label = if number == 0 { label } else { "" };
            text.push_str(&format!("  {label:<INDENT$}{line}\n"));
        }
    }
    text
}

/// Names and units, with a heading for each group.
fn list(all: &[Entry]) -> String {
    let mut text = String::new();
    let mut group = "";
    for entry in all {
        if entry.of != group {
            group = &entry.of;
            let gap = if text.is_empty() { "" } else { "\n" };
            text.push_str(&format!("{gap}{group}\n"));
        }
        let line = format!("  {:<32} {}", entry.name, entry.unit);
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
