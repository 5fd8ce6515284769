//! A wall at the end of the water that may lean: its angle, and the water before it.

use super::filling::WALL_HEIGHT;
use super::frame::Frame;
use crate::keys::ConfigError;

/// Refuses a wall that would reach the other end.
pub(super) fn validate(angle_deg: f64, depth: f64, length: f64) -> Result<(), ConfigError> {
    let reach = WALL_HEIGHT * depth / libm::tan(angle_deg.to_radians());
    if angle_deg >= 90.0 || reach <= 0.9 * length {
        return Ok(());
    }
    let allowed = format!(
        "leans over the whole tank: {WALL_HEIGHT} depths up it has come {reach:.2} m of {length} m"
    );
    Err(ConfigError::new("scene.wall_angle_deg", angle_deg, allowed))
}

/// Area of still water before it, square metres.
pub(super) fn water_area(angle_deg: f64, frame: &Frame) -> f64 {
    let lean = if angle_deg == 90.0 { 0.0 } else { 1.0 / libm::tan(angle_deg.to_radians()) };
    frame.depth * (frame.length - 0.5 * lean * frame.depth)
}
