//! One case, complete and validated.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::error::ConfigError;
use super::kind::Scene;
use super::numerics::{ErrorBars, Numerics, PRESETS, Scheme as SchemeChoice, WEAKLY_COMPRESSIBLE};
use super::probe::Probe;
use super::size;
use super::wording::{self, serde_keys};

/// One case: everything that decides its answer, and nothing else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseConfig {
    /// What is simulated.
    pub scene: Scene,
    /// How.
    pub numerics: Numerics,
    /// Gauges, from the file's `[[probe]]` tables.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<Probe>,
}

impl CaseConfig {
    /// Reads a case from its `[scene]` and `[numerics]` tables.
    ///
    /// # Errors
    /// The first unknown key, wrong type or value out of range.
    pub fn from_tables(scene: &Table, numerics: &Table) -> Result<CaseConfig, ConfigError> {
        CaseConfig::with_probes(scene, numerics, &[])
    }

    /// Reads a case with its `[[probe]]` tables.
    ///
    /// # Errors
    /// The first unknown key, wrong type or value out of range.
    pub fn with_probes(
        scene: &Table,
        numerics: &Table,
        probes: &[Table],
    ) -> Result<CaseConfig, ConfigError> {
        let probes = Probe::read_all(probes)?;
        let scene = Scene::read(scene)?;
        let config = CaseConfig { numerics: read_numerics(&scene, numerics)?, scene, probes };
        config.validate()?;
        Ok(config)
    }

    fn validate(&self) -> Result<(), ConfigError> {
        self.numerics.validate()?;
        self.scene.validate(&self.numerics)?;
        let frame = self.scene.frame();
        let rows = frame.depth / self.numerics.particle_spacing_m;
        if rows < 4.0 {
            let water = self.scene.depth_name();
            let allowed = format!("must be at most a quarter of the {water} ({} m)", frame.depth);
            let spacing = self.numerics.particle_spacing_m;
            return Err(ConfigError::new("numerics.particle_spacing_m", spacing, allowed));
        }
        size::validate(self)?;
        let upright = self.scene.seawall().is_some_and(|scene| scene.wall_angle_deg == 90.0);
        if self.numerics.stop_when_settled && !upright {
            let allowed = "belongs to a wave on a vertical seawall";
            return Err(ConfigError::new("numerics.stop_when_settled", true, allowed));
        }
        Probe::validate_all(&self.probes, &frame)
    }

    /// The stretch of this case that it shares with all others that differ only in what the wall
    /// does once it moves: the same case with its wall held fixed. `None` for scenes that do not
    /// branch.
    pub fn trunk(&self) -> Option<CaseConfig> {
        let scene = self.scene.seawall()?.held();
        let numerics = Numerics { retries: 0, ..self.without_error_bars().numerics };
        Some(CaseConfig { scene: Scene::Seawall(scene), numerics, probes: self.probes.clone() })
    }

    /// What decides this case's answer.
    pub fn without_error_bars(&self) -> CaseConfig {
        let mut config = self.clone();
        config.numerics.error_bars = ErrorBars::None;
        config
    }

    /// The same case, without retries, with its time steps scaled.
    pub fn with_time_step_scaled(&self, scale: f64) -> CaseConfig {
        let mut config = self.clone();
        let numerics = &mut config.numerics;
        numerics.courant_number *= scale;
        numerics.gravity_courant_number = numerics.gravity_courant_number.map(|c| c * scale);
        numerics.flow_courant_number = numerics.flow_courant_number.map(|c| c * scale);
        config.numerics.time_step_s = config.numerics.time_step_s.map(|step| step * scale);
        config.numerics.retries = 0;
        config
    }

    /// The same case with particles `ratio` times as far apart, time steps in proportion; `None`
    /// where that is too coarse for the scene.
    pub fn coarsened(&self, ratio: f64) -> Option<CaseConfig> {
        let mut config = self.without_error_bars();
        config.numerics.particle_spacing_m *= ratio;
        config.numerics.time_step_s = config.numerics.time_step_s.map(|step| step * ratio);
        config.validate().ok().map(|()| config)
    }
}

pub(super) fn read_section<T: DeserializeOwned>(table: Table) -> Result<T, ConfigError> {
    wording::read_table("scene", table, &serde_keys::<T>())
}

