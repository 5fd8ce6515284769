//! What a scene of every kind must tell: its scales, its water, and how its tank is built.

use super::frame::Frame;
use super::lattice::Lattice;
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
    fn depth_name(&self) -> &'static str {
        "still water depth"
    }

    /// What holds its water.
    fn walls(&self) -> Walls {
        Walls::Tank
    }

    /// Why incompressible SPH cannot take it; none where it can.
    fn not_for_isph(&self) -> Option<&'static str> {
        None
    }

    /// Its scales.
    fn frame(&self) -> Frame;

    /// Area of the water at the start, square metres. By default water fills the length up to the depth.
    fn water_area(&self) -> f64 {
        let Frame { length, depth, .. } = self.frame();
        length * depth
    }

    /// Where particles stand at the start. By default they fill the length up to the depth.
    fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, 90.0)
    }

    /// Fluid particles.
    fn particles(&self, numerics: &Numerics) -> usize {
        self.lattice(numerics).particles()
    }

    /// Checks what no key can tell alone.
    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        Ok(())
    }

    /// Builds the tank.
    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank;
}
