//! The tables of keys in the docs.

use toml::Table;

use super::key::Key;
use super::shape::Shape;

/// A table in Markdown, a row per key, with a column for the defaults and one more for each named
/// set of values that may stand in for them.
pub fn table(keys: &[&Key], sets: &[(&str, Table)]) -> String {
    let names: String = sets.iter().map(|(name, _)| format!(" `{name}` |")).collect();
    let rule = "---|".repeat(sets.len());
    let defaults = if sets.is_empty() { " default |" } else { "" };
    let rule = if sets.is_empty() { "---|" } else { &rule };
    let mut text =
        format!("| key | unit |{defaults}{names} allowed | meaning |\n|---|---|{rule}---|---|\n");
    for key in keys {
        let value = |set: &Table| match set.get(key.name) {
            Some(value) => format!(" {} |", code(&value.to_string())),
            None => " none |".to_owned(),
        };
        let mut values: String = sets.iter().map(|(_, set)| value(set)).collect();
        if sets.is_empty() {
            values = format!(" {} |", code(&key.default_in_words()));
        }
        let (name, unit) = (key.name, key.rule.unit);
        text += &format!("| `{name}` | {unit} |{values} {} | {} |\n", allowed(key), meaning(key));
    }
    text
}

/// Names in quotes stand as they do in files.
fn code(value: &str) -> String {
    if value.starts_with('"') { format!("`{value}`") } else { value.to_owned() }
}

/// What a key takes.
fn allowed(key: &Key) -> String {
    match (key.shape)() {
        Shape::Names(names) => {
            names.iter().map(|name| format!("`\"{name}\"`")).collect::<Vec<_>>().join(", ")
        }
        _ => key.allowed_in_words(),
    }
}

/// What a key means, and where it means anything.
pub(super) fn meaning(key: &Key) -> String {
    let mut text = key.meaning.trim().to_owned();
    for when in key.conditions() {
        text += &format!(" Only with `{when}`.");
    }
    text
}