fn read_numerics(scene: &Scene, table: &Table) -> Result<Numerics, ConfigError> {
    let mut rest = table.clone();
    let name = match rest.remove("preset") {
        None => "default".to_owned(),
        Some(Value::String(name)) => name,
        Some(other) => {
            return Err(ConfigError::new("numerics.preset", other, "must be the name of a preset"));
        }
    };
    let isph = rest.get("scheme").and_then(Value::as_str) == Some("isph");
    let base = if name == "default" && isph { "isph" } else { &name };
    let Some(mut preset) = Numerics::preset(base) else {
        let names: Vec<_> = PRESETS.iter().map(|&name| name.to_owned()).collect();
        return Err(ConfigError::one_of("numerics.preset", &Value::String(name), &names));
    };
    if matches!(scene, Scene::DamBreak(_)) {
        // A front that hits a wall leaves no time in which pairs could hold their geometry.
        preset.acoustic_substeps = 1;
    }
    if name == "default" && base == "default" && !scene.has_crest_at_upright_wall() {
        // A wide support pays where a crest strains a lattice. Thin sheets and wedges lose by it, and
        // water at rest begins to creep after some ten seconds.
        preset.support_radius_ratio = 4.0;
        preset.artificial_viscosity = 0.1;
        preset.shifting_coefficient = 0.25;
    }
    let weakly_compressible = |key: &str| WEAKLY_COMPRESSIBLE.contains(&key);
    let stays = rest.get("scheme").is_none_or(|scheme| scheme.as_str() == Some("isph"));
    if preset.scheme == SchemeChoice::Isph
        && stays
        && let Some((key, value)) = rest.iter().find(|(key, _)| weakly_compressible(key))
    {
        let allowed = "belongs to scheme = \"wcsph\"";
        return Err(ConfigError::new(&format!("numerics.{key}"), value, allowed));
    }
    let mut merged = Table::try_from(&preset).expect("a preset is a table");
    merged.extend(rest);
    let known = serde_keys::<Numerics>();
    let of_scene = scene.keys();
    if let Some(key) = merged.keys().find(|key| !known.contains(key) && of_scene.contains(key)) {
        return Err(ConfigError::misplaced(&format!("numerics.{key}"), &format!("scene.{key}")));
    }
    wording::read_table("numerics", merged, &known)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(scene: &str, numerics: &str) -> Result<CaseConfig, ConfigError> {
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap())
    }

    #[test]
    fn defaults_are_the_papers_tank() {
        let config = case("", "").unwrap();
        let scene = config.scene.seawall().unwrap();
        assert_eq!(scene.still_water_depth_m, 0.2);
        assert_eq!(config.numerics.particle_spacing_m, 0.009);
        assert_eq!(config.numerics.support_radius_ratio, 5.0);
        let others = [
            "kind = \"dam-break\"",
            "wall_angle_deg = 120",
            "wave_height_ratio = 0\nend_time_s = 1",
        ];
        for scene in others {
            assert_eq!(case(scene, "").unwrap().numerics.support_radius_ratio, 4.0);
            let set = case(scene, "support_radius_ratio = 4.5").unwrap();
            assert_eq!(set.numerics.support_radius_ratio, 4.5);
        }
    }

    #[test]
    fn every_bad_value_is_told_with_its_key() {
        let bad = [
            (
                "still_water_dept_m = 1.0",
                "",
                "scene.still_water_dept_m: unknown key; did you mean still_water_depth_m?",
            ),
            (
                "",
                "particle_spacing_m = -0.01",
                "numerics.particle_spacing_m = -0.01: must be a finite number above 0",
            ),
            (
                "",
                "particle_spacing_m = nan",
                "numerics.particle_spacing_m = NaN: must be a finite number above 0",
            ),
            ("", "kernel = 3", "numerics.kernel = 3: must be one of wendland-c2, "),
            (
                "",
                "preset = \"fast\"",
                "numerics.preset = \"fast\": must be one of default, huang2019",
            ),
            (
                "kind = \"lake\"",
                "",
                "scene.kind = \"lake\": must be one of hydrostatic, dam-break, seawall, standing-wave,",
            ),
            (
                "wave_height_ratio = 0",
                "",
                "scene.end_time_s: is needed where wave_height_ratio = 0",
            ),
            (
                "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1\nwall_angle_deg = 120",
                "",
                "scene.wall_angle_deg = 120: a movable wall is vertical",
            ),
        ];
        for (scene, numerics, message) in bad {
            let told = case(scene, numerics).unwrap_err().to_string();
            assert!(told.starts_with(message), "{told:?} should start with {message:?}");
        }
    }

    #[test]
    fn a_trunk_forgets_what_the_wall_does() {
        let movable =
            "wall = \"movable\"\nspring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50";
        let a = case(movable, "").unwrap();
        let b = case("wall = \"fixed\"", "").unwrap();
        assert_eq!(a.trunk(), b.trunk());
    }
}
