//! The kinds of scenes, and what all of them can do.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::config::read_section;
use super::dam_break::DamBreakScene;
use super::error::ConfigError;
use super::frame::Frame;
use super::hydrostatic::HydrostaticScene;
use super::numerics::{Numerics, Scheme};
use super::oscillating_drop::OscillatingDropScene;
use super::rotating_patch::RotatingPatchScene;
use super::seawall::SeawallScene;
use super::standing_wave::StandingWaveScene;
use super::tank::Tank;
use super::taylor_green::TaylorGreenScene;
use super::wording::serde_keys;
use crate::math::simd::SimdPath;

/// What is simulated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Scene {
    /// A wave tank that ends in a seawall.
    Seawall(SeawallScene),
    /// Still water in a box.
    Hydrostatic(HydrostaticScene),
    /// A column of water that collapses.
    DamBreak(DamBreakScene),
    /// A small standing wave in a box.
    StandingWave(StandingWaveScene),
    /// Taylor-Green vortices in a closed box.
    TaylorGreen(TaylorGreenScene),
    /// A square in free rotation.
    RotatingPatch(RotatingPatchScene),
    /// A drop in a central field.
    OscillatingDrop(OscillatingDropScene),
}

impl Scene {
    /// Whether a crest climbs an upright wall, and strains the lattice of its water there.
    pub(super) fn has_crest_at_upright_wall(&self) -> bool {
        self.seawall().is_some_and(|s| s.wave_height_ratio > 0.0 && s.wall_angle_deg == 90.0)
    }
}

/// Names that `scene.kind` may take.
const KINDS: &[&str] = &[
    "hydrostatic",
    "dam-break",
    "seawall",
    "standing-wave",
    "taylor-green",
    "rotating-patch",
    "oscillating-drop",
];

/// `$body` with `$scene` bound to the scene of whatever kind.
macro_rules! each {
    ($scene:expr, $bound:ident => $body:expr) => {
        match $scene {
            Scene::Seawall($bound) => $body,
            Scene::Hydrostatic($bound) => $body,
            Scene::DamBreak($bound) => $body,
            Scene::StandingWave($bound) => $body,
            Scene::TaylorGreen($bound) => $body,
            Scene::RotatingPatch($bound) => $body,
            Scene::OscillatingDrop($bound) => $body,
        }
    };
}

/// The keys of `[scene]` with this kind, without `kind` itself.
fn keys_of(kind: &str) -> Vec<String> {
    match kind {
        "hydrostatic" => serde_keys::<HydrostaticScene>(),
        "dam-break" => serde_keys::<DamBreakScene>(),
        "standing-wave" => serde_keys::<StandingWaveScene>(),
        "taylor-green" => serde_keys::<TaylorGreenScene>(),
        "rotating-patch" => serde_keys::<RotatingPatchScene>(),
        "oscillating-drop" => serde_keys::<OscillatingDropScene>(),
        _ => serde_keys::<SeawallScene>(),
    }
}

/// Tells where a key that this kind does not know belongs, if it belongs anywhere.
fn misplaced(kind: &str, key: &String) -> Result<(), ConfigError> {
    let path = format!("scene.{key}");
    if serde_keys::<Numerics>().contains(key) || key == "preset" {
        return Err(ConfigError::misplaced(&path, &format!("numerics.{key}")));
    }
    let others: Vec<_> = KINDS
        .iter()
        .filter(|other| keys_of(other).contains(key))
        .map(|other| format!("{other:?}"))
        .collect();
    if others.is_empty() {
        return Ok(());
    }
    let has = if others.len() > 1 { "have" } else { "has" };
    let allowed = format!("unknown key of kind = {kind:?}; kind = {} {has} it", others.join(", "));
    Err(ConfigError::new(&path, "", allowed))
}

impl Scene {
    /// The seawall's values, where the scene has one.
    pub fn seawall(&self) -> Option<&SeawallScene> {
        match self {
            Scene::Seawall(scene) => Some(scene),
            _ => None,
        }
    }

