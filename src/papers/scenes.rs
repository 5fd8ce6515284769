//! The papers, the scenes of their numbers, and why some numbers are not met.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use toml::{Table, Value};

use crate::keys::number;

/// One paper.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paper {
    /// Its citation in a sentence.
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

/// The names of the scenes to which a case with these values of `[scene]` belongs: all their keys
/// must have the same values there. A key that was added after there were results is left out at
/// its default.
pub fn scenes(values: &Table) -> impl Iterator<Item = &'static str> {
    let has = |key: &str, wanted: &Value| match values.get(key) {
        Some(value) => same(value, wanted),
        None => NEWER.iter().any(|newer| *newer == (key, wanted.as_str().unwrap_or_default())),
    };
    let fits = move |scene: &Table| scene.iter().all(|(key, wanted)| has(key, wanted));
    FILE.scene.iter().filter(move |(_, scene)| fits(scene)).map(|(name, _)| name.as_str())
}

/// Why numbers of this cause are not met, in sentences.
pub fn cause(name: &str) -> Option<&'static str> {
    FILE.cause.get(name).map(String::as_str)
}

/// Values of keys that a case leaves out.
const NEWER: [(&str, &str); 3] = [("paddle", "solitary"), ("behind", "nothing"), ("bed", LEVEL)];
/// A bed that is nowhere above the paddle's foot.
const LEVEL: &str = "level";

/// Whether two values are equal; numbers may be whole or not. A bed of points may also be level.
fn same(value: &Value, wanted: &Value) -> bool {
    let flat = |point: &Value| point.get(1).and_then(number) == Some(0.0);
    match (number(value).zip(number(wanted)), value.as_array()) {
        (Some((value, wanted)), _) => (value - wanted).abs() <= 1e-9 * wanted.abs(),
        (None, Some(points)) if wanted.as_str() == Some(LEVEL) => points.iter().all(flat),
        (None, _) => value == wanted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::value_of;
    use crate::scene::CaseConfig;

    fn of(scene: &str) -> Vec<&'static str> {
        let values = value_of(&CaseConfig::of(scene, "").scene).unwrap();
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

    /// A wall that the wave went over, and one at the end of a beach, were once compared with the
    /// papers. These have a high wall over a level bed.
    #[test]
    fn crests_beds_and_trains_are_none_of_the_papers() {
        assert_eq!(
            of("behind = \"outflow\"\ncrest_freeboard_m = 0.05\ncrest_width_m = 0.3"),
            [""; 0]
        );
        assert_eq!(of("bed = [[0, 0], [1, 0], [2.5, 0.05]]"), [""; 0]);
        let train =
            "paddle = \"wave-train\"\nwave_height_ratio = 0.2\nwave_period_s = 1\nend_time_s = 4";
        assert_eq!(of(train), [""; 0]);
        assert_eq!(of("bed = [[0, 0], [2.5, 0]]"), ["fixed"]);
        assert_eq!(of("behind = \"nothing\"\npaddle = \"solitary\""), ["fixed"]);
    }

    #[test]
    fn causes_are_sentences() {
        for text in FILE.cause.values() {
            assert!(text.ends_with('.') && !text.contains("  "), "{text}");
        }
        assert_eq!(cause("no such cause"), None);
    }
}
