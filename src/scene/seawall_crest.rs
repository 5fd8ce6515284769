//! A seawall that ends in a crest, over which water goes.

use super::crest::CrestKeys;
use super::numerics::{Numerics, Scheme};
use super::seawall::{SeawallScene, error};
use crate::boundary::CrestShape;
use crate::keys::ConfigError;

impl SeawallScene {
    /// Where the wall ends, if water may go over it.
    pub(super) fn crest_shape(&self) -> Option<CrestShape> {
        let crest = self.crest.as_ref()?;
        let height = self.still_water_depth_m + crest.crest_freeboard_m;
        Some(CrestShape { height, width: crest.crest_width_m })
    }

    /// Checks what a crest asks of wall, bed and scheme.
    pub(super) fn validate_crest(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let Some(shape) = self.crest_shape() else { return Ok(()) };
        let Some(CrestKeys { crest_freeboard_m, crest_width_m }) = self.crest else {
            return Ok(());
        };
        let outflow = |allowed: &str| error("behind", "\"outflow\"", allowed);
        if numerics.scheme == Scheme::Isph {
            return outflow("is for scheme = \"wcsph\": isph knows endless walls alone");
        }
        if self.wall_angle_deg != 90.0 {
            return outflow("is for an upright wall: leave wall_angle_deg out");
        }
        if numerics.stop_when_settled {
            return outflow("is not for stop_when_settled = true: the water becomes less");
        }
        let radius = numerics.support_radius_ratio * numerics.particle_spacing_m;
        if crest_width_m < radius {
            let allowed = format!("must be {radius} m or more, the kernel's support radius");
            return error("crest_width_m", crest_width_m, &allowed);
        }
        let toe = self.bed.as_ref().map_or(0.0, |bed| bed.end()[1]);
        if shape.height < toe + radius {
            let least = toe + radius - self.still_water_depth_m;
            let allowed = format!(
                "must be {least} m or more, so that the wall rises from its bed by a support radius"
            );
            return error("crest_freeboard_m", crest_freeboard_m, &allowed);
        }
        let highest = super::filling::WALL_HEIGHT * self.still_water_depth_m;
        if shape.height > highest {
            let allowed = format!(
                "must be {} m or less: walls are {highest} m high",
                highest - self.still_water_depth_m
            );
            return error("crest_freeboard_m", crest_freeboard_m, &allowed);
        }
        Ok(())
    }
}
