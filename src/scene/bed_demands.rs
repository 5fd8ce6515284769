//! What a bed before a seawall requires of tank, paddle and wall, and settings that require a bed.

use super::numerics::{Numerics, Scheme};
use super::seawall::{SeawallScene, error};
use super::seawall_demands::DIGITS;
use crate::boundary::{IN_METRES, Profile, STEEP};
use crate::keys::ConfigError;
use crate::math::decimal::rounded_up;

/// A bed that ends so many times farther or nearer than the tank was hardly meant so.
const FAR: f64 = 2.0;

impl SeawallScene {
    /// Checks the bed against wall, paddle, water and scheme.
    pub(super) fn validate_bed(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let Some(bed) = &self.bed else { return Ok(()) };
        let [end, toe] = bed.end();
        if (end - self.tank_length_m).abs() > 1e-9 * self.tank_length_m {
            let allowed = format!("must be {end}, where the bed ends and the wall stands");
            let far = !(1.0 / FAR..=FAR).contains(&(end / self.tank_length_m));
            let asked = if far {
                format!("; the bed's last x is {end} m: {IN_METRES}")
            } else {
                String::new()
            };
            let allowed = allowed + &asked;
            return error("tank_length_m", self.tank_length_m, &allowed);
        }
        let told = |allowed: &str| error("bed", "", allowed);
        if let Some(x) = bed.plate() {
            return told(&format!(
                "goes up and down at x = {x} m: what stands or gapes there has no breadth"
            ));
        }
        if bed.ends_upright() {
            return told(&format!(
                "must not end with a step, at {end} m: there the wall stands, from its foot at the bed's last point on"
            ));
        }
        if bed.is_level() {
            return Ok(());
        }
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
                "must be level as far as the paddle goes, up to {} m or farther, not {up_to} m",
                rounded_up(reach, DIGITS)
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

    /// Whether still water ends on a bed of less than 44 degrees, so that the wall is dry.
    pub(super) fn is_at_beach(&self) -> bool {
        let depth = self.still_water_depth_m;
        self.bed.as_ref().is_some_and(|bed| {
            bed.end()[1] >= depth && bed.is_steep_at(depth, 0.0) && !bed.is_steep_at(depth, STEEP)
        })
    }

    /// Whether runups are told where a tongue on a beach is one particle spacing thick. On steeper
    /// slopes there is no tongue. Behind ground that rises out of the water they are those at the
    /// wall.
    pub fn reads_tongue_at_a_spacing(&self) -> bool {
        self.is_at_beach() && self.runup_thickness_m.is_none()
    }

    /// Checks the thickness at which runups are read against bed and particles.
    pub(super) fn validate_runup(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let Some(thickness) = self.runup_thickness_m else { return Ok(()) };
        let told = |allowed: &str| error("runup_thickness_m", thickness, allowed);
        if !self.is_at_beach() {
            return told(
                "is for beaches: a bed of less than 44 degrees where still water ends, and a wall that stands dry",
            );
        }
        let (least, most) = (numerics.particle_spacing_m / 3.0, self.still_water_depth_m);
        if !(least..=most).contains(&thickness) {
            return told(&format!(
                "must be from {} m, a third of a particle spacing, to {most} m, the still water's depth",
                rounded_up(least, DIGITS)
            ));
        }
        let rises = |bed: &Profile| bed.rises_where_thinner(most, thickness);
        if !self.bed.as_ref().is_some_and(rises) {
            return told(
                "must be less than still water is deep over bars and terraces before the shore, and the bed must not fall \
                 behind it",
            );
        }
        Ok(())
    }
}
