//! One case, complete and validated.

use serde::{Deserialize, Serialize};
use toml::Table;

use super::declared::{Place, refuse_unknown};
use super::kind::{Kind, Scene};
use super::numerics::{ErrorBars, Numerics, Scheme};
use super::preset::{LEAST_RATIO, Preset, sound_speed_ratio};
use super::probe::Probe;
use super::size;
use crate::keys::{ConfigError, Section, Shared};

/// One case: everything that decides its answer, and nothing else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseConfig {
    /// What is simulated.
    pub scene: Scene,
    /// How.
    pub numerics: Shared<Numerics>,
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
        let kind = Kind::of(scene)?;
        refuse_unknown(Place::Scene, kind, scene)?;
        let scene = kind.read(scene)?;
        refuse_unknown(Place::Numerics, kind, numerics)?;
        let numerics = Numerics::of_scene(&scene, numerics)?.into();
        let config = CaseConfig { numerics, scene, probes };
        config.validate()?;
        Ok(config)
    }

    fn validate(&self) -> Result<(), ConfigError> {
        self.scene.validate(&self.numerics)?;
        let frame = self.scene.frame();
        let rows = frame.depth / self.numerics.particle_spacing_m;
        if rows < 4.0 {
            let water = self.scene.depth_name();
            let allowed = format!("must be at most a quarter of the {water} ({} m)", frame.depth);
            let spacing = self.numerics.particle_spacing_m;
            return Err(ConfigError::new("numerics.particle_spacing_m", spacing, allowed));
        }
        size::validate(&self.scene, &self.numerics)?;
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
        let mut numerics = self.numerics.clone();
        if numerics.retries != 0 || numerics.error_bars != ErrorBars::None {
            numerics.retries = 0;
            numerics.error_bars = ErrorBars::None;
        }
        Some(CaseConfig { scene: Scene::Seawall(scene), numerics, probes: self.probes.clone() })
    }

    /// What decides this case's answer.
    pub fn without_error_bars(&self) -> CaseConfig {
        let mut config = self.clone();
        if config.numerics.error_bars != ErrorBars::None {
            config.numerics.error_bars = ErrorBars::None;
        }
        config
    }

    /// The same case, without retries, with its time steps scaled.
    pub fn with_time_step_scaled(&self, scale: f64) -> CaseConfig {
        let mut config = self.clone();
        let numerics: &mut Numerics = &mut config.numerics;
        numerics.courant_number *= scale;
        if let Some(own) = &mut numerics.incompressible {
            own.gravity_courant_number *= scale;
            own.flow_courant_number *= scale;
        }
        numerics.time_step_s = numerics.time_step_s.map(|step| step * scale);
        numerics.retries = 0;
        config
    }

    /// The numerics that are not those which its scene has by default with these particles; their
    /// spacing, where it is not the default one.
    pub fn numerics_of_its_own(&self) -> Table {
        let own = self.numerics.table();
        let spacing = "particle_spacing_m";
        let scheme = own.get("scheme").filter(|_| self.numerics.scheme != Scheme::Wcsph);
        let named = [(spacing, own.get(spacing)), ("scheme", scheme)];
        let named: Table = named
            .into_iter()
            .filter_map(|(key, value)| Some((key.to_owned(), value?.clone())))
            .collect();
        let of_scene = Numerics::of_scene(&self.scene, &named);
        let default = of_scene.unwrap_or_else(|_| Numerics::preset(Preset::Default)).table();
        let usual = Numerics::preset(Preset::Default).table();
        own.into_iter()
            .filter(|(key, value)| {
                let default = if named.contains_key(key) { &usual } else { &default };
                default.get(key) != Some(value)
            })
            .collect()
    }

    /// The same case with particles `ratio` times as far apart, time steps in proportion, and 1/c0²
    /// too, so that the error by sound grows as the spacing does; `None` where that is too coarse for
    /// the scene.
    pub fn coarsened(&self, ratio: f64) -> Option<CaseConfig> {
        let mut config = self.without_error_bars();
        let depth = self.scene.frame().depth;
        let numerics: &mut Numerics = &mut config.numerics;
        let spacing = numerics.particle_spacing_m;
        numerics.particle_spacing_m *= ratio;
        numerics.time_step_s = numerics.time_step_s.map(|step| step * ratio);
        if numerics.scheme == Scheme::Wcsph {
            let [own, coarse] = [spacing, spacing * ratio].map(|x| sound_speed_ratio(depth, x));
            let is_default = numerics.sound_speed_ratio == own;
            let scaled = (numerics.sound_speed_ratio / ratio.sqrt()).max(LEAST_RATIO);
            numerics.sound_speed_ratio = if is_default { coarse } else { scaled };
        }
        config.validate().ok().map(|()| config)
    }
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
        assert_eq!(config.numerics.particle_spacing_m, 0.01);
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
        let boundaries = "must be one of improved-shepard, normalized, sfdi, mls-linear, \
                          mls-quadratic, dummy";
        let kinds = "must be one of hydrostatic, dam-break, seawall, standing-wave, taylor-green, \
                     rotating-patch, oscillating-drop";
        let spring = "spring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1";
        let bad = [
            ("still_water_dept_m = 1", ": unknown key; did you mean still_water_depth_m?"),
            ("wave_height_ratio = \"high\"", " = \"high\": must be a number"),
            (
                "wall = \"moveable\"",
                ": must be one of fixed, movable, caisson; did you mean movable?",
            ),
            ("kind = \"lake\"", &format!(" = \"lake\": {kinds}")),
            ("kind = \"dambreak\"", &format!(": {kinds}; did you mean dam-break?")),
            (
                "kind = \"hydrostatic\"\nseawall_mass_kg_per_m = 1",
                ": unknown key of kind = \"hydrostatic\"; kind = \"seawall\" has it",
            ),
            (
                "particle_spacing_m = 0.01",
                ": unknown key; did you mean numerics.particle_spacing_m?",
            ),
            ("wave_height_ratio = 0", "scene.end_time_s: is needed where wave_height_ratio = 0"),
            (spring, "scene.spring_stiffness_n_per_m = 1: belongs to wall = \"movable\""),
            (
                "wall = \"movable\"",
                "scene.spring_stiffness_n_per_m: is needed where wall = \"movable\"",
            ),
            (
                &format!("wall = \"movable\"\nwall_angle_deg = 120\n{spring}"),
                "scene.wall_angle_deg = 120: a movable wall is vertical: leave it out, or set \
                 scene.wall = \"fixed\"",
            ),
        ];
        for (scene, message) in bad {
            told(case(scene, ""), "scene.", message);
        }
        let caisson = "wall = \"caisson\"\nseawall_mass_kg_per_m = 60\nstatic_friction = 0.6\n\
                       submerged_weight_n_per_m = 300\n";
        let bad = [
            ("", "kinetic_friction: is needed where wall = \"caisson\""),
            ("kinetic_friction = 0.7", " = 0.7: must be a number from 0 to 0.6"),
            (
                "kinetic_friction = 0.5\nthreshold_ratio = 1.2",
                "threshold_ratio = 1.2: is not for a caisson: leave it out",
            ),
            (
                "kinetic_friction = 0.5\nspring_stiffness_n_per_m = 1",
                " = 1: belongs to wall = \"movable\"",
            ),
            (
                "kinetic_friction = 0.5\nwall_angle_deg = 100",
                " = 100: a caisson is vertical: leave it out, or set scene.wall = \"fixed\"",
            ),
        ];
        for (scene, message) in bad {
            told(case(&format!("{caisson}{scene}"), ""), "scene.", message);
        }
        let message = "scene.static_friction = 1: belongs to wall = \"caisson\"";
        told(case("static_friction = 1", ""), "scene.", message);
        let bad = [
            ("colour = 1", "numerics.colour: unknown key"),
            ("wave_height_ratio = 0.3", ": unknown key; did you mean scene.wave_height_ratio?"),
            ("preset = \"fast\"", " = \"fast\": must be one of default, huang2019, isph"),
            ("particle_spacing_m = -0.01", " = -0.01: must be a finite number above 0"),
            ("particle_spacing_m = nan", " = NaN: must be a finite number above 0"),
            (
                "kernel = 3",
                " = 3: must be one of wendland-c2, wendland-c4, gaussian, cubic-spline, quintic-spline",
            ),
            ("error_bars = { a = 1 }", " = { a = 1 }: must be one of none, pair, triple"),
            ("boundary = \"sdfi\"", &format!(" = \"sdfi\": {boundaries}; did you mean sfdi?")),
            ("boundary = \"brick\"", &format!(" = \"brick\": {boundaries}")),
            ("retries = -1", " = -1: must be a whole number, 0 or above"),
            ("retries = 1.5", " = 1.5: must be a whole number, 0 or above"),
            ("retries = 7", " = 7: must be a whole number from 0 to 6"),
            ("corrected_gradients = 1", " = 1: must be true or false"),
            ("laplacian = \"exact\"", " = \"exact\": belongs to scheme = \"isph\""),
            ("scheme = \"isph\"\nslip = \"no\"", " = \"no\": belongs to scheme = \"wcsph\""),
            (
                "preset = \"isph\"\nscheme = \"wcsph\"",
                ": preset = \"isph\" is of scheme = \"isph\"",
            ),
        ];
        for (numerics, message) in bad {
            told(case("", numerics), "numerics.", message);
        }
    }

    fn told(case: Result<CaseConfig, ConfigError>, section: &str, message: &str) {
        let told = case.unwrap_err().to_string();
        assert!(told.starts_with(section) && told.ends_with(message), "{told:?}: {message:?}");
    }

    #[test]
    fn a_key_added_later_is_stored_only_off_its_default() {
        let stored = |scene: &str| Table::try_from(case(scene, "").unwrap().scene).unwrap();
        assert!(!stored("paddle = \"solitary\"").contains_key("paddle"));
        let waves = stored("paddle = \"wave-train\"\nwave_period_s = 1\nend_time_s = 1");
        assert_eq!(waves["paddle"].as_str(), Some("wave-train"));
        assert_eq!(waves["wave_period_s"].as_float(), Some(1.0));
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
