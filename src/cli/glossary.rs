//! Every declared key and column, in words.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::keys::{Key, Section};
use crate::quantities::{Quantity, energy, envelope, history, named, summary, wave};
use crate::scene::{Kind, Numerics, Preset, numerics_keys, other_defaults, probe_keys, scene_keys};
use crate::study::{accuracy_keys, limits_keys, refine_keys};

/// The place of the keys of numerics.
const NUMERICS: &str = "key of [numerics]";
/// The place of the keys of `refine`.
const REFINE: &str = "key of [grid] refine";
/// The place of the keys of a kind of scenes, without the kind's name.
const KIND: &str = "key of [scene], kind =";

/// A key or a column.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Entry {
    /// Its name.
    pub name: String,
    /// The section or table that it is in.
    pub of: String,
    /// What `check` and the page call a key.
    #[serde(skip)]
    pub label: String,
    /// What tables print in place of the name.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub symbol: String,
    /// What it is.
    pub meaning: String,
    /// Its unit, empty for words and ratios.
    pub unit: String,
    /// What a key may hold.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub allowed: String,
    /// What a key holds where a file does not give it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub default: String,
    /// What it holds by default in some scenes, where that is something else.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub suited: Vec<String>,
    /// What presets make the default, where that is something else.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub presets: BTreeMap<&'static str, String>,
    /// Where a key is allowed, if not everywhere.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub only: String,
    /// Where a key is read, if not wherever it is allowed.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub read_only: String,
    /// Other columns that belong to a column.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub besides: String,
}

impl Entry {
    /// Whether this entry is meant by a name. A key may have its section before it. A column of a
    /// time is explained with the value that it belongs to.
    pub(super) fn is_called(&self, name: &str) -> bool {
        let (section, leaf) = name.rsplit_once('.').unwrap_or(("", name));
        let in_refine_section = ["refine", "grid.refine"].contains(&section) && self.of == REFINE;
        let in_section =
            section.is_empty() || in_refine_section || self.of.contains(&format!("[{section}]"));
        let in_refine = ["refine", "grid.refine"].contains(&name) && self.of == REFINE;
        let of_time = self.besides.split(", ").any(|other| other == format!("time {leaf}"));
        in_refine || in_section && (self.name == leaf || of_time)
    }
}

/// All entries, group by group.
pub(super) fn entries() -> Vec<Entry> {
    let kinds = std::iter::once(Kind::DEFAULT)
        .chain(Kind::ALL.iter().copied().filter(|kind| *kind != Kind::DEFAULT));
    let of_kind = |kind: Kind| {
        let of = format!("{KIND} {:?}", kind.name());
        scene_keys(kind).into_iter().map(move |key| of_key(key, &of))
    };
    let mut all: Vec<_> = kinds.flat_map(of_kind).collect();
    let groups = [
        (NUMERICS, numerics_keys()),
        ("key of [[probe]]", probe_keys()),
        ("key of [accuracy]", accuracy_keys()),
        ("key of [limits]", limits_keys()),
        (REFINE, refine_keys()),
    ];
    for (of, keys) in groups {
        all.extend(keys.into_iter().map(|key| of_key(key, of)));
    }
    all.extend(summary::ALL.iter().map(|column| of_summary(column)));
    all.extend(history::ALL.iter().map(|column| of_column(column, "column of histories/*.csv")));
    all.extend(envelope::ALL.iter().map(|column| of_column(column, "column of envelopes/*.csv")));
    all.extend(wave::ALL.iter().map(|column| of_column(column, "column of waves/*.csv")));
    all.extend(energy::ALL.iter().map(|column| of_column(column, "column of energy.csv")));
    all
}

/// Joins entries that several kinds of scenes share into one, with the names of all these kinds.
pub(super) fn joined(all: Vec<Entry>) -> Vec<Entry> {
    let mut told: Vec<(Entry, String)> = Vec::new();
    for entry in all {
        let alike = |(other, _): &&mut (Entry, String)| {
            entry.of.contains(KIND) && Entry { of: other.of.clone(), ..entry.clone() } == *other
        };
        match told.iter_mut().find(alike) {
            Some((_, more)) => more.push_str(&entry.of.replace(KIND, ",")),
            None => told.push((entry, String::new())),
        }
    }
    told.into_iter().map(|(entry, more)| Entry { of: entry.of.clone() + &more, ..entry }).collect()
}

