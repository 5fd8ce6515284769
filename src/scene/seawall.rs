//! The tank of both papers: a Goring paddle at x = 0, a fixed or spring-mounted wall at the end.

use serde::{Deserialize, Serialize};

use super::filling::WALL_HEIGHT;
use crate::keys::{ConfigError, section};

/// What the seawall may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WallChoice {
    /// It stands still.
    Fixed,
    /// It is mounted on a spring (Liang et al. 2017, Eqs. 16-18).
    Movable,
}

section! {
    /// The `[scene]` table with `kind = "seawall"`, complete.
    pub struct SeawallScene in "scene" {
        /// Still water depth h.
        still_water_depth_m: f64 = 0.20, unit("m").above_zero();
        /// From the paddle at rest to the wall at rest, or to the toe of an inclined one.
        tank_length_m: f64 = 2.5, unit("m").above_zero();
        /// Gravity g.
        gravity_m_per_s2: f64 = 9.81, unit("m/s²").above_zero();
        /// Density of still water at zero pressure.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// H/h of the solitary wave; 0 is still water with the paddle at rest.
        wave_height_ratio: f64 = 0.5, plain().within(0.0, 0.8);
        /// The run ends this long after the paddle passes the middle of its stroke.
        end_after_stroke_centre_s: f64 = 3.0, unit("s").above_zero().label("end after stroke");
        /// The run ends at this time, whatever the stroke; must be given where H/h = 0.
        end_time_s: Option<f64> = None, unit("s").above_zero();
        /// Share of the paddle's duration T over which its start is smoothed.
        paddle_ramp_fraction: f64 = 0.05, plain().within(0.0, 0.5).label("paddle ramp");
        /// Fixed or spring-mounted wall.
        wall: WallChoice = WallChoice::Fixed, plain();
        /// Angle of the wall from the bed; 90 is vertical, 120 leans away from the water.
        wall_angle_deg: f64 = 90.0, unit("°").within(30.0, 150.0).read_where("wall", &["fixed"]);
        /// F_threshold, above which a movable wall gives way, over the hydrostatic force.
        threshold_ratio: f64 = 1.10, plain().above_zero();
        /// The factor s on the force above the threshold.
        force_coupling: f64 = 1.0, plain().within(0.0, 10.0);
        /// Spring stiffness k, per metre of width.
        spring_stiffness_n_per_m: Option<f64> = None,
            unit("N/m").not_negative().only("wall", &["movable"]).needed();
        /// Mass m of the wall, per metre of width.
        seawall_mass_kg_per_m: Option<f64> = None,
            unit("kg/m").above_zero().only("wall", &["movable"]).needed();
        /// Where the wave height is measured, from the paddle at rest; inside the tank.
        wave_gauge_m: f64 = 1.5, unit("m").above_zero();
        /// Spacing of the history's samples.
        history_interval_s: f64 = 0.005, unit("s").above_zero();
    }
}

impl SeawallScene {
    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let error = |key: &str, value: String, allowed: &str| {
            Err(ConfigError::new(&format!("scene.{key}"), value, allowed))
        };
        if self.wave_gauge_m >= self.tank_length_m {
            return error(
                "wave_gauge_m",
                self.wave_gauge_m.to_string(),
                "must lie inside the tank",
            );
        }
        if self.end_time_s.is_none() && self.wave_height_ratio == 0.0 {
            return error("end_time_s", String::new(), "is needed where wave_height_ratio = 0");
        }
        let angle = self.wall_angle_deg;
        if self.wall == WallChoice::Movable && angle != 90.0 {
            let allowed = "a movable wall is vertical: leave it out, or set scene.wall = \"fixed\"";
            return error("wall_angle_deg", angle.to_string(), allowed);
        }
        validate_lean(angle, self.still_water_depth_m, self.tank_length_m)
    }
}

/// An inclined wall must stay clear of the other end as far up as it goes.
pub(super) fn validate_lean(angle_deg: f64, depth: f64, length: f64) -> Result<(), ConfigError> {
    let reach = WALL_HEIGHT * depth / libm::tan(angle_deg.to_radians());
    if angle_deg >= 90.0 || reach <= 0.9 * length {
        return Ok(());
    }
    let allowed = format!(
        "leans over the whole tank: {WALL_HEIGHT} depths up it has come {reach:.2} m of {length} m"
    );
    Err(ConfigError::new("scene.wall_angle_deg", angle_deg, allowed))
}