    /// The name that `scene.kind` gives it.
    pub fn kind(&self) -> &'static str {
        match self {
            Scene::Seawall(_) => "seawall",
            Scene::Hydrostatic(_) => "hydrostatic",
            Scene::DamBreak(_) => "dam-break",
            Scene::StandingWave(_) => "standing-wave",
            Scene::TaylorGreen(_) => "taylor-green",
            Scene::RotatingPatch(_) => "rotating-patch",
            Scene::OscillatingDrop(_) => "oscillating-drop",
        }
    }

    /// The keys of its table, without `kind`.
    pub(super) fn keys(&self) -> Vec<String> {
        keys_of(self.kind())
    }

    /// Its scales.
    pub fn frame(&self) -> Frame {
        each!(self, scene => scene.frame())
    }

    /// Fluid particles.
    pub fn particles(&self, numerics: &Numerics) -> usize {
        each!(self, scene => scene.lattice(numerics).particles())
    }

    /// Area of the water at the start, square metres.
    pub(super) fn water_area(&self) -> f64 {
        let frame = self.frame();
        let upto = |angle_deg: f64| {
            let lean =
                if angle_deg == 90.0 { 0.0 } else { 1.0 / libm::tan(angle_deg.to_radians()) };
            frame.depth * (frame.length - 0.5 * lean * frame.depth)
        };
        match self {
            Scene::Seawall(scene) => upto(scene.wall_angle_deg),
            Scene::Hydrostatic(scene) => upto(scene.wall_angle_deg),
            Scene::DamBreak(scene) => scene.column_length_m * scene.column_height_m,
            Scene::OscillatingDrop(scene) => std::f64::consts::PI * scene.radius_m * scene.radius_m,
            _ => frame.length * frame.depth,
        }
    }

    /// Builds the tank.
    pub fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        each!(self, scene => scene.build(numerics, path))
    }

    /// What the scene's depth is, in words.
    pub(super) fn depth_name(&self) -> &'static str {
        match self {
            Scene::Seawall(_) | Scene::Hydrostatic(_) | Scene::StandingWave(_) => {
                "still water depth"
            }
            Scene::DamBreak(_) => "column height",
            Scene::TaylorGreen(_) => "box's side",
            Scene::RotatingPatch(_) => "patch's side",
            Scene::OscillatingDrop(_) => "drop's diameter",
        }
    }

    /// Checks its values, and that the scheme can take it.
    pub(super) fn validate(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        each!(self, scene => scene.validate())?;
        let why = match self {
            Scene::TaylorGreen(_) => "has no surface, which isph takes its pressure from",
            Scene::OscillatingDrop(_) => "lies in a central field, which isph does not know",
            _ => return Ok(()),
        };
        if numerics.scheme == Scheme::Isph {
            let allowed = format!("{} {why}", self.kind());
            return Err(ConfigError::new("numerics.scheme", "\"isph\"", allowed));
        }
        Ok(())
    }

    /// Reads a `[scene]` table by its `kind`; a seawall where there is none.
    pub(super) fn read(table: &Table) -> Result<Scene, ConfigError> {
        let kind = match table.get("kind") {
            None => "seawall",
            Some(Value::String(kind)) if KINDS.contains(&kind.as_str()) => kind,
            Some(other) => {
                let names: Vec<_> = KINDS.iter().map(|&name| name.to_owned()).collect();
                return Err(ConfigError::one_of("scene.kind", other, &names));
            }
        };
        let mut rest = table.clone();
        rest.remove("kind");
        let own = keys_of(kind);
        if let Some(key) = rest.keys().find(|key| !own.contains(key)) {
            misplaced(kind, key)?;
        }
        Ok(match kind {
            "hydrostatic" => Scene::Hydrostatic(read_section(rest)?),
            "dam-break" => Scene::DamBreak(read_section(rest)?),
            "standing-wave" => Scene::StandingWave(read_section(rest)?),
            "taylor-green" => Scene::TaylorGreen(read_section(rest)?),
            "rotating-patch" => Scene::RotatingPatch(read_section(rest)?),
            "oscillating-drop" => Scene::OscillatingDrop(read_section(rest)?),
            _ => Scene::Seawall(read_section(rest)?),
        })
    }
}
