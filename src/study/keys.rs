//! Which section of a case a swept key belongs to, as the scene door itself tells.

use toml::{Table, Value};

use crate::scene::{CaseConfig, ConfigError};

/// Where a swept key goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Scene,
    Numerics,
}

impl Section {
    /// Its name in the file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Section::Scene => "scene",
            Section::Numerics => "numerics",
        }
    }
}

/// Finds the section of a swept key by asking [`CaseConfig::from_tables`] whether it knows it.
///
/// # Errors
/// A key that neither knows, with the nearest that one of them does.
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
    let Some(in_numerics) = unknown(&scene, &numerics, "numerics", key) else {
        return Ok(Section::Numerics);
    };
    let path = format!("grid.{key}");
    let hints = [&in_scene, &in_numerics].map(|error| hint(&error.allowed).map(str::to_owned));
    let known: Vec<_> = hints.into_iter().flatten().collect();
    if known.is_empty() {
        return Err(ConfigError::new(&path, "", in_scene.allowed));
    }
    Err(ConfigError::unknown(&path, &known))
}

/// The error where the door does not know the key.
fn unknown(scene: &Table, numerics: &Table, section: &str, key: &str) -> Option<ConfigError> {
    let error = CaseConfig::from_tables(scene, numerics).err()?;
    let about_it = error.key == format!("{section}.{key}");
    (about_it && error.allowed.starts_with("unknown key")).then_some(error)
}

/// The nearest known key that an error names.
fn hint(allowed: &str) -> Option<&str> {
    allowed.split_once("; did you mean ")?.1.strip_suffix('?')
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
        assert_eq!(section("colour").unwrap_err().to_string(), "grid.colour: unknown key");
        let still = Value::String("hydrostatic".to_owned());
        let told = section_of("wave_height_ratio", Some(&still)).unwrap_err().to_string();
        let message = "grid.wave_height_ratio: unknown key of kind = \"hydrostatic\"; kind = \"seawall\" has it";
        assert_eq!(told, message);
    }
}
