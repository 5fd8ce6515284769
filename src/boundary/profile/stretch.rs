//! A straight stretch of a bed.

use crate::boundary::plane::Plane;

/// Rise per length of a stretch above which no tongue of water lies on it.
pub const STEEP: f64 = 0.7;

/// Rise per length of a stretch above which it is a wall, whose ghosts ask how wet they are. On
/// flatter stretches whole ghosts bear even the thinnest sheet of water, and a dry ghost has no
/// water in reach. If ghosts of slopes of 45 to 55 degrees asked, they would stir still water and
/// create energy.
pub const WALL: f64 = 0.9;

/// A straight stretch of a bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Where it begins, metres.
    pub from: [f64; 2],
    /// Unit vector along it, away from the paddle.
    pub along: [f64; 2],
    /// Metres.
    pub length: f64,
}

impl Stretch {
    pub(super) fn between([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Stretch {
        let length = (x1 - x0).hypot(y1 - y0);
        Stretch { from: [x0, y0], along: [(x1 - x0) / length, (y1 - y0) / length], length }
    }

    /// Unit normal out of the water.
    pub fn normal(&self) -> [f64; 2] {
        [self.along[1], -self.along[0]]
    }

    /// As an endless face.
    pub fn plane(&self) -> Plane {
        Plane { point: self.from, normal: self.normal() }
    }

    /// The place at this distance along it and behind its face, metres.
    pub fn place(&self, along: f64, behind: f64) -> [f64; 2] {
        let normal = self.normal();
        [0, 1].map(|axis| self.from[axis] + along * self.along[axis] + behind * normal[axis])
    }

    /// How far along it a place is, metres.
    pub fn passed(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.from[0]) * self.along[0] + (y - self.from[1]) * self.along[1]
    }

    /// How far behind its face a place is, metres.
    pub fn behind(&self, [x, y]: [f64; 2]) -> f64 {
        let normal = self.normal();
        (x - self.from[0]) * normal[0] + (y - self.from[1]) * normal[1]
    }

    /// Its lowest and its highest place, metres above the bed at the paddle.
    pub(super) fn heights(&self) -> [f64; 2] {
        let [from, to] = [self.from[1], self.place(self.length, 0.0)[1]];
        [from.min(to), from.max(to)]
    }

    /// How much it rises or falls along its length: the sine of its slope.
    pub fn rise(&self) -> f64 {
        self.along[1].abs()
    }

    /// The nearest of its points to a place.
    pub fn foot(&self, place: [f64; 2]) -> [f64; 2] {
        let [x, y] = [place[0] - self.from[0], place[1] - self.from[1]];
        let way = (x * self.along[0] + y * self.along[1]).clamp(0.0, self.length);
        self.place(way, 0.0)
    }
}

/// Angle of the bend from one stretch to the next, radians; positive upwards.
pub fn turn(before: &Stretch, after: &Stretch) -> f64 {
    let ([ax, ay], [bx, by]) = (before.along, after.along);
    libm::atan2(ax * by - ay * bx, ax * bx + ay * by)
}

/// Whether a wall ends low at the bend from one stretch to the next; all in metres. It rises out of
/// the still water there. The other stretch is dry, less than a support radius above the water.
pub fn ends_low(
    [before, after]: [&Stretch; 2],
    still_level: f64,
    [spacing, support_radius]: [f64; 2],
) -> bool {
    let near = (-0.5 * spacing..support_radius).contains(&(after.from[1] - still_level));
    let steep = [before, after].map(|stretch| stretch.rise() > WALL);
    near && steep[0] != steep[1] && turn(before, after) < 0.0
}
