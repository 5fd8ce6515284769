//! A scene's water and its walls, before any scheme.

use super::bed_lattice::BedLattice;
use super::contract::Walls;
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use crate::boundary::{CrestShape, Profile};
use crate::theory::central_field::CentralField;

/// Walls rise to this many depths above the bed.
pub(super) const WALL_HEIGHT: f64 = 4.0;

/// Water and its walls.
pub(super) struct Filling {
    pub lattice: Lattice,
    /// (x, y, density, mass).
    pub points: Vec<[f64; 4]>,
    /// Density at zero pressure, kg/m³.
    pub surface_density: f64,
    pub wall_angle_deg: f64,
    /// Whether the bed may run dry.
    pub dry_bed: bool,
    /// How far the bed goes on behind the right wall, metres.
    pub bed_beyond_wall: f64,
    /// How far it goes on before the paddle, metres.
    pub bed_before_paddle: f64,
    pub walls: Walls,
    /// Whether the water is at rest, and must start so.
    pub balanced: bool,
    /// Velocities at the start, in the order of the points; none for water at rest.
    pub velocities: Vec<[f64; 2]>,
    pub field: Option<CentralField>,
    /// The bed, where it is not level.
    pub profile: Option<Profile>,
    /// The end of the right wall, if water may go over it.
    pub crest: Option<CrestShape>,
    /// Still water in a basin behind the right wall.
    pub basin: Option<Basin>,
}

/// Still water behind the right wall.
pub(super) struct Basin {
    pub rows: usize,
    /// (x, y, density, mass), column by column.
    pub points: Vec<[f64; 4]>,
}

impl Filling {
    /// Mass of the still water behind the right wall, kg per metre of width.
    pub(super) fn mass_behind(&self) -> f64 {
        let points = self.basin.iter().flat_map(|basin| &basin.points);
        points.fold(0.0, |sum, point| sum + point[3])
    }

    /// The particles of still water over a bed that is not level.
    pub(super) fn bed_lattice<'a>(&self, profile: &'a Profile, surface: f64) -> BedLattice<'a> {
        let Lattice { columns, spacing, .. } = self.lattice;
        BedLattice { profile, columns, spacing, surface, rows_above: 0 }
    }

    /// Water at rest between upright walls, from (x, y, density, mass).
    pub(super) fn of(lattice: Lattice, points: Vec<[f64; 4]>, surface_density: f64) -> Filling {
        Filling {
            lattice,
            points,
            surface_density,
            wall_angle_deg: 90.0,
            dry_bed: false,
            bed_beyond_wall: 0.0,
            bed_before_paddle: 0.0,
            walls: Walls::Tank,
            balanced: false,
            velocities: Vec::new(),
            field: None,
            profile: None,
            crest: None,
            basin: None,
        }
    }

    /// The same water with a pressure (Pa) at every place, and the density for it.
    pub(super) fn under(
        mut self,
        frame: &Frame,
        numerics: &Numerics,
        pressure: impl Fn([f64; 2]) -> f64,
    ) -> Filling {
        let state = frame.state_equation(numerics, self.surface_density);
        for [x, y, density, mass] in &mut self.points {
            let pressed = state.density(pressure([*x, *y]));
            *mass = *mass * pressed / *density;
            *density = pressed;
        }
        self
    }

    /// The same water with a velocity at every place.
    pub(super) fn moving(self, velocity: impl Fn([f64; 2]) -> [f64; 2]) -> Filling {
        let velocities = self.points.iter().map(|&[x, y, ..]| velocity([x, y])).collect();
        Filling { velocities, ..self }
    }
}
