//! The tables of keys in `docs/files.md` are those of the declarations.

use std::fs;
use std::path::Path;

use seawall::keys::{Key, Section, Shape};
use seawall::scene::{
    Kind, Numerics, Preset, SUITED, numerics_keys, other_defaults, probe_keys, scene_keys,
};
use seawall::study::{limits_keys, refine_keys};
use toml::{Table, Value};

/// A table in Markdown, a row per key, with a column for the defaults and one more for each named
/// set of values that may stand in for them.
fn table(keys: &[&Key], sets: &[(&str, Table)]) -> String {
    let names: String = sets.iter().map(|(name, _)| format!(" `{name}` |")).collect();
    let rule = "---|".repeat(sets.len());
    let defaults = if sets.is_empty() { " default |" } else { "" };
    let rule = if sets.is_empty() { "---|" } else { &rule };
    let mut text =
        format!("| key | unit |{defaults}{names} allowed | meaning |\n|---|---|{rule}---|---|\n");
    for key in keys {
        let scheme =
            |set: &Table| set.get("scheme").and_then(Value::as_str).unwrap_or("wcsph").to_owned();
        let is_read = |set: &Table| {
            let only = key.rule.only.filter(|when| when.key == "scheme");
            only.is_none_or(|when| when.values.contains(&scheme(set).as_str()))
        };
        // A set that leaves a key out leaves its own default.
        let value = |set: &Table| match set.get(key.name) {
            _ if !is_read(set) => " none |".to_owned(),
            Some(value) => format!(" {} |", code(&value.to_string())),
            None => format!(" {} |", code(&key.default_in_words())),
        };
        let mut values: String = sets.iter().map(|(_, set)| value(set)).collect();
        if sets.is_empty() {
            values = format!(" {} |", code(&key.default_in_words()));
        }
        let suited = !sets.is_empty() && other_defaults(key.name).next().is_some();
        let others = if suited {
            " [Other defaults](water.md#defaults-by-scene) in some scenes."
        } else {
            ""
        };
        let (name, unit) = (key.name, key.rule.unit);
        text += &format!(
            "| `{name}` | {unit} |{values} {} | {}{others} |\n",
            allowed(key),
            // A bar would end the cell.
            key.meaning_and_place().replace('|', "\\|")
        );
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

/// The table that belongs between two markers.
fn of(name: &str) -> String {
    let kind = Kind::ALL.iter().find(|kind| Some(kind.name()) == name.strip_prefix("scene "));
    match (name, kind) {
        // `kind` itself stands first, and is told once.
        (_, Some(&kind)) => table(&scene_keys(kind)[usize::from(kind != Kind::DEFAULT)..], &[]),
        ("probe", _) => table(&probe_keys(), &[]),
        ("limits", _) => table(&limits_keys(), &[]),
        ("refine", _) => table(&refine_keys(), &[]),
        ("numerics", _) => {
            let presets = [
                ("default", Preset::Default),
                ("huang2019", Preset::Huang2019),
                ("isph", Preset::Isph),
            ];
            table(&numerics_keys(), &presets.map(|(name, of)| (name, Numerics::preset(of).table())))
        }
        _ => panic!("there are no keys of {name:?}"),
    }
}

#[test]
fn the_docs_have_the_tables_of_the_declarations() {
    const END: &str = "<!-- end of keys -->";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/files.md");
    let text = fs::read_to_string(&path).unwrap();
    let mut parts = text.split("<!-- keys of ");
    let mut renewed = parts.next().unwrap().to_owned();
    let mut tables = 0;
    for part in parts {
        let (name, rest) = part.split_once(" -->").unwrap();
        let (_, rest) = rest.split_once(END).unwrap();
        renewed += &format!("<!-- keys of {name} -->\n{}{END}{rest}", of(name));
        tables += 1;
    }
    assert_eq!(tables, Kind::ALL.len() + 4, "every section has its table");
    renew_or_compare(&path, &text, &renewed);
}

/// Writes a document anew where that is asked for, or tells that it is out of date.
fn renew_or_compare(path: &Path, text: &str, renewed: &str) {
    if std::env::var_os("RENEW_DOCS").is_some() {
        fs::write(path, renewed).unwrap();
    } else {
        assert!(
            renewed == text,
            "{} is out of date: run `RENEW_DOCS=1 cargo test --release --test house key_tables`",
            path.display()
        );
    }
}

/// The story: a default of some scenes changes in the code, and the document goes on telling the old one.
#[test]
fn the_docs_have_the_defaults_by_scene() {
    const START: &str = "<!-- defaults by scene -->\n";
    const END: &str = "<!-- end of defaults -->";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/water.md");
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(START).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let mut table = "| scenes | keys | why |\n|---|---|---|\n".to_owned();
    for suited in SUITED {
        let keys = suited.keys.iter().map(|(key, value)| format!("`{key} = {value}`"));
        let keys = keys.collect::<Vec<_>>().join(", ");
        table += &format!("| {} | {keys} | {} |\n", suited.scenes, suited.why);
    }
    renew_or_compare(&path, &text, &format!("{before}{START}{table}{END}{after}"));
}

/// The story: the bars of Σ|w_j| ended a cell, and the words behind them were in no column.
#[test]
fn every_row_of_the_tables_has_as_many_cells_as_its_head() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/files.md");
    let text = fs::read_to_string(&path).unwrap();
    let mut cells = 0;
    for (number, line) in text.lines().enumerate() {
        if !line.starts_with('|') {
            cells = 0;
            continue;
        }
        let own = line.replace("\\|", "").matches('|').count();
        cells = if cells == 0 { own } else { cells };
        assert_eq!(own, cells, "docs/files.md:{}: {line}", number + 1);
    }
}

#[test]
fn units_end_names() {
    let scenes = Kind::ALL.iter().flat_map(|&kind| scene_keys(kind));
    for key in scenes.chain(numerics_keys()).chain(probe_keys()).chain(limits_keys()) {
        assert!(key.name.ends_with(&key.unit_in_name()), "{}: {}", key.name, key.rule.unit);
        assert!(!key.meaning.trim().is_empty(), "{}: what does it mean?", key.name);
    }
}

/// A new choice that its strength does not name would run with it, and `seawall check` would not tell so.
#[test]
fn a_choice_that_is_on_reads_its_strength() {
    let all = numerics_keys();
    let key = |name: &str| all.iter().find(|key| key.name == name).unwrap();
    for choice in ["density_diffusion", "shifting"] {
        let Shape::Names(names) = (key(choice).shape)() else { panic!("{choice} has no names") };
        let strength = key(&format!("{choice}_coefficient"));
        let read = strength.rule.read.expect("it is read at some choices alone");
        for name in names.iter().filter(|name| **name != "none") {
            let told = "must be among those where";
            assert!(
                read.values.contains(name),
                "{choice} = {name:?} {told} {} is read",
                strength.name
            );
        }
    }
}
