//! The contract of scenes of every kind: scales, water, and the building of the tank.

use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::ConfigError;
use crate::math::simd::SimdPath;

/// The walls around the water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Walls {
    /// A bed and two walls that rise from it.
    Tank,
    /// A box with a lid, full of water.
    Closed,
    /// Nothing.
    None,
}

/// A scene of one kind, by its keys.
pub(super) trait SceneOfKind {
    /// The name of its depth.
    fn depth_name(&self) -> &'static str {
        "still water depth"
    }

    /// Its walls.
    fn walls(&self) -> Walls {
        Walls::Tank
    }

    /// The reason why incompressible SPH cannot run it; none if it can.
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

    /// The particles at the start. By default they fill the length up to the depth.
    fn lattice(&self, numerics: &Numerics) -> Lattice {
        Lattice::whole(&self.frame(), numerics, 90.0)
    }

    /// Fluid particles.
    fn particles(&self, numerics: &Numerics) -> usize {
        self.lattice(numerics).particles()
    }

    /// Checks keys against each other.
    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        Ok(())
    }

    /// Builds the tank.
    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank;
}
