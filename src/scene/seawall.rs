//! A wave tank: a paddle at x = 0, a seawall at the end.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use crate::body::{
    FixedWall, GoringPaddle, Paddle, RecordedStroke, SlidingCaisson, SpringWall, Stroke, Wall,
    WaveTrain,
};

/// What the paddle does.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaddleChoice {
    /// It makes a solitary wave (Goring 1978).
    #[default]
    Solitary,
    /// It makes regular waves (Madsen 1971).
    WaveTrain,
    /// It plays a stroke from a file.
    RecordedStroke,
}

impl PaddleChoice {
    fn is_default(&self) -> bool {
        *self == PaddleChoice::default()
    }
}

/// What the seawall may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WallChoice {
    /// It stands still.
    Fixed,
    /// It is mounted on a spring (Liang et al. 2017, Eqs. 16-18).
    Movable,
    /// It slides on its bed with Coulomb friction.
    Caisson,
}

/// The `[scene]` table with `kind = "seawall"`, complete.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SeawallScene {
    /// Still water depth h, metres.
    pub still_water_depth_m: f64,
    /// From the paddle at rest to the wall at rest, metres.
    pub tank_length_m: f64,
    /// Gravity g, m/s².
    pub gravity_m_per_s2: f64,
    /// Density of still water at zero pressure, kg/m³.
    pub water_density_kg_per_m3: f64,
    /// What the paddle does.
    #[serde(skip_serializing_if = "PaddleChoice::is_default")]
    pub paddle: PaddleChoice,
    /// H/h of the wave, of a recorded stroke about; 0 is still water with the paddle at rest.
    pub wave_height_ratio: f64,
    /// Period of regular waves, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wave_period_s: Option<f64>,
    /// The recorded stroke: a CSV file of `time_s` and `stroke_m`, and in a case what it says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded_stroke: Option<Stroke>,
    /// The run ends this long after the paddle passes the middle of its stroke, seconds.
    pub end_after_stroke_centre_s: f64,
    /// The run ends at this time, whatever the stroke; required where H/h = 0
    /// and where the paddle has no single stroke.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_time_s: Option<f64>,
    /// Share of the paddle's duration T over which its start is smoothed.
    pub paddle_ramp_fraction: f64,
    /// What the wall may do.
    pub wall: WallChoice,
    /// Angle of a fixed wall from the bed, degrees; 90 is vertical, 120 leans away from the water.
    pub wall_angle_deg: f64,
    /// F_threshold over the hydrostatic force.
    pub threshold_ratio: f64,
    /// The factor s on the excess force, see [`crate::body`].
    pub force_coupling: f64,
    /// Spring stiffness k, N/m per metre of width; movable walls only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_stiffness_n_per_m: Option<f64>,
    /// Mass m of the wall, kg per metre of width; movable walls and caissons only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seawall_mass_kg_per_m: Option<f64>,
    /// μ_s between a caisson and its bed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub static_friction: Option<f64>,
    /// μ_k likewise, once it slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic_friction: Option<f64>,
    /// N of a caisson, N per metre of width.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub submerged_weight_n_per_m: Option<f64>,
    /// Where the wave height is measured, metres from the paddle at rest.
    pub wave_gauge_m: f64,
    /// Spacing of the history samples, seconds.
    pub history_interval_s: f64,
}

impl Default for SeawallScene {
    fn default() -> Self {
        SeawallScene {
            still_water_depth_m: 0.20,
            tank_length_m: 2.5,
            gravity_m_per_s2: 9.81,
            water_density_kg_per_m3: 1000.0,
            paddle: PaddleChoice::Solitary,
            wave_height_ratio: 0.5,
            wave_period_s: None,
            recorded_stroke: None,
            end_after_stroke_centre_s: 3.0,
            end_time_s: None,
            paddle_ramp_fraction: 0.05,
            wall: WallChoice::Fixed,
            wall_angle_deg: 90.0,
            threshold_ratio: 1.10,
            force_coupling: 1.0,
            spring_stiffness_n_per_m: None,
            seawall_mass_kg_per_m: None,
            static_friction: None,
            kinetic_friction: None,
            submerged_weight_n_per_m: None,
            wave_gauge_m: 1.5,
            history_interval_s: 0.005,
        }
    }
}

