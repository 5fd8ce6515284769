//! All declared keys of a case, and the right place of a key in the wrong place.

use toml::Table;

use super::kind::{Kind, OfKind};
use super::numerics::Numerics;
use super::numerics_of_scene::Base;
use super::probe::Probe;
use crate::keys::{ConfigError, Key, Section, Shape};

/// A section whose keys a grid may sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// `[scene]`.
    Scene,
    /// `[numerics]`.
    Numerics,
}

impl Place {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Place::Scene => OfKind::NAME,
            Place::Numerics => Numerics::NAME,
        }
    }

    /// Whether it has a key, in a file with this kind of scene.
    fn has(self, kind: Kind, name: &str) -> bool {
        match self {
            Place::Scene => OfKind::has(name) || kind.has(name),
            Place::Numerics => Base::has(name) || Numerics::has(name),
        }
    }
}

/// The keys of a `[scene]` of this kind.
pub fn scene_keys(kind: Kind) -> Vec<&'static Key> {
    [OfKind::keys(), kind.keys()].concat()
}

/// Where a key of `[scene]` in a wave tank belongs, as errors say it: `belongs to wall = "movable"`.
#[cfg(test)]
pub(crate) fn belongs(key: &str) -> String {
    let key = scene_keys(Kind::Seawall).into_iter().find(|own| own.name == key);
    format!("belongs to {}", key.unwrap().rule.only.unwrap())
}

/// The keys of `[numerics]`.
pub fn numerics_keys() -> Vec<&'static Key> {
    [Base::keys(), Numerics::keys()].concat()
}

/// The keys of a `[[probe]]`.
pub fn probe_keys() -> Vec<&'static Key> {
    Probe::keys()
}

/// The section of a swept key, in a file with this `[scene]`.
///
/// # Errors
/// A key that no section knows, with the nearest known one; an unknown kind.
pub fn place_of(key: &str, scene: &Table) -> Result<Place, ConfigError> {
    let kind = Kind::of(scene)?;
    if let Some(place) =
        [Place::Scene, Place::Numerics].into_iter().find(|place| place.has(kind, key))
    {
        return Ok(place);
    }
    let known = [scene_keys(kind), numerics_keys()].concat();
    Err(unknown(&format!("grid.{key}"), key, kind, &known))
}

/// Whether a swept key only takes whole numbers, in a file with this `[scene]`.
pub fn takes_whole(key: &str, scene: &Table) -> bool {
    let scene = Kind::of(scene).map(scene_keys).unwrap_or_default();
    let known = [scene, numerics_keys()].concat();
    known.iter().any(|known| known.name == key && (known.shape)() == Shape::Whole)
}

/// The errors of all keys that a section of a file with this `[scene]` does not know. None if the
/// scene's kind is unknown.
pub fn unknown_keys(place: Place, scene: &Table, table: &Table) -> Vec<ConfigError> {
    Kind::of(scene).map(|kind| unknown_of(place, kind, table)).unwrap_or_default()
}

/// Refuses a key that a section of a file with this kind of scene does not know.
pub(super) fn refuse_unknown(place: Place, kind: Kind, table: &Table) -> Result<(), ConfigError> {
    unknown_of(place, kind, table).into_iter().next().map_or(Ok(()), Err)
}

fn unknown_of(place: Place, kind: Kind, table: &Table) -> Vec<ConfigError> {
    let unknown_here = |key: &&String| !place.has(kind, key);
    let error = |key: &String| {
        let path = format!("{}.{key}", place.name());
        let (known, other) = match place {
            Place::Scene => (scene_keys(kind), Place::Numerics),
            Place::Numerics => (numerics_keys(), Place::Scene),
        };
        match other.has(kind, key) {
            true => ConfigError::misplaced(&path, &format!("{}.{key}", other.name())),
            false => unknown(&path, key, kind, &known),
        }
    };
    table.keys().filter(unknown_here).map(error).collect()
}

/// The error of an unknown key. It names other kinds of scenes that have the key, or the nearest
/// key.
fn unknown(path: &str, key: &str, kind: Kind, known: &[&Key]) -> ConfigError {
    let others = Kind::ALL.iter().filter(|other| other.has(key));
    let names: Vec<_> = others.map(|other| format!("{:?}", other.name())).collect();
    if names.is_empty() {
        return ConfigError::unknown_in_table(path, known);
    }
    let has = if names.len() > 1 { "have" } else { "has" };
    let (own, others) = (kind.name(), names.join(", "));
    let allowed = format!("unknown key of kind = {own:?}; kind = {others} {has} it");
    ConfigError::new(path, "", allowed)
}
