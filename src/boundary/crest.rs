//! A wall that ends in a level crest, over which water may go.

use super::layout::{CrestShape, TankLayout};
use super::plane::Plane;
use super::profile::Profile;

/// The back of a wall goes so many support radii down: farther than any water that is still followed.
pub(super) const BACK: f64 = 3.0;

/// Where a wall ends, and from where on water that has gone over it is taken away; metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Crest {
    /// Of its top, above the paddle's foot.
    pub height: f64,
    /// From its front to its back.
    pub ends: [f64; 2],
    /// Bed, face, top and back as one line.
    pub outline: Profile,
    /// Water so far behind the back, or below the top there, is taken away.
    pub reach: f64,
}

impl Crest {
    /// The crest of a wall with this face, at the end of a bed.
    pub(super) fn of(
        shape: CrestShape,
        layout: &TankLayout,
        face: Plane,
        bed: Option<&Profile>,
    ) -> Crest {
        let CrestShape { height, width } = shape;
        let [front, foot] = face.point;
        let back = front + width;
        let reach = layout.support_radius;
        let level = [[0.0, 0.0], [front, foot]];
        let mut points = bed.map_or(level.to_vec(), |bed| bed.points().to_vec());
        points.extend([[front, height], [back, height], [back, height - BACK * reach]]);
        let outline = Profile::checked(points).expect("a bed and a wall that rises from it");
        Crest { height, ends: [front, back], outline, reach }
    }

    /// Whether water at a place has left for good.
    pub fn is_gone(&self, [x, y]: [f64; 2]) -> bool {
        let behind = x - self.ends[1];
        behind > self.reach || behind > 0.0 && y < self.height - self.reach
    }

    /// How much of a row of the face, metres high, around a point of it lies below the top.
    pub(super) fn below(&self, [x, y]: [f64; 2], row: f64) -> f64 {
        if x > self.ends[0] { 0.0 } else { (self.height - y + 0.5 * row).clamp(0.0, row) }
    }
}
