//! A wave tank: a paddle at x = 0, a seawall at the end.

use serde::{Deserialize, Serialize};

use super::crest::{Behind, CrestKeys, FloorKeys};
use super::wall_choice::WallChoice;
use crate::body::{
    CaissonKeys, FixedWall, GoringPaddle, Paddle, RecordedStroke, RecordedStrokeKeys, SpringWall,
    Wall, WaveTrain, WaveTrainKeys,
};
use crate::boundary::Profile;
use crate::keys::{ConfigError, section};

/// The motion of the paddle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaddleChoice {
    /// It makes a solitary wave (Goring 1978).
    Solitary,
    /// It makes regular waves (Schäffer 1996).
    WaveTrain,
    /// It plays a stroke from a file.
    RecordedStroke,
}

pub(super) const THRESHOLD_RATIO: f64 = 1.10;
pub(super) const FORCE_COUPLING: f64 = 1.0;

section! {
    /// The `[scene]` table with `kind = "seawall"`, complete.
    pub struct SeawallScene in "scene" {
        /// Still water depth h.
        still_water_depth_m: f64 = 0.20, unit("m").above_zero();
        /// From the paddle at rest to the wall at rest, or to the toe of an inclined one.
        tank_length_m: f64 = 2.5, unit("m").above_zero();
        /// The bed, `[[x, y], ...]` in metres: straight stretches between points, from `[0, 0]` at the foot of the
        /// paddle at rest to the foot of the wall at `tank_length_m`. x never goes back; two points
        /// above one another make a step. It is level as far as the paddle goes, and nowhere below 0. What
        /// lies above the still water is a dry beach.
        bed: Option<Profile> = None, plain().otherwise("level").newer();
        /// Gravity g.
        gravity_m_per_s2: f64 = 9.81, unit("m/s²").above_zero();
        /// Density of still water at zero pressure.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// A solitary wave, regular waves, or the stroke of a file.
        paddle: PaddleChoice = PaddleChoice::Solitary, plain().newer();
        /// The paddle gives way to waves that come back to it, so that they leave the tank.
        absorption: bool = false, plain().newer();
        /// H/h of the wave; about that where the stroke is recorded. 0 is still water with the paddle at rest.
        wave_height_ratio: f64 = 0.5, plain().within(0.0, 0.8);
        /// The run ends this long after the paddle passes the middle of its stroke.
        end_after_stroke_centre_s: f64 = 3.0,
            unit("s").above_zero().label("end after stroke").unless("end_time_s");
        /// The run ends at this time, whatever the stroke. It must be given where H/h = 0, and where the
        /// paddle has no single stroke.
        end_time_s: Option<f64> = None, unit("s").above_zero();
        /// Share of the duration T of a solitary wave's stroke over which its start is smoothed.
        paddle_ramp_fraction: f64 = 0.05, plain().within(0.0, 0.5).label("paddle ramp");
        /// Fixed, mounted on a spring, or a caisson that slides with friction.
        wall: WallChoice = WallChoice::Fixed, plain();
        /// Angle of the wall from the bed; 90 is vertical, 120 leans away from the water.
        wall_angle_deg: f64 = 90.0, unit("°").within(30.0, 150.0).read_where("wall", &["fixed"]);
        /// Nothing, behind a wall that no water goes over. Behind one with a crest an outflow, which takes
        /// water away; or a dry floor or a basin of still water, up to an end wall.
        behind: Behind = Behind::Nothing, plain().only("wall", &["fixed"]).newer();
        /// A movable wall leaves its stop when the force exceeds this many times that of still water.
        threshold_ratio: f64 = THRESHOLD_RATIO,
            plain().above_zero().read_where("wall", &["fixed", "movable"]);
        /// The factor s on the force above the threshold.
        force_coupling: f64 = FORCE_COUPLING,
            plain().within(0.0, 10.0).read_where("wall", &["fixed", "movable"]);
        /// Spring stiffness k of one metre of wall, by the metre that it gives way: N/m², written N/m as in Liang et al. 2017.
        spring_stiffness_n_per_m: Option<f64> = None,
            unit("N/m").not_negative().only("wall", &["movable"]).needed();
        /// Mass m of the wall, per metre of width.
        seawall_mass_kg_per_m: Option<f64> = None,
            unit("kg/m").above_zero().only("wall", &["movable", "caisson"]).needed();
        /// Where the wave height is measured: from the paddle at rest, inside the tank.
        wave_gauge_m: f64 = 1.5, unit("m").above_zero();
        /// On a beach runups are told where the water is so thick: from a third of a particle spacing to the still water's depth.
        runup_thickness_m: Option<f64> = None,
            unit("m").above_zero().otherwise("where the bed is half wet, about one spacing").newer();
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.005, unit("s").above_zero();
    }
    with {
        /// The regular waves that the paddle makes.
        wave_train: WaveTrainKeys where paddle == PaddleChoice::WaveTrain;
        /// The stroke that it plays.
        recorded: RecordedStrokeKeys where paddle == PaddleChoice::RecordedStroke;
        /// The caisson that the wall is.
        caisson: Box<CaissonKeys> where wall == WallChoice::Caisson;
        /// The crest that the wall ends in.
        crest: CrestKeys where behind != Behind::Nothing;
        /// The floor behind it.
        floor: Box<FloorKeys> where behind.keeps();
    }
}

