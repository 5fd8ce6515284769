//! One case of a study and its identity.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::scene::CaseConfig;

/// Part of every case's identity: raised by every change that alters the answer of any case, so
/// that old results are never taken for new ones.
pub const PHYSICS_VERSION: u32 = 19;

/// Names a case by what decides its answer: never host, rank or time. Written as 16 hex digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct CaseId(u64);

impl CaseId {
    /// The id of a case: SHA-256 over its JSON with sorted keys and the physics version.
    pub fn of(config: &CaseConfig) -> CaseId {
        let config = serde_json::to_value(config.without_error_bars())
            .expect("a configuration has a JSON form");
        let mut text = format!("seawall physics {PHYSICS_VERSION}\n");
        write_canonical(&config, &mut text);
        let digest = Sha256::digest(text.as_bytes());
        CaseId(u64::from_be_bytes(digest[..8].try_into().expect("a digest has 32 bytes")))
    }
}

/// The key of the trunk that a case branches from, `None` where its scene does not branch.
pub fn trunk_key(config: &CaseConfig) -> Option<CaseId> {
    config.trunk().map(|trunk| CaseId::of(&trunk))
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

/// JSON with sorted keys, whatever order the map type keeps.
fn write_canonical(value: &Value, text: &mut String) {
    match value {
        Value::Object(map) => {
            let mut entries: Vec<_> = map.iter().collect();
            entries.sort_by_key(|(key, _)| key.as_str());
            text.push('{');
            for (key, value) in entries {
                text.push_str(&format!("{key:?}:"));
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
        scalar => text.push_str(&scalar.to_string()),
    }
}

/// One case of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Place in grid order, from 0.
    pub index: usize,
    /// Identity.
    pub id: CaseId,
    /// What to run.
    pub config: CaseConfig,
    /// The value of each swept key, in the order of the axes; `None` where the key means nothing
    /// to this case (a fixed wall has no spring).
    pub assignments: Vec<Option<toml::Value>>,
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

    #[test]
    fn cases_that_differ_in_the_wall_share_a_trunk() {
        let wall = |k: f64| {
            config(&format!(
                "wall = \"movable\"\nspring_stiffness_n_per_m = {k:?}\nseawall_mass_kg_per_m = 50"
            ))
        };
        assert_eq!(trunk_key(&wall(1.0)), trunk_key(&wall(2.0)));
        assert_ne!(CaseId::of(&wall(1.0)), CaseId::of(&wall(2.0)));
    }
}
