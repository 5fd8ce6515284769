//! What bed and paddle of a seawall ask of the rest of the scene.

use super::numerics::{Numerics, Scheme};
use super::seawall::{SeawallScene, error};
use crate::keys::ConfigError;

/// Instants of a stroke at which its reach is looked at.
const INSTANTS: u32 = 200;
/// A paddle that never stands is looked at so long, seconds.
const LONGEST: f64 = 1e4;

impl SeawallScene {
    /// Still water depth where the wall stands, metres; 0 where it stands dry.
    pub fn depth_at_wall_m(&self) -> f64 {
        let toe = self.bed.as_ref().map_or(0.0, |bed| bed.end()[1]);
        (self.still_water_depth_m - toe).max(0.0)
    }

    /// Checks what the bed asks of wall, paddle, water and scheme.
    pub(super) fn validate_bed(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let Some(bed) = &self.bed else { return Ok(()) };
        let [end, toe] = bed.end();
        if (end - self.tank_length_m).abs() > 1e-9 * self.tank_length_m {
            let allowed = format!("must be {end}, where the bed ends and the wall stands");
            return error("tank_length_m", self.tank_length_m, &allowed);
        }
        let told = |allowed: &str| error("bed", "", allowed);
        if numerics.scheme == Scheme::Isph {
            return told("is for scheme = \"wcsph\": isph knows level beds alone");
        }
        if self.wall_angle_deg != 90.0 {
            return told("ends at an upright wall: leave wall_angle_deg out");
        }
        let reach = self.stroke_m() + numerics.support_radius_ratio * numerics.particle_spacing_m;
        if bed.level_up_to() < reach {
            let up_to = bed.level_up_to();
            return told(&format!(
                "must be level as far as the paddle goes, up to {reach:.3} m or farther, not {up_to} m"
            ));
        }
        let [lowest, _] = bed.range();
        if lowest < 0.0 {
            return told(&format!(
                "goes down to {lowest} m: 0, the paddle's foot, must be its lowest place"
            ));
        }
        if self.wall.moves() && !(bed.ends_level() && toe < self.still_water_depth_m) {
            return told("must end level and under still water where the wall moves");
        }
        Ok(())
    }

    /// How far the paddle goes, metres.
    fn stroke_m(&self) -> f64 {
        match (&self.paddle, &self.recorded) {
            (_, Some(keys)) => keys.recorded_stroke.reach(),
            _ => self.paddle().map_or(0.0, |paddle| {
                let end = self.end_time_s.unwrap_or(LONGEST).min(LONGEST);
                let step = paddle.still_from().min(end) / f64::from(INSTANTS);
                let reach = |k| paddle.motion(f64::from(k) * step).offset.abs();
                (0..=INSTANTS).map(reach).fold(0.0, f64::max)
            }),
        }
    }

    /// Checks what absorption asks of scheme and end.
    pub(super) fn validate_absorption(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let told = |allowed: &str| error("absorption", "true", allowed);
        if self.absorption && numerics.scheme == Scheme::Isph {
            return told("is for scheme = \"wcsph\"");
        }
        if self.absorption && numerics.stop_when_settled {
            return told("is not for stop_when_settled = true: the paddle never stands");
        }
        Ok(())
    }
}
