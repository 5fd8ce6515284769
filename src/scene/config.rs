//! One case, complete and validated.

use serde::{Deserialize, Serialize};
use toml::Table;

use super::declared::{Place, refuse_unknown};
use super::kind::{Kind, Scene};
use super::numerics::{ErrorBars, LEAST_SOUND_SPEED_RATIO, Numerics, Scheme};
use super::preset::Preset;
use super::probe::Probe;
use super::seawall::SeawallScene;
use super::size;
use super::suited::sound_speed_ratio;
use crate::keys::{ConfigError, Section, Shared};

/// One case: everything that decides its answer, and nothing else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseConfig {
    /// What is simulated.
    pub scene: Scene,
    /// How it is simulated.
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
        let (scene, scene_given) = (kind.read(scene)?, scene);
        refuse_unknown(Place::Numerics, kind, numerics)?;
        let numerics = Numerics::of_scene(&scene, numerics)?;
        let config = CaseConfig { numerics, scene, probes };
        config.validate().map_err(|error| with_value(error, scene_given))?;
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
        if let Some(scene) = self.scene.seawall() {
            size::validate_walls(scene, &self.numerics)?;
        }
        let upright = self.scene.seawall().is_some_and(|scene| scene.wall_angle_deg == 90.0);
        if self.numerics.stop_when_settled && !upright {
            let allowed = "belongs to a wave on a vertical seawall";
            return Err(ConfigError::new("numerics.stop_when_settled", true, allowed));
        }
        let relaxes = self.numerics.relaxation_time_s;
        if relaxes > 0.0 && self.scene.seawall().is_none() {
            let allowed = "is for kind = \"seawall\"";
            return Err(ConfigError::new("numerics.relaxation_time_s", relaxes, allowed));
        }
        let behind = self.scene.seawall().map_or([0.0; 2], SeawallScene::behind_m);
        Probe::validate_all(&self.probes, &frame, behind)
    }

    /// The part of this case that it shares with all cases that differ only in the motion of the
    /// wall: the same case with a fixed wall. `None` for scenes that do not branch.
    pub fn trunk(&self) -> Option<CaseConfig> {
        let scene = self.scene.seawall()?.held();
        let mut numerics = self.numerics.clone();
        if numerics.retries != 0 || numerics.error_bars != ErrorBars::None {
            numerics.retries = 0;
            numerics.error_bars = ErrorBars::None;
        }
        Some(CaseConfig { scene: Scene::Seawall(scene), numerics, probes: self.probes.clone() })
    }

    /// The same tank before any wave. It decides how its water comes to rest, except for the room
    /// that the paddle needs. Waves that differ in a key that is forgotten here bring their water to
    /// rest anew, to the same bits.
    pub fn before_wave(&self) -> CaseConfig {
        let mut config = self.trunk().unwrap_or_else(|| self.without_error_bars());
        if let Scene::Seawall(scene) = &mut config.scene {
            scene.wave_height_ratio = 0.0;
            (scene.wave_train, scene.recorded) = (None, None);
            (scene.end_after_stroke_centre_s, scene.end_time_s) = (1.0, None);
            (scene.paddle_ramp_fraction, scene.wave_gauge_m) = (0.0, 0.0);
            scene.runup_thickness_m = None;
        }
        config.probes.clear();
        config
    }

    /// The case without settings that do not affect its answer.
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
        let step = scale * self.scene.frame().time_step(&self.numerics);
        let numerics: &mut Numerics = &mut config.numerics;
        // Viscosity or diffusion may bound the step more tightly than its Courant number.
        numerics.time_step_s = Some(step);
        numerics.courant_number *= scale;
        if let Some(own) = &mut numerics.incompressible {
            own.gravity_courant_number *= scale;
            own.flow_courant_number *= scale;
        }
        numerics.retries = 0;
        config
    }

    /// The numerics that differ from the scene's defaults with these particles; also the spacing,
    /// if it is not the default.
    pub fn numerics_of_its_own(&self) -> Table {
        let mut own = self.numerics.table();
        let named = ["particle_spacing_m", "scheme"];
        let named =
            named.into_iter().filter_map(|key| Some((key.to_owned(), own.get(key)?.clone())));
        let named: Table = named.collect();
        let of_scene = Numerics::of_scene(&self.scene, &named).expect("both are the case's own");
        let [of_scene, usual] = [&*of_scene, &Numerics::preset(Preset::Default)].map(|n| n.table());
        own.retain(|key, value| {
            let default = if named.contains_key(key) { &usual } else { &of_scene };
            default.get(key) != Some(&*value)
        });
        own
    }

    /// The same case with `ratio` times the particle spacing. Time steps and 1/c0² grow in
    /// proportion, so that the error by sound grows like the spacing.
    ///
    /// # Errors
    /// The part of the scene for which that is too coarse.
    pub fn coarsened(&self, ratio: f64) -> Result<CaseConfig, ConfigError> {
        let mut config = self.without_error_bars();
        let depth = self.scene.frame().depth;
        let numerics: &mut Numerics = &mut config.numerics;
        let spacing = numerics.particle_spacing_m;
        numerics.particle_spacing_m *= ratio;
        numerics.time_step_s = numerics.time_step_s.map(|step| step * ratio);
        if numerics.scheme == Scheme::Wcsph {
            let [own, coarse] = [spacing, spacing * ratio].map(|x| sound_speed_ratio(depth, x));
            let is_default = numerics.sound_speed_ratio == own;
            let scaled = (numerics.sound_speed_ratio / ratio.sqrt()).max(LEAST_SOUND_SPEED_RATIO);
            numerics.sound_speed_ratio = if is_default { coarse } else { scaled };
        }
        config.validate().map(|()| config)
    }
}

#[cfg(test)]
impl CaseConfig {
    /// A case from these two tables, for tests.
    pub(crate) fn of(scene: &str, numerics: &str) -> CaseConfig {
        let [scene, numerics] = [scene, numerics].map(|text| text.parse().unwrap());
        CaseConfig::from_tables(&scene, &numerics).unwrap()
    }
}

/// An error about a key of the scene, with the value that the file has.
fn with_value(error: ConfigError, scene: &Table) -> ConfigError {
    let key = error.key.strip_prefix("scene.").filter(|_| error.value.is_empty());
    let Some(value) = key.and_then(|key| scene.get(key)) else { return error };
    ConfigError { value: value.to_string(), ..error }
}

#[cfg(test)]
mod tests;
