//! The shape of a tank, and the places of cells in its lattices.

/// The tank at rest, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TankLayout {
    /// Distance between the toes of both walls.
    pub length: f64,
    /// Particle spacing along the bed.
    pub spacing_x: f64,
    /// Particle spacing upwards.
    pub spacing_y: f64,
    /// Support radius of the kernel: the thickness of a wall.
    pub support_radius: f64,
    /// How far the walls rise above the bed.
    pub wall_height: f64,
    /// How far the bed goes on behind the wall, so that the wall can move over it.
    pub bed_beyond_wall: f64,
    /// How far the bed goes on before the paddle, for the same reason.
    pub bed_before_paddle: f64,
    /// Angle of the right wall from the bed, degrees: 90 is vertical, 120 leans away from the water.
    pub wall_angle_deg: f64,
    /// Height of the still water's surface above the paddle's foot.
    pub still_level: f64,
    /// Whether the bed may run dry: its ghosts then ask face points whether they are wet.
    pub dry_bed: bool,
    /// The end of the right wall; none if no water goes over it.
    pub crest: Option<CrestShape>,
}

#[cfg(test)]
impl TankLayout {
    /// A tank with upright walls and a bed that ends at them, at spacings of 0.02 m, for tests.
    pub(super) fn plain(length: f64, wall_height: f64, crest: Option<CrestShape>) -> TankLayout {
        TankLayout {
            length,
            spacing_x: 0.02,
            spacing_y: 0.02,
            support_radius: 0.1,
            wall_height,
            bed_beyond_wall: 0.0,
            bed_before_paddle: 0.0,
            wall_angle_deg: 90.0,
            still_level: f64::INFINITY,
            dry_bed: false,
            crest,
        }
    }
}

/// The crest of an upright wall, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrestShape {
    /// Above the paddle's foot.
    pub height: f64,
    /// From the wall's face to its back.
    pub width: f64,
    /// The ground behind it; none where water is taken away there.
    pub floor: Option<FloorBehind>,
}

/// A level floor behind a wall with a crest, up to an end wall, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorBehind {
    /// Above the paddle's foot.
    pub height: f64,
    /// From the back of the wall to the end wall.
    pub length: f64,
    /// Particle spacing there, along the floor and upwards.
    pub spacing: [f64; 2],
}

/// Centre of a cell, metres.
pub(super) fn at(cell: i64, spacing: f64) -> f64 {
    (cell as f64 + 0.5) * spacing
}
