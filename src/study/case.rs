//! One case of a study and its identity.

use std::cell::RefCell;
use std::fmt::{self, Write};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::keys::{Shared, alike};
use crate::scene::{CaseConfig, ErrorBars, Numerics, Scene};

/// Part of every case's identity. It is raised by every change that alters the answer of any case,
/// so that old results are never taken for new ones.
pub const PHYSICS_VERSION: u32 = 54;

/// Identifies a case by everything that decides its answer: never host, rank or time. Written as 16
/// hex digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct CaseId(u64);

impl CaseId {
    /// The id of a case: SHA-256 over its JSON with sorted keys and the physics version.
    pub fn of(config: &CaseConfig) -> CaseId {
        let CaseConfig { scene, numerics, probes } = config;
        let mut rest = String::new();
        if !probes.is_empty() {
            write_entry("probes", probes, &mut rest);
        }
        write_scene(scene, &mut rest);
        rest.push('}');
        let digest = begun(numerics).chain_update(rest).finalize();
        CaseId(u64::from_be_bytes(digest[..8].try_into().expect("a digest has 32 bytes")))
    }

    /// The id as a number.
    pub fn number(self) -> u64 {
        self.0
    }
}

impl fmt::Display for CaseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl FromStr for CaseId {
    type Err = String;

    fn from_str(text: &str) -> Result<CaseId, String> {
        if text.len() != 16 {
            return Err("a case id has 16 hex digits".to_owned());
        }
        u64::from_str_radix(text, 16).map(CaseId).map_err(|error| error.to_string())
    }
}

impl From<CaseId> for String {
    fn from(id: CaseId) -> String {
        id.to_string()
    }
}

impl TryFrom<String> for CaseId {
    type Error = String;

    fn try_from(text: String) -> Result<CaseId, String> {
        text.parse()
    }
}

thread_local! {
    /// The last numerics on this thread, and the hash up to their end. Cases of a study mostly
    /// share them, and they are the larger half of the text.
    static LAST: RefCell<Option<(Shared<Numerics>, Sha256)>> = const { RefCell::new(None) };
}

/// The hash over the physics version and the numerics, which come first in the sorted text.
fn begun(numerics: &Shared<Numerics>) -> Sha256 {
    LAST.with_borrow_mut(|last| {
        if let Some((known, hash)) = last
            && known == numerics
        {
            return hash.clone();
        }
        let mut own = numerics.clone();
        if own.error_bars != ErrorBars::None {
            own.error_bars = ErrorBars::None;
        }
        let mut text = format!("seawall physics {PHYSICS_VERSION}\n{{");
        write_entry("numerics", &own, &mut text);
        let hash = Sha256::new_with_prefix(text);
        *last = Some((numerics.clone(), hash.clone()));
        hash
    })
}

/// An entry of a JSON object, followed by a comma.
fn write_entry(key: &str, value: &impl Serialize, text: &mut String) {
    let value = serde_json::to_value(value).expect("a configuration has a JSON form");
    write_key(key, text);
    write_canonical(&value, text);
    text.push(',');
}

/// An entry of a scene and its text.
type Written = (&'static str, toml::Value, String);

thread_local! {
    /// The entries of the last scene on this thread: the cases of a study differ only in a few.
    static ENTRIES: RefCell<Vec<Written>> = const { RefCell::new(Vec::new()) };
}

/// The entry of a scene, written without making its table first.
fn write_scene(scene: &Scene, text: &mut String) {
    let mut entries = scene.entries();
    entries.sort_unstable_by_key(|(key, _)| *key);
    write_key("scene", text);
    text.push('{');
    ENTRIES.with_borrow_mut(|last| {
        for (place, (key, value)) in entries.into_iter().enumerate() {
            let known = |(name, own, _): &&Written| *name == key && alike(own, &value);
            if let Some((.., own)) = last.get(place).filter(known) {
                text.push_str(own);
                continue;
            }
            let mut own = String::new();
            write_entry(key, &value, &mut own);
            text.push_str(&own);
            match last.get_mut(place) {
                Some(there) => *there = (key, value, own),
                None => last.push((key, value, own)),
            }
        }
    });
    text.push_str("},");
}

/// A key as in Rust's own `{key:?}:`. Usually nothing has to be escaped, and this saves time for a
/// million cases.
fn write_key(key: &str, text: &mut String) {
    if key.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_') {
        text.push('"');
        text.push_str(key);
        text.push_str("\":");
    } else {
        text.push_str(&format!("{key:?}:"));
    }
}

