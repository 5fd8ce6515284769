//! The kinds of scenes, and their common functions.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::contract::{SceneOfKind, Walls};
use super::frame::Frame;
use super::numerics::{Numerics, Scheme};
use super::seawall::SeawallScene;
use super::tank::Tank;
use crate::keys::{ConfigError, Key, Section, check_conditions, section};
use crate::math::simd::SimdPath;

/// Declares the kinds: for each its name in files and its section.
macro_rules! kinds {
    ($($(#[doc = $about:literal])* $name:literal => $kind:ident($scene:ty);)*) => {
        /// Names that `scene.kind` may take.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Kind {
            $($(#[doc = $about])* #[serde(rename = $name)] $kind,)*
        }

        impl Kind {
            /// All kinds.
            pub const ALL: &[Kind] = &[$(Kind::$kind),*];

            /// Its name in files.
            pub fn name(self) -> &'static str {
                match self { $(Kind::$kind => $name,)* }
            }

            /// The keys of a scene of this kind, `kind` itself left out.
            pub(super) fn keys(self) -> Vec<&'static Key> {
                match self { $(Kind::$kind => <$scene>::keys(),)* }
            }

            /// Whether a scene of this kind has a key, `kind` itself left out.
            pub(super) fn has(self, name: &str) -> bool {
                match self { $(Kind::$kind => <$scene>::has(name),)* }
            }

            /// Reads the `[scene]` table of this kind. It must already be known that all its keys
            /// exist.
            pub(super) fn read(self, table: &Table) -> Result<Scene, ConfigError> {
                match self {
                    $(Kind::$kind => {
                        let scene = <$scene>::read(table, None)?;
                        check_conditions(table, &scene)?;
                        Ok(Scene::$kind(scene))
                    })*
                }
            }
        }

        /// What is simulated.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(tag = "kind")]
        pub enum Scene {
            $($(#[doc = $about])* #[serde(rename = $name)] $kind($scene),)*
        }

        impl Scene {
            /// Its kind.
            pub(super) fn of_kind(&self) -> Kind {
                match self { $(Scene::$kind(_) => Kind::$kind,)* }
            }

            /// Adds the names of all keys whose values differ. False if the two do not have the
            /// same keys.
            pub fn differing(&self, other: &Scene, names: &mut Vec<&'static str>) -> bool {
                match (self, other) {
                    $((Scene::$kind(one), Scene::$kind(other)) => one.differing(other, names),)*
                    _ => false,
                }
            }
        }

        /// `$body` with `$scene` bound to the scene of any kind.
        macro_rules! each {
            ($value:expr, $bound:ident => $body:expr) => {
                match $value { $(Scene::$kind($bound) => $body,)* }
            };
        }
    };
}

kinds! {
    /// Still water in a box.
    "hydrostatic" => Hydrostatic(super::hydrostatic::HydrostaticScene);
    /// A column of water that collapses.
    "dam-break" => DamBreak(super::dam_break::DamBreakScene);
    /// A wave tank that ends in a seawall.
    "seawall" => Seawall(SeawallScene);
    /// A small standing wave in a box.
    "standing-wave" => StandingWave(super::standing_wave::StandingWaveScene);
    /// Taylor-Green vortices in a closed box.
    "taylor-green" => TaylorGreen(super::taylor_green::TaylorGreenScene);
    /// A square in free rotation.
    "rotating-patch" => RotatingPatch(super::rotating_patch::RotatingPatchScene);
    /// A drop in a central field.
    "oscillating-drop" => OscillatingDrop(super::oscillating_drop::OscillatingDropScene);
}

impl Kind {
    /// The kind of a scene that does not say it.
    pub const DEFAULT: Kind = Kind::Seawall;

    /// That of a `[scene]` table.
    pub fn of(scene: &Table) -> Result<Kind, ConfigError> {
        Ok(OfKind::read(scene, None)?.kind)
    }
}

section! {
    /// What `[scene]` has besides the keys of its kind.
    pub(super) struct OfKind in "scene" {
        /// What is simulated.
        kind: Kind = Kind::DEFAULT, plain().label("scene");
    }
}

impl Scene {
    /// The seawall's values, where the scene has one.
    pub fn seawall(&self) -> Option<&SeawallScene> {
        match self {
            Scene::Seawall(scene) => Some(scene),
            _ => None,
        }
    }

    /// The clock at the start of a run, seconds.
    pub fn start_s(&self) -> f64 {
        self.seawall().map_or(0.0, SeawallScene::start_s)
    }

    /// All its values as in a file, the kind first.
    pub fn entries(&self) -> Vec<(&'static str, Value)> {
        let mut entries = vec![("kind", self.kind().into())];
        entries.extend(each!(self, scene => scene.entries()));
        entries
    }

    /// The same as a table.
    pub fn table(&self) -> Table {
        self.entries().into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// The value of a key except the kind, as in a file.
    pub fn entry(&self, name: &str) -> Option<Value> {
        each!(self, scene => scene.entry(name))
    }

    /// Its name in `scene.kind`.
    pub fn kind(&self) -> &'static str {
        self.of_kind().name()
    }

    /// Its scales.
    pub fn frame(&self) -> Frame {
        each!(self, scene => scene.frame())
    }

    /// The depth that scales F*, metres: that at a seawall, or the still water's if it stands dry.
    pub fn force_depth_m(&self) -> f64 {
        self.seawall().map_or_else(|| self.frame().depth, SeawallScene::force_depth_m)
    }

    /// What F* is over, N/m.
    pub fn force_unit_n_per_m(&self) -> f64 {
        self.frame().static_force(self.force_depth_m())
    }

    /// Fluid particles.
    pub fn particles(&self, numerics: &Numerics) -> usize {
        each!(self, scene => scene.particles(numerics))
    }

    /// Area of the water at the start, square metres.
    pub(super) fn water_area(&self) -> f64 {
        each!(self, scene => scene.water_area())
    }

    /// The walls around the water.
    pub fn walls(&self) -> Walls {
        each!(self, scene => scene.walls())
    }

    /// Builds the tank.
    pub fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        each!(self, scene => scene.build(numerics, path))
    }

    /// The name of the scene's depth.
    pub(super) fn depth_name(&self) -> &'static str {
        each!(self, scene => scene.depth_name())
    }

    /// Checks keys against each other, and that the scheme can run the scene.
    pub(super) fn validate(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        each!(self, scene => scene.validate(numerics))?;
        match each!(self, scene => scene.not_for_isph()) {
            Some(why) if numerics.scheme == Scheme::Isph => {
                let allowed = format!("{} {why}", self.kind());
                Err(ConfigError::new("numerics.scheme", "\"isph\"", allowed))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::CaseConfig;

    /// The story: vortices have no gravity, and their F* is over ρU² times the side. The page told
    /// half of their force in newtons.
    #[test]
    fn a_force_without_gravity_has_a_scale_of_its_own() {
        let scene = "kind = \"taylor-green\"\nspeed_m_per_s = 0.7\nbox_side_m = 0.5";
        let unit = CaseConfig::of(scene, "").scene.force_unit_n_per_m();
        assert!((unit - 1000.0 * 0.49 * 0.5).abs() < 1e-9, "{unit}");
    }
}
