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
    /// Bed, face, top and back as one line, with the floor and the end wall behind it where there are any.
    pub outline: Profile,
    /// Water so far behind the back, or below the top there, is taken away where no floor keeps it.
    pub reach: f64,
    /// Where the end wall behind the floor stands; none where water is taken away.
    pub end: Option<f64>,
}

impl Crest {
    /// The crest of a wall with this face, at the end of a bed.
    pub(super) fn of(
        shape: CrestShape,
        layout: &TankLayout,
        face: Plane,
        bed: Option<&Profile>,
    ) -> Crest {
        let CrestShape { height, width, floor } = shape;
        let [front, foot] = face.point;
        let back = front + width;
        let end = floor.map(|floor| back + floor.length);
        let reach = layout.support_radius;
        let level = [[0.0, 0.0], [front, foot]];
        let mut points = bed.map_or(level.to_vec(), |bed| bed.points().to_vec());
        points.extend([[front, height], [back, height]]);
        match (floor, end) {
            (Some(floor), Some(end)) => {
                let top = layout.wall_height;
                points.extend([[back, floor.height], [end, floor.height], [end, top]]);
            }
            _ => points.push([back, height - BACK * reach]),
        }
        let outline = Profile::checked(points).expect("a bed and a wall that rises from it");
        Crest { height, ends: [front, back], outline, reach, end }
    }

    /// Whether water at a place has left for good.
    pub fn is_gone(&self, [x, y]: [f64; 2]) -> bool {
        let behind = x - self.ends[1];
        self.end.is_none() && (behind > self.reach || behind > 0.0 && y < self.height - self.reach)
    }

    /// Where water may be at most, metres along the tank; `room` is left at an end wall.
    pub fn farthest(&self, room: f64) -> f64 {
        self.end.map_or(self.ends[1] + 2.0 * self.reach, |end| end + room)
    }

    /// The height that a gauge stands on, metres. At the wall's face it is in the water before it, and at the end
    /// wall in that on the floor.
    pub fn ground(&self, x: f64) -> f64 {
        let points = self.outline.points();
        let before = |up: usize| points[up - 1][1];
        if self.end.is_some_and(|end| x >= end) {
            return before(points.len() - 1);
        }
        let face = points.iter().position(|point| *point == [self.ends[0], self.height]);
        face.filter(|_| x == self.ends[0]).map_or_else(|| self.outline.height(x), before)
    }

    /// The line from the wall's back on, where water stays behind it.
    pub fn line_behind(&self) -> Option<&[[f64; 2]]> {
        let points = self.outline.points();
        self.end.map(|_| &points[points.len() - 4..])
    }

    /// How much of a row of the face, metres high, around a point of it lies below the top.
    pub(super) fn below(&self, [x, y]: [f64; 2], row: f64) -> f64 {
        if x > self.ends[0] { 0.0 } else { (self.height - y + 0.5 * row).clamp(0.0, row) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::layout::FloorBehind;

    /// A gauge at an upright face stood on its top: at the end wall it read 0.8 m of water on a dry floor.
    #[test]
    fn a_gauge_at_a_face_stands_in_the_water_before_it() {
        let floor = FloorBehind { height: -0.1, length: 0.5, spacing: [0.02, 0.02] };
        let shape = CrestShape { height: 0.3, width: 0.2, floor: Some(floor) };
        let layout = TankLayout::plain(1.0, 0.8, Some(shape));
        let bed = Profile::checked(vec![[0.0, 0.0], [0.5, 0.0], [1.0, 0.1]]).unwrap();
        let face = Plane { point: [1.0, 0.1], normal: [1.0, 0.0] };
        let crest = Crest::of(shape, &layout, face, Some(&bed));
        let end = crest.end.unwrap();
        let heights =
            [0.2, 0.75, 1.0, 1.1, 1.21, end - 1e-9, end, end + 0.1].map(|x| crest.ground(x));
        let exact = [0.0, 0.05, 0.1, 0.3, -0.1, -0.1, -0.1, -0.1];
        assert!(heights.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-9), "{heights:?}");
        let open = CrestShape { floor: None, ..shape };
        let crest = Crest::of(open, &TankLayout::plain(1.0, 0.8, Some(open)), face, None);
        assert_eq!([1.0, 1.1].map(|x| crest.ground(x)), [0.1, 0.3]);
    }
}
