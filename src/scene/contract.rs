//! What a scene of every kind must tell: its scales, its water, and how its tank is built.

use super::frame::Frame;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::ConfigError;
use crate::math::simd::SimdPath;

/// What holds the water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Walls {
    /// A bed and two walls that rise from it.
    Tank,
    /// A box, lid included, that the water fills.
    Closed,
    /// Nothing.
    None,
}

/// A scene of one kind, by its keys.
pub(super) trait SceneOfKind {
    /// What its depth is, in words.
    const DEPTH: &'static str;
    /// What holds its water.
    const WALLS: Walls = Walls::Tank;
    /// Why incompressible SPH cannot take it; none where it can.
    const NOT_FOR_ISPH: Option<&'static str> = None;

    /// Its scales.
    fn frame(&self) -> Frame;

    /// Area of the water at the start, square metres. By default water fills the length up to the depth.
    fn water_area(&self) -> f64 {
        let Frame { length, depth, .. } = self.frame();
        length * depth
    }

    /// Fluid particles.
    fn particles(&self, numerics: &Numerics) -> usize;

    /// Checks what no key can tell alone.
    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        Ok(())
    }

    /// Builds the tank.
    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank;
}