impl WallChoice {
    /// Whether such a wall may move.
    pub fn moves(self) -> bool {
        self != WallChoice::Fixed
    }
}

/// Keys that only some walls have.
const WALL_KEYS: &[(&str, &[WallChoice])] = &[
    ("wall_angle_deg", &[WallChoice::Fixed]),
    ("spring_stiffness_n_per_m", &[WallChoice::Movable]),
    ("seawall_mass_kg_per_m", &[WallChoice::Movable, WallChoice::Caisson]),
    ("threshold_ratio", &[WallChoice::Fixed, WallChoice::Movable]),
    ("force_coupling", &[WallChoice::Fixed, WallChoice::Movable]),
    ("static_friction", &[WallChoice::Caisson]),
    ("kinetic_friction", &[WallChoice::Caisson]),
    ("submerged_weight_n_per_m", &[WallChoice::Caisson]),
];

/// Keys that mean nothing to the wall of this name; none where no wall has it.
pub fn keys_of_other_walls(name: &str) -> impl Iterator<Item = &'static str> {
    let choice = toml::Value::from(name).try_into::<WallChoice>().ok();
    let foreign = move |&&(_, walls): &&(_, &[WallChoice])| {
        choice.is_some_and(|choice| !walls.contains(&choice))
    };
    WALL_KEYS.iter().filter(foreign).map(|&(key, _)| key)
}

impl SeawallScene {
    /// The paddle; none for still water.
    pub fn paddle(&self) -> Option<Paddle> {
        let (ratio, depth) = (self.wave_height_ratio, self.still_water_depth_m);
        let gravity = self.gravity_m_per_s2;
        let paddle = match (self.paddle, self.wave_period_s, &self.recorded_stroke) {
            (PaddleChoice::WaveTrain, Some(period), _) => {
                Paddle::WaveTrain(WaveTrain::new(ratio, depth, gravity, period))
            }
            (PaddleChoice::RecordedStroke, _, Some(stroke)) => {
                Paddle::Recorded(RecordedStroke::new(stroke))
            }
            _ => {
                Paddle::Goring(GoringPaddle::new(ratio, depth, gravity, self.paddle_ramp_fraction))
            }
        };
        (ratio > 0.0).then_some(paddle)
    }

    /// F_th over the hydrostatic force, N per metre of width.
    pub(super) fn onset_ratio(&self, static_force: f64) -> f64 {
        match self.wall {
            WallChoice::Caisson => 1.0 + self.holding_friction() / static_force,
            WallChoice::Fixed | WallChoice::Movable => self.threshold_ratio,
        }
    }

    /// μ_s N, N per metre of width; zero where there is no friction.
    fn holding_friction(&self) -> f64 {
        let pair = self.static_friction.zip(self.submerged_weight_n_per_m);
        pair.map_or(0.0, |(friction, weight)| friction * weight)
    }

    /// What the wall is, for people.
    pub fn wall_in_words(&self) -> String {
        match self.wall {
            WallChoice::Fixed => format!("fixed, {}°", self.wall_angle_deg),
            WallChoice::Movable => format!(
                "movable (threshold {}, coupling {})",
                self.threshold_ratio, self.force_coupling
            ),
            WallChoice::Caisson => format!("caisson (held by {} N/m)", self.holding_friction()),
        }
    }

    /// The wall at rest, under this hydrostatic force, N per metre of width; one without a mass is held.
    pub(super) fn law(&self, static_force: f64) -> Wall {
        let threshold = self.onset_ratio(static_force) * static_force;
        match (self.wall, self.seawall_mass_kg_per_m, self.spring_stiffness_n_per_m) {
            (WallChoice::Movable, Some(mass), Some(stiffness)) => {
                let coupling = self.force_coupling;
                Wall::Spring(SpringWall::at_rest(mass, stiffness, threshold, coupling))
            }
            (WallChoice::Caisson, mass, _) => self.caisson(mass, static_force),
            _ => Wall::Fixed(FixedWall::up_to(threshold)),
        }
    }