fn of_key(key: &Key, of: &str) -> Entry {
    let others = other_defaults(key.name).filter(|_| of == NUMERICS);
    Entry {
        name: key.name.to_owned(),
        of: of.to_owned(),
        label: key.label(),
        symbol: named(key.name).map_or("", |column| column.symbol).to_owned(),
        meaning: key.meaning_in_words(),
        unit: key.rule.unit.to_owned(),
        allowed: key.allowed_in_words(),
        default: key.default_in_words(),
        suited: others.map(|told| without_links(&told)).collect(),
        presets: if of == NUMERICS { of_presets(key) } else { BTreeMap::new() },
        only: key.allowed_where(),
        read_only: key.read_where(),
        ..Entry::default()
    }
}

/// What the presets give a key, where they differ from the default and their scheme reads it.
fn of_presets(key: &Key) -> BTreeMap<&'static str, String> {
    let presets = [("huang2019", Preset::Huang2019), ("isph", Preset::Isph)];
    let own = presets.into_iter().filter_map(|(name, preset)| {
        let table = Numerics::preset(preset).table();
        let scheme = table.get("scheme").and_then(toml::Value::as_str).unwrap_or("wcsph");
        let only = key.rule.only.filter(|when| when.key == "scheme");
        let is_read = only.is_none_or(|when| when.values.contains(&scheme));
        let value = table.get(key.name).filter(|_| is_read)?.to_string();
        (value != key.default_in_words()).then_some((name, value))
    });
    own.collect()
}

fn of_summary(column: &crate::quantities::Column) -> Entry {
    let mut besides = Vec::new();
    besides.extend(column.time_name().map(|name| format!("time {name}")));
    besides.extend(column.bar.map(|name| format!("error bar {name}")));
    besides.extend(column.bound.map(|name| format!("lower bound where {name}")));
    Entry { besides: besides.join(", "), ..of_column(column, "column of summary.csv") }
}

fn of_column<R: Copy>(column: &Quantity<R>, of: &str) -> Entry {
    Entry {
        name: column.name.to_owned(),
        of: of.to_owned(),
        symbol: column.symbol.to_owned(),
        meaning: without_links(column.meaning),
        unit: column.unit.symbol().to_owned(),
        ..Entry::default()
    }
}

/// A meaning in one line, where `[words](target)` becomes the words alone.
pub(super) fn without_links(text: &str) -> String {
    let mut words = text.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "");
    while let Some((start, middle)) = words.find('[').zip(words.find("](")) {
        let Some(end) = words[middle..].find(')') else { break };
        let inner = words[start + 1..middle].to_owned();
        words.replace_range(start..=middle + end, &inner);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_says_what_it_is() {
        for entry in entries() {
            assert!(!entry.meaning.is_empty(), "{}", entry.name);
            assert!(!entry.meaning.contains("]("), "{}", entry.meaning);
        }
    }

    #[test]
    fn a_name_may_have_its_section_and_times_are_explained_with_their_values() {
        let names = |name: &str| -> Vec<_> {
            let all = entries().into_iter().filter(|entry| entry.is_called(name));
            all.map(|entry| format!("{}: {}", entry.name, entry.of)).collect()
        };
        assert_eq!(names("numerics.kernel"), ["kernel: key of [numerics]"]);
        assert_eq!(names("force_max_time_s"), ["force_max: column of summary.csv"]);
        assert_eq!(names("kernel").len(), 2);
        assert_eq!(names("refine").len(), refine_keys().len(), "the table's keys");
        assert_eq!(names("refine.to"), ["to: key of [grid] refine"]);
        assert_eq!(names("grid.refine.to"), names("refine.to"));
        assert!(names("colour").is_empty());
    }
}
