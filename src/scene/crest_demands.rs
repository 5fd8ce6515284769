//! What a crest, and the floor behind it, require of the rest of the scene.

use super::contract::SceneOfKind;
use super::crest::{CrestKeys, FloorKeys};
use super::filling::WALL_HEIGHT;
use super::lattice::Lattice;
use super::numerics::{Numerics, Scheme};
use super::seawall::{SeawallScene, error};
use crate::boundary::{CrestShape, FloorBehind};
use crate::keys::{ConfigError, value_of};
use crate::math::decimal::significant;

/// The still water must be this many spacings below the crest, or it would creep over the edge.
const CLEAR: f64 = 1.5;

/// A bound as people write it, without the rounding of sums of decimals.
fn nine_digits(bound: f64) -> f64 {
    significant(bound, 9)
}

/// Whether a length is less than a bound by more than the rounding of sums. So the bound in a
/// message is itself allowed.
fn below(length: f64, bound: f64) -> bool {
    length < bound - 1e-9 * bound.abs()
}

impl SeawallScene {
    /// The end of the wall, if water may go over it.
    pub(super) fn crest_shape(&self, numerics: &Numerics) -> Option<CrestShape> {
        let crest = self.crest.as_ref()?;
        let height = self.still_water_depth_m + crest.crest_freeboard_m;
        let floor = self.floor_behind(numerics);
        Some(CrestShape { height, width: crest.crest_width_m, floor })
    }

    fn floor_behind(&self, numerics: &Numerics) -> Option<FloorBehind> {
        let FloorKeys { floor_height_m: height, floor_length_m: length, .. } =
            **self.floor.as_ref()?;
        let basin = self.basin_lattice(numerics).map(|lattice| lattice.spacing);
        let spacing = basin.unwrap_or_else(|| {
            let columns = (length / numerics.particle_spacing_m).round().max(1.0);
            [length / columns, self.lattice(numerics).spacing[1]]
        });
        Some(FloorBehind { height, length, spacing })
    }

    /// Height of the still water behind the wall over the paddle's foot, metres, where there is any.
    pub(super) fn basin_level(&self) -> Option<f64> {
        let floor = self.floor.as_ref().filter(|_| self.behind.has_water())?;
        Some(floor.basin_level_m.unwrap_or(self.still_water_depth_m))
    }

    /// The lattice of its particles, over its floor.
    pub(super) fn basin_lattice(&self, numerics: &Numerics) -> Option<Lattice> {
        let (level, floor) = (self.basin_level()?, self.floor.as_ref()?);
        let size = [floor.floor_length_m, level - floor.floor_height_m];
        Some(Lattice::new(size, numerics.particle_spacing_m, 90.0))
    }

    /// How far the ground behind the wall's face extends, and its lowest place over the paddle's
    /// foot, metres.
    pub(super) fn behind_m(&self) -> [f64; 2] {
        let crest = self.crest.as_ref().map_or(0.0, |crest| crest.crest_width_m);
        let floor = self.floor.as_ref().map(|floor| (floor.floor_length_m, floor.floor_height_m));
        let (length, height) = floor.unwrap_or_default();
        [crest + length, height.min(0.0)]
    }

    /// Area of the still water behind the wall, m².
    pub(super) fn basin_area(&self) -> f64 {
        let floor = self.basin_level().zip(self.floor.as_ref());
        floor.map_or(0.0, |(level, floor)| floor.floor_length_m * (level - floor.floor_height_m))
    }

    /// Speed with which water of the scene's wave falls from above the crest onto the floor behind
    /// it, m/s.
    pub(super) fn fall_speed(&self) -> f64 {
        let Some((crest, floor)) = self.crest.as_ref().zip(self.floor.as_ref()) else { return 0.0 };
        let top = self.still_water_depth_m * (1.0 + self.wave_height_ratio);
        let fall = top + crest.crest_freeboard_m - floor.floor_height_m;
        (2.0 * self.gravity_m_per_s2 * fall).sqrt()
    }

    /// Checks a crest against wall, bed and scheme.
    pub(super) fn validate_crest(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let Some(CrestKeys { crest_freeboard_m, crest_width_m }) = self.crest else {
            return Ok(());
        };
        let behind = value_of(&self.behind).map_or_else(String::new, |value| value.to_string());
        let no = |allowed: &str| error("behind", &behind, allowed);
        if numerics.scheme == Scheme::Isph {
            return no("is for scheme = \"wcsph\": isph knows endless walls alone");
        }
        if self.wall_angle_deg != 90.0 {
            return no("is for an upright wall: leave wall_angle_deg out");
        }
        if numerics.stop_when_settled {
            return no("is not for stop_when_settled = true: the water becomes less");
        }
        let radius = numerics.support_radius_ratio * numerics.particle_spacing_m;
        if self.floor.is_some() && below(crest_width_m, 2.0 * radius) {
            let allowed = format!(
                "must be {} m or more, two of the kernel's support radii: the water before a wall \
                 must not feel what is behind it",
                nine_digits(2.0 * radius)
            );
            return error("crest_width_m", crest_width_m, &allowed);
        }
        if below(crest_width_m, radius) {
            let allowed =
                format!("must be {} m or more, the kernel's support radius", nine_digits(radius));
            return error("crest_width_m", crest_width_m, &allowed);
        }
        let toe = self.bed.as_ref().map_or(0.0, |bed| bed.end()[1]);
        let height = self.still_water_depth_m + crest_freeboard_m;
        if below(height, toe + radius) {
            let least = nine_digits(toe + radius - self.still_water_depth_m);
            let allowed = format!(
                "must be {least} m or more, so that the wall rises from its bed by a support radius"
            );
            return error("crest_freeboard_m", crest_freeboard_m, &allowed);
        }
        let highest = WALL_HEIGHT * self.still_water_depth_m;
        if below(highest, height) {
            let allowed = format!(
                "must be {} m or less: walls are {} m high",
                nine_digits(highest - self.still_water_depth_m),
                nine_digits(highest)
            );
            return error("crest_freeboard_m", crest_freeboard_m, &allowed);
        }
        self.validate_floor(numerics, (height, radius))
    }