    fn caisson(&self, mass: Option<f64>, static_force: f64) -> Wall {
        let holding = self.holding_friction();
        let Some(mass) = mass else {
            return Wall::Fixed(FixedWall {
                holds: [static_force - holding, static_force + holding],
            });
        };
        let weight = self.submerged_weight_n_per_m.unwrap_or(0.0);
        let friction = [holding, self.kinetic_friction.unwrap_or(0.0) * weight];
        Wall::Caisson(SlidingCaisson::at_rest(mass, static_force, friction))
    }

    /// The same scene with its wall held fixed, and nothing left of what it does once it moves.
    pub(super) fn held(&self) -> SeawallScene {
        let held = SeawallScene {
            wall: WallChoice::Fixed,
            spring_stiffness_n_per_m: None,
            seawall_mass_kg_per_m: None,
            kinetic_friction: None,
            force_coupling: 1.0,
            ..self.clone()
        };
        match self.wall {
            // Held from both sides, by any friction that is as large.
            WallChoice::Caisson => SeawallScene {
                wall: WallChoice::Caisson,
                static_friction: Some(1.0),
                submerged_weight_n_per_m: Some(self.holding_friction()),
                ..held
            },
            WallChoice::Fixed | WallChoice::Movable => held,
        }
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("scene");
        check.positive("still_water_depth_m", self.still_water_depth_m)?;
        check.positive("tank_length_m", self.tank_length_m)?;
        check.positive("gravity_m_per_s2", self.gravity_m_per_s2)?;
        check.positive("water_density_kg_per_m3", self.water_density_kg_per_m3)?;
        check.range("wave_height_ratio", self.wave_height_ratio, 0.0, 0.8)?;
        check.positive("end_after_stroke_centre_s", self.end_after_stroke_centre_s)?;
        check.range("paddle_ramp_fraction", self.paddle_ramp_fraction, 0.0, 0.5)?;
        check.positive("threshold_ratio", self.threshold_ratio)?;
        check.range("force_coupling", self.force_coupling, 0.0, 10.0)?;
        check.positive("history_interval_s", self.history_interval_s)?;
        if !(self.wave_gauge_m > 0.0 && self.wave_gauge_m < self.tank_length_m) {
            return Err(check.error("wave_gauge_m", self.wave_gauge_m, "must lie inside the tank"));
        }
        match self.end_time_s {
            Some(end) => check.positive("end_time_s", end)?,
            None if self.wave_height_ratio == 0.0 => {
                return Err(check.error("end_time_s", "", "is needed where wave_height_ratio = 0"));
            }
            None if self.paddle != PaddleChoice::Solitary => {
                return Err(check.error("end_time_s", "", "is needed where no stroke ends a run"));
            }
            None => {}
        }
        self.validate_paddle(&check)?;
        match self.wall {
            WallChoice::Fixed => self.validate_fixed(&check),
            WallChoice::Movable => self.validate_movable(&check),
            WallChoice::Caisson => self.validate_caisson(&check),
        }
    }

    fn validate_paddle(&self, check: &Check) -> Result<(), ConfigError> {
        let error = |key, value: &str, allowed: &str| Err(check.error(key, value, allowed));
        match (self.paddle, self.wave_period_s, &self.recorded_stroke) {
            (PaddleChoice::WaveTrain, None, _) => {
                return error("wave_period_s", "", "is needed for a wave train");
            }
            (PaddleChoice::RecordedStroke, _, None) => {
                return error("recorded_stroke", "", "is needed: the path of a CSV file");
            }
            (PaddleChoice::Solitary | PaddleChoice::RecordedStroke, Some(period), _) => {
                let allowed = "belongs to a wave train (set scene.paddle = \"wave-train\")";
                return error("wave_period_s", &period.to_string(), allowed);
            }
            (PaddleChoice::Solitary | PaddleChoice::WaveTrain, _, Some(_)) => {
                let allowed = "belongs to scene.paddle = \"recorded-stroke\"";
                return error("recorded_stroke", "", allowed);
            }
            _ => {}
        }
        if let Some(period) = self.wave_period_s {
            check.positive("wave_period_s", period)?;
            let (ratio, depth) = (self.wave_height_ratio, self.still_water_depth_m);
            let waves = WaveTrain::new(ratio, depth, self.gravity_m_per_s2, period);
            if !waves.is_fit(ratio, depth) {
                let allowed = "makes waves too long for their height: H L²/h³ must be below 8π²/3";
                return error("wave_period_s", &period.to_string(), allowed);
            }
        }
        let reach = self.recorded_stroke.as_ref().map_or(0.0, Stroke::reach);
        if reach > 0.5 * self.tank_length_m {
            let allowed = format!("goes {reach} m far, more than half the tank's length");
            return error("recorded_stroke", "", &allowed);
        }
        Ok(())
    }

