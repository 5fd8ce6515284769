//! A straight wall's face.

/// A straight wall: everything beyond it is solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point on its face; at the bed, if it rises from the bed.
    pub point: [f64; 2],
    /// Unit normal out of the water.
    pub normal: [f64; 2],
}

/// A distance out of reach of everything, metres.
const NOWHERE: f64 = 1e9;

impl Plane {
    /// A face with this unit normal that lies out of every reach.
    pub fn nowhere([nx, ny]: [f64; 2]) -> Plane {
        Plane { point: [nx * NOWHERE, ny * NOWHERE], normal: [nx, ny] }
    }

    /// How far a place lies behind the face; negative in the water.
    #[inline(always)]
    pub fn beyond(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.point[0]) * self.normal[0] + (y - self.point[1]) * self.normal[1]
    }

    /// The same wall, moved along x.
    pub fn moved(&self, offset: f64) -> Plane {
        Plane { point: [self.point[0] + offset, self.point[1]], ..*self }
    }

    /// The point at `depth` in front of the face, beside a place.
    #[inline(always)]
    pub fn in_front(&self, [x, y]: [f64; 2], depth: f64) -> [f64; 2] {
        let [nx, ny] = self.normal;
        let along = (y - self.point[1]) * nx - (x - self.point[0]) * ny;
        [self.point[0] - ny * along - depth * nx, self.point[1] + nx * along - depth * ny]
    }

    /// A vector with its component across the wall changed by `across`.
    #[inline(always)]
    pub fn with_across(&self, [x, y]: [f64; 2], across: impl Fn(f64) -> f64) -> [f64; 2] {
        let [nx, ny] = self.normal;
        let (along, out) = (y * nx - x * ny, across(x * nx + y * ny));
        [out * nx - along * ny, along * nx + out * ny]
    }
}
