//! Moving walls: each turns time or force into motion, and knows nothing of particles.

mod kick;
mod spring_wall;

pub use spring_wall::{SpringWall, WallStep};

/// Horizontal motion of a body over one step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodyMotion {
    /// Displacement from rest at the start of the step, metres.
    pub offset: f64,
    /// Velocity, m/s: displacement over the step divided by its length, so that ghosts move as
    /// fast as their wall.
    pub velocity: f64,
    /// Acceleration, m/s².
    pub acceleration: f64,
}