    fn validate_fixed(&self, check: &Check) -> Result<(), ConfigError> {
        absent(check, "spring_stiffness_n_per_m", self.spring_stiffness_n_per_m, "movable wall")?;
        absent(check, "seawall_mass_kg_per_m", self.seawall_mass_kg_per_m, "movable wall")?;
        self.validate_frictionless(check)?;
        check.wall_angle(self.wall_angle_deg, self.still_water_depth_m, self.tank_length_m)
    }

    fn validate_movable(&self, check: &Check) -> Result<(), ConfigError> {
        self.validate_upright(check, "movable wall")?;
        let key = "spring_stiffness_n_per_m";
        let stiffness = needed(check, key, self.spring_stiffness_n_per_m, "movable wall")?;
        let key = "seawall_mass_kg_per_m";
        let mass = needed(check, key, self.seawall_mass_kg_per_m, "movable wall")?;
        self.validate_frictionless(check)?;
        check.not_negative("spring_stiffness_n_per_m", stiffness)?;
        check.positive("seawall_mass_kg_per_m", mass)
    }

    fn validate_caisson(&self, check: &Check) -> Result<(), ConfigError> {
        self.validate_upright(check, "caisson")?;
        absent(check, "spring_stiffness_n_per_m", self.spring_stiffness_n_per_m, "movable wall")?;
        let defaults = SeawallScene::default();
        for (key, value, default) in [
            ("threshold_ratio", self.threshold_ratio, defaults.threshold_ratio),
            ("force_coupling", self.force_coupling, defaults.force_coupling),
        ] {
            if value != default {
                return Err(check.error(key, value, "is not for a caisson: leave it out"));
            }
        }
        let given = |key, value| needed(check, key, value, "caisson");
        let mass = given("seawall_mass_kg_per_m", self.seawall_mass_kg_per_m)?;
        let holding = given("static_friction", self.static_friction)?;
        let sliding = given("kinetic_friction", self.kinetic_friction)?;
        let weight = given("submerged_weight_n_per_m", self.submerged_weight_n_per_m)?;
        check.positive("seawall_mass_kg_per_m", mass)?;
        check.positive("static_friction", holding)?;
        check.range("kinetic_friction", sliding, 0.0, holding)?;
        check.positive("submerged_weight_n_per_m", weight)
    }

    fn validate_upright(&self, check: &Check, wall: &str) -> Result<(), ConfigError> {
        if self.wall_angle_deg == 90.0 {
            return Ok(());
        }
        let allowed = format!("a {wall} is vertical: leave it out, or set scene.wall = \"fixed\"");
        Err(check.error("wall_angle_deg", self.wall_angle_deg, &allowed))
    }

    fn validate_frictionless(&self, check: &Check) -> Result<(), ConfigError> {
        absent(check, "static_friction", self.static_friction, "caisson")?;
        absent(check, "kinetic_friction", self.kinetic_friction, "caisson")?;
        absent(check, "submerged_weight_n_per_m", self.submerged_weight_n_per_m, "caisson")
    }
}

/// The value of a key that such a wall needs.
fn needed(check: &Check, key: &str, value: Option<f64>, wall: &str) -> Result<f64, ConfigError> {
    value.ok_or_else(|| check.error(key, "", &format!("is needed for a {wall}")))
}

/// No value for a key that belongs to another wall.
fn absent(check: &Check, key: &str, value: Option<f64>, wall: &str) -> Result<(), ConfigError> {
    let name = wall.split(' ').next().unwrap_or_default();
    let allowed = format!("belongs to a {wall} (set scene.wall = \"{name}\")");
    value.map_or(Ok(()), |value| Err(check.error(key, value, &allowed)))
}
