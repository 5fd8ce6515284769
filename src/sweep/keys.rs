//! Which section of a case a swept key belongs to, as the scene door itself tells.

use toml::{Table, Value};

use crate::scene::{CaseConfig, ConfigError};

/// Where a swept key goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Scene,
    Numerics,
}

/// Finds the section of a swept key by asking [`CaseConfig::from_tables`] whether it knows it.
pub(super) fn section_of(key: &str, kind: Option<&Value>) -> Result<Section, ConfigError> {
    let mut scene = Table::new();
    if let Some(kind) = kind {
        scene.insert("kind".to_owned(), kind.clone());
    }
    let probe = Value::Boolean(true);
    let mut with_key = scene.clone();
    with_key.insert(key.to_owned(), probe.clone());
    let Some(in_scene) = unknown(&with_key, &Table::new(), "scene", key) else {
        return Ok(Section::Scene);
    };
    let numerics = Table::from_iter([(key.to_owned(), probe)]);
    let Some(in_numerics) = unknown(&Table::new(), &numerics, "numerics", key) else {
        return Ok(Section::Numerics);
    };
    let nearest = [in_scene, in_numerics].into_iter().flatten().collect::<Vec<_>>();
    Err(ConfigError::unknown(&format!("grid.{key}"), &nearest))
}

/// `Some` (with the nearest known key) where the door does not know the key.
fn unknown(scene: &Table, numerics: &Table, section: &str, key: &str) -> Option<Option<String>> {
    let error = CaseConfig::from_tables(scene, numerics).err()?;
    if error.key != format!("{section}.{key}") {
        return None;
    }
    let hint = error.allowed.strip_prefix("unknown key")?;
    let nearest = hint.strip_prefix("; did you mean ").and_then(|rest| rest.strip_suffix('?'));
    Some(nearest.map(str::to_owned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_find_their_section() {
        let section = |key| section_of(key, None);
        for key in ["wave_height_ratio", "spring_stiffness_n_per_m", "wall", "kind", "end_time_s"] {
            assert_eq!(section(key), Ok(Section::Scene), "{key}");
        }
        for key in ["kernel", "particle_spacing_m", "preset", "time_step_s", "precision"] {
            assert_eq!(section(key), Ok(Section::Numerics), "{key}");
        }
        let told = section("wave_hight_ratio").unwrap_err().to_string();
        assert_eq!(told, "grid.wave_hight_ratio: unknown key; did you mean wave_height_ratio?");
    }
}