impl SeawallScene {
    /// Whether the wall is upright and the bed level. Only then is the effect of sound removed from
    /// forces.
    pub fn is_upright_over_level_bed(&self) -> bool {
        self.uneven_bed().is_none() && self.wall_angle_deg == 90.0
    }

    /// The bed in the file, unless it is level everywhere, as in a tank without a bed.
    pub fn uneven_bed(&self) -> Option<&Profile> {
        self.bed.as_ref().filter(|bed| !bed.is_level())
    }

    /// Whether nothing makes a wave.
    pub(super) fn is_still(&self) -> bool {
        self.wave_height_ratio == 0.0 && self.recorded.is_none()
    }

    /// The paddle; none for still water.
    pub fn paddle(&self) -> Option<Paddle> {
        let (ratio, depth) = (self.wave_height_ratio, self.still_water_depth_m);
        let paddle = match self.paddle {
            PaddleChoice::Solitary => Paddle::Goring(GoringPaddle::new(
                ratio,
                depth,
                self.gravity_m_per_s2,
                self.paddle_ramp_fraction,
            )),
            PaddleChoice::WaveTrain => Paddle::WaveTrain(self.regular_waves()?),
            PaddleChoice::RecordedStroke => {
                let stroke = &self.recorded.as_ref()?.recorded_stroke;
                Paddle::Recorded(RecordedStroke::new(stroke))
            }
        };
        (ratio > 0.0).then_some(paddle)
    }

    /// Whether a recorded stroke makes one wave after another.
    pub fn plays_one_wave_after_another(&self) -> bool {
        self.recorded.as_ref().is_some_and(|keys| keys.recorded_stroke.goes_on())
    }

    pub(super) fn regular_waves(&self) -> Option<WaveTrain> {
        let (ratio, depth) = (self.wave_height_ratio, self.still_water_depth_m);
        let WaveTrainKeys { wave_period_s, second_stroke } = *self.wave_train.as_ref()?;
        let water = (depth, self.gravity_m_per_s2);
        Some(WaveTrain::new(ratio, water, (wave_period_s, second_stroke)))
    }

    /// F_th over the hydrostatic force, N per metre of width.
    pub fn onset_ratio(&self, static_force: f64) -> f64 {
        let friction = |keys: &CaissonKeys| 1.0 + keys.holding_friction() / static_force;
        match self.wall {
            WallChoice::Fixed | WallChoice::Movable => self.threshold_ratio,
            WallChoice::Caisson => self.caisson.as_deref().map_or(self.threshold_ratio, friction),
        }
    }

    /// The wall at rest, under this hydrostatic force, N per metre of width. Without a mass it is
    /// held.
    pub(super) fn law(&self, static_force: f64) -> Wall {
        let threshold = self.onset_ratio(static_force) * static_force;
        let mass = self.seawall_mass_kg_per_m;
        let law = match self.wall {
            WallChoice::Fixed => None,
            WallChoice::Movable => {
                mass.zip(self.spring_stiffness_n_per_m).map(|(mass, stiffness)| {
                    let coupling = self.force_coupling;
                    Wall::Spring(SpringWall::at_rest(mass, stiffness, threshold, coupling))
                })
            }
            WallChoice::Caisson => self.caisson.as_ref().map(|keys| keys.wall(mass, static_force)),
        };
        law.unwrap_or(Wall::Fixed(FixedWall::up_to(threshold)))
    }

    /// The same scene with its wall held, and without the keys of its motion. A wall whose own keys
    /// say what holds it keeps its kind, without a mass. Cases that differ in a key that is forgotten
    /// here compute their start twice, to the same bits.
    pub(super) fn held(&self) -> SeawallScene {
        let wall = match self.wall {
            WallChoice::Fixed | WallChoice::Movable => WallChoice::Fixed,
            WallChoice::Caisson => self.wall,
        };
        SeawallScene {
            wall,
            spring_stiffness_n_per_m: None,
            seawall_mass_kg_per_m: None,
            force_coupling: FORCE_COUPLING,
            caisson: self.caisson.as_deref().map(CaissonKeys::held).map(Box::new),
            ..self.clone()
        }
    }

    /// The clock at the start of a run, seconds: 0, or that of a recorded stroke.
    pub fn start_s(&self) -> f64 {
        self.recorded.as_ref().map_or(0.0, |keys| keys.recorded_stroke.start_s())
    }
}

pub(super) fn error(key: &str, value: impl ToString, allowed: &str) -> Result<(), ConfigError> {
    Err(ConfigError::new(&format!("scene.{key}"), value, allowed))
}