    /// Checks the floor behind a crest of this height, metres, and the water on it.
    fn validate_floor(
        &self,
        numerics: &Numerics,
        (crest, radius): (f64, f64),
    ) -> Result<(), ConfigError> {
        let Some(floor) = &self.floor else { return Ok(()) };
        let FloorKeys { floor_height_m, floor_length_m, basin_level_m } = **floor;
        let deepest = WALL_HEIGHT * self.still_water_depth_m;
        let [lowest, highest] = [crest - deepest, crest - radius];
        if below(floor_height_m, lowest) || below(highest, floor_height_m) {
            let [lowest, highest] = [lowest, highest].map(nine_digits);
            let allowed = format!(
                "must be {lowest} to {highest} m: {WALL_HEIGHT} depths to a support radius below \
                 the crest"
            );
            return error("floor_height_m", floor_height_m, &allowed);
        }
        if below(floor_length_m, 2.0 * radius) {
            let allowed = format!(
                "must be {} m or more, two of the kernel's support radii",
                nine_digits(2.0 * radius)
            );
            return error("floor_length_m", floor_length_m, &allowed);
        }
        let Some(level) = self.basin_level() else { return Ok(()) };
        let clear = CLEAR * numerics.particle_spacing_m;
        let [lowest, highest] = [floor_height_m + radius, crest - clear];
        if below(highest, lowest) {
            let allowed = format!(
                "leaves no room for a basin, which needs a support radius of water, and {CLEAR} spacings or more from \
                 there to the crest: must be {} m or less, or crest_freeboard_m larger, or particle_spacing_m smaller",
                nine_digits(highest - radius)
            );
            return error("floor_height_m", floor_height_m, &allowed);
        }
        if below(level, lowest) || below(highest, level) {
            let [lowest, highest] = [lowest, highest].map(nine_digits);
            let allowed = format!(
                "must be {lowest} to {highest} m: a support radius of water or more, and {CLEAR} \
                 spacings or more below the crest"
            );
            let given = basin_level_m
                .map_or(format!("{level} (still_water_depth_m)"), |level| level.to_string());
            return error("basin_level_m", given, &allowed);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::CaseConfig;
    use toml::Table;

    fn of(scene: &str, spacing: f64) -> Result<CaseConfig, String> {
        let table = |text: &str| text.parse::<Table>().unwrap();
        let numerics = table(&format!("particle_spacing_m = {spacing}"));
        CaseConfig::from_tables(&table(scene), &numerics).map_err(|error| error.to_string())
    }

    /// A floor at 0.02 m was once refused with "must be -0.58 to 0.02 m", because 0.2 + 0.02 - 0.2
    /// is less by 6e-18.
    #[test]
    fn a_bound_that_is_told_is_allowed() {
        let wall = |floor: f64| {
            format!(
                "behind = \"floor\"\ncrest_freeboard_m = 0.02\ncrest_width_m = 0.4\nfloor_length_m = 1\n\
                 floor_height_m = {floor}"
            )
        };
        for height in [-0.58, 0.0, 0.02] {
            assert!(of(&wall(height), 0.04).is_ok(), "{:?}", of(&wall(height), 0.04).err());
        }
        for height in [-0.5801, 0.0201] {
            let told = of(&wall(height), 0.04).unwrap_err();
            assert!(told.contains("must be -0.58 to 0.02 m: 4 depths"), "{told}");
        }
    }

    /// The message was once: basin_level_m "must be 0.223 to 0.2051 m".
    #[test]
    fn a_floor_without_room_for_water_is_told_as_such() {
        let wall = |floor: f64| {
            format!(
                "behind = \"basin\"\ncrest_freeboard_m = 0.02\ncrest_width_m = 0.4\nfloor_length_m = 1\n\
                 floor_height_m = {floor}\nbasin_level_m = 0.205"
            )
        };
        let told = of(&wall(0.16), 0.01).unwrap_err();
        assert!(
            told.starts_with("scene.floor_height_m = 0.16: leaves no room for a basin"),
            "{told}"
        );
        assert!(told.contains("must be 0.155 m or less, or crest_freeboard_m larger"), "{told}");
        assert!(of(&wall(0.155), 0.01).is_ok());
    }
}