/// JSON with sorted keys, for any order of the map type.
fn write_canonical(value: &Value, text: &mut String) {
    match value {
        Value::Object(map) => {
            let mut entries: Vec<_> = map.iter().collect();
            entries.sort_by_key(|(key, _)| key.as_str());
            text.push('{');
            for (key, value) in entries {
                write_key(key, text);
                write_canonical(value, text);
                text.push(',');
            }
            text.push('}');
        }
        Value::Array(values) => {
            text.push('[');
            for value in values {
                write_canonical(value, text);
                text.push(',');
            }
            text.push(']');
        }
        scalar => write!(text, "{scalar}").expect("text takes it all"),
    }
}

/// Values of the swept keys of one case, as in [`Case::assignments`].
pub type Assignments = Vec<Option<Shared<toml::Value>>>;

/// One case of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Place in grid order, from 0.
    pub index: usize,
    /// Identity.
    pub id: CaseId,
    /// What to run.
    pub config: CaseConfig,
    /// The value of each swept key, in the order of the axes. `None` if the key means nothing to
    /// this case (a fixed wall has no spring).
    pub assignments: Assignments,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn config(scene: &str) -> CaseConfig {
        CaseConfig::from_tables(&scene.parse().unwrap(), &"".parse().unwrap()).unwrap()
    }

    #[test]
    fn an_id_depends_on_the_answer_only() {
        let id = CaseId::of(&config("wave_height_ratio = 0.3"));
        assert_eq!(id, CaseId::of(&config("tank_length_m = 2.5\nwave_height_ratio = 0.30")));
        assert_ne!(id, CaseId::of(&config("wave_height_ratio = 0.4")));
        assert_eq!(id.to_string().parse(), Ok(id));
        assert!("12".parse::<CaseId>().is_err());
    }

    /// The id is the hash of one text. Hashing it in two parts must not change it.
    #[test]
    fn an_id_is_that_of_the_whole_text() {
        let probe = "name = \"P\"\nkind = \"level\"\nx_m = 1".parse().unwrap();
        for (scene, probes) in [("", vec![]), ("wave_height_ratio = 0.3", vec![probe])] {
            let bars = "error_bars = \"pair\"".parse().unwrap();
            let config = CaseConfig::with_probes(&scene.parse().unwrap(), &bars, &probes).unwrap();
            let value = serde_json::to_value(config.without_error_bars()).unwrap();
            let mut text = format!("seawall physics {PHYSICS_VERSION}\n");
            write_canonical(&value, &mut text);
            let digest = Sha256::digest(text);
            let whole = u64::from_be_bytes(digest[..8].try_into().unwrap());
            assert_eq!(CaseId::of(&config), CaseId(whole));
        }
    }

    #[test]
    fn cases_that_differ_in_the_wall_share_a_trunk() {
        let wall = |k: f64| {
            config(&format!(
                "wall = \"movable\"\nspring_stiffness_n_per_m = {k:?}\nseawall_mass_kg_per_m = 50"
            ))
        };
        let trunk = |k: f64| CaseId::of(&wall(k).trunk().unwrap());
        assert_eq!(trunk(1.0), trunk(2.0));
        assert_ne!(CaseId::of(&wall(1.0)), CaseId::of(&wall(2.0)));
    }
}
