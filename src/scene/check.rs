//! Range checks that name the key, its value and what is allowed.

use super::error::ConfigError;
use super::filling::WALL_HEIGHT;

/// Checks the values of one section.
pub(super) struct Check {
    section: &'static str,
}

impl Check {
    pub(super) fn section(section: &'static str) -> Check {
        Check { section }
    }

    pub(super) fn error(&self, key: &str, value: impl ToString, allowed: &str) -> ConfigError {
        ConfigError::new(&format!("{}.{key}", self.section), value, allowed)
    }

    pub(super) fn positive(&self, key: &str, value: f64) -> Result<(), ConfigError> {
        if value.is_finite() && value > 0.0 {
            return Ok(());
        }
        Err(self.error(key, value, "must be a finite number above 0"))
    }

    pub(super) fn not_negative(&self, key: &str, value: f64) -> Result<(), ConfigError> {
        if value.is_finite() && value >= 0.0 {
            return Ok(());
        }
        Err(self.error(key, value, "must be a finite number, 0 or above"))
    }

    pub(super) fn range(
        &self,
        key: &str,
        value: f64,
        low: f64,
        high: f64,
    ) -> Result<(), ConfigError> {
        if value >= low && value <= high {
            return Ok(());
        }
        Err(self.error(key, value, &format!("must be a number from {low} to {high}")))
    }

    /// An inclined wall must stay clear of the other end as far up as it goes.
    pub(super) fn wall_angle(
        &self,
        angle_deg: f64,
        depth: f64,
        length: f64,
    ) -> Result<(), ConfigError> {
        self.range("wall_angle_deg", angle_deg, 30.0, 150.0)?;
        let reach = WALL_HEIGHT * depth / libm::tan(angle_deg.to_radians());
        if angle_deg < 90.0 && reach > 0.9 * length {
            let allowed = format!(
                "leans over the whole tank: {WALL_HEIGHT} depths up it has come {reach:.2} m of \
                 {length} m"
            );
            return Err(self.error("wall_angle_deg", angle_deg, &allowed));
        }
        Ok(())
    }
}
