//! The papers, the scenes that their numbers belong to, and why some numbers are not met.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use toml::{Table, Value};

use crate::keys::number;

/// One paper.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paper {
    /// As one cites it in a sentence.
    pub words: String,
    /// Title, journal and pages.
    pub title: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    paper: BTreeMap<String, Paper>,
    scene: BTreeMap<String, Table>,
    cause: BTreeMap<String, String>,
}

static FILE: LazyLock<File> = LazyLock::new(|| {
    let text = include_str!("../../data/papers.toml");
    toml::from_str(text).expect("data/papers.toml is tested")
});

/// A paper by its name.
pub fn paper(name: &str) -> Option<&'static Paper> {
    FILE.paper.get(name)
}

/// The names of the scenes in which a case with these values of `[scene]` stands: those whose keys all
/// have the same values there.
pub fn scenes(values: &Table) -> impl Iterator<Item = &'static str> {
    let fits = |scene: &Table| {
        scene.iter().all(|(key, wanted)| values.get(key).is_some_and(|value| same(value, wanted)))
    };
    FILE.scene.iter().filter(move |(_, scene)| fits(scene)).map(|(name, _)| name.as_str())
}

/// Why a number of this cause is not met, in sentences.
pub fn cause(name: &str) -> Option<&'static str> {
    FILE.cause.get(name).map(String::as_str)
}

/// The same number, whole or not, or the same value.
fn same(value: &Value, wanted: &Value) -> bool {
    match number(value).zip(number(wanted)) {
        Some((value, wanted)) => (value - wanted).abs() <= 1e-9 * wanted.abs(),
        None => value == wanted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::value_of;
    use crate::scene::CaseConfig;

    fn of(scene: &str) -> Vec<&'static str> {
        let config = CaseConfig::from_tables(&scene.parse().unwrap(), &Table::new()).unwrap();
        let values = value_of(&config.scene).unwrap();
        scenes(values.as_table().unwrap()).collect()
    }

    #[test]
    fn the_tank_of_the_papers_is_the_programs_default() {
        assert_eq!(of(""), ["fixed"]);
        let wall = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1\n";
        assert_eq!(of(wall), ["movable"]);
        assert_eq!(of(&format!("{wall}threshold_ratio = 1.2")), [""; 0]);
        assert_eq!(of("tank_length_m = 3"), [""; 0]);
        assert_eq!(of("kind = \"dam-break\""), ["dam-break"]);
        assert_eq!(of("kind = \"hydrostatic\""), ["still-water"]);
    }

    #[test]
    fn causes_are_sentences() {
        for text in FILE.cause.values() {
            assert!(text.ends_with('.') && !text.contains("  "), "{text}");
        }
        assert_eq!(cause("no such cause"), None);
    }
}
