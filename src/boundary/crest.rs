//! A wall that ends in a level crest, over which water may go.

use super::layout::{CrestShape, TankLayout};
use super::plane::Plane;
use super::profile::Profile;

/// The back of a wall goes this many support radii down, below all water that is still followed.
pub(super) const BACK: f64 = 3.0;

/// Water lies on a top if its mean is this many spacings above the top: half the height of a single
/// row's mean.
const LIES_ON: f64 = 0.25;
/// Distance from an edge to the kernel's mean of the water that stands beside it, over the length
/// by which the support reaches across the edge. For a half plane it is 0.15 to 0.21 with Wendland
/// C2, 0.11 to 0.25 with other kernels.
const BESIDE: f64 = 0.2;

/// Where a wall ends, and where water that has gone over it is taken away; metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Crest {
    /// Height of its top above the paddle's foot.
    pub height: f64,
    /// x of its front and its back.
    pub ends: [f64; 2],
    /// Bed, face, top and back as one line, with the floor and the end wall behind it where there are any.
    pub outline: Profile,
    /// Distance behind the back, or below the top there, at which water is taken away if no floor
    /// keeps it.
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

    /// The largest x of the water, metres. `room` is added at an end wall.
    pub fn farthest(&self, room: f64) -> f64 {
        self.end.map_or(self.ends[1] + 2.0 * self.reach, |end| end + room)
    }

    /// The height of the ground under a gauge, metres. At the wall's face the gauge is in the water
    /// before it. At the end wall it is in the water on the floor.
    pub fn ground(&self, x: f64) -> f64 {
        let points = self.outline.points();
        let before = |up: usize| points[up - 1][1];
        if self.end.is_some_and(|end| x >= end) {
            return before(points.len() - 1);
        }
        let face = points.iter().position(|point| *point == [self.ends[0], self.height]);
        face.filter(|_| x == self.ends[0]).map_or_else(|| self.outline.height(x), before)
    }

    /// The line from the wall's back onwards, if water stays behind it.
    pub fn line_behind(&self) -> Option<&[[f64; 2]]> {
        let points = self.outline.points();
        self.end.map(|_| &points[points.len() - 4..])
    }

    /// The share of the water around a mirror point at x that lies on the top, not beside it. It is
    /// found from the mean place of that water, metres.
    ///
    /// Water that climbs the face is also in reach. Ghosts under the top would turn it down and
    /// push it back. The wall would be pressed 4 % too hard as the water passes its edge. So the
    /// share is one where the mean is over the top. Before the edge it fades out, at half the
    /// distance of the mean of water that only stands beside the edge.
    pub(super) fn carried(&self, x: f64, mean: [f64; 2], spacing: f64) -> f64 {
        let [over, above] = [mean[0] - self.ends[0], mean[1] - self.height];
        let high = lying(above, spacing);
        let beside = BESIDE * (self.reach - (x - self.ends[0]));
        if beside <= 0.0 { high } else { high * (1.0 + 2.0 * over / beside).clamp(0.0, 1.0) }
    }

    /// Wet share of the face within a support radius below the crest, from 0 to 1. Points nearer to
    /// the crest weigh more. `face` gives heights, metres, and the wetness there.
    pub(super) fn reached(&self, face: impl Iterator<Item = [f64; 2]>) -> f64 {
        let near = |height: f64| 1.0 - (self.height - height) / self.reach;
        let points = face.map(|[height, wet]| [near(height), wet]);
        let points = points.filter(|[near, _]| (0.0..=1.0).contains(near));
        let add = |[sum, all]: [f64; 2], [near, wet]: [f64; 2]| [sum + near * wet, all + near];
        let [sum, all] = points.fold([0.0; 2], add);
        if all > 0.0 { sum / all } else { 0.0 }
    }

    /// The part of a row of the face that lies below the top, metres. `row` is its height.
    pub(super) fn below(&self, [x, y]: [f64; 2], row: f64) -> f64 {
        if x > self.ends[0] { 0.0 } else { (self.height - y + 0.5 * row).clamp(0.0, row) }
    }
}

/// The share of some water that lies on a top. `above` is the height of its mean above the top,
/// metres.
pub(super) fn lying(above: f64, spacing: f64) -> f64 {
    (above / (LIES_ON * spacing)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::layout::FloorBehind;
    use crate::kernel::KernelChoice;

    /// The water's mean is found by sums over a lattice, with and without water on the crest.
    #[test]
    fn water_beside_the_edge_is_not_carried_and_a_sheet_is() {
        let shape = CrestShape { height: 0.3, width: 0.2, floor: None };
        let layout = TankLayout::plain(1.0, 0.8, Some(shape));
        let crest =
            Crest::of(shape, &layout, Plane { point: [1.0, 0.0], normal: [1.0, 0.0] }, None);
        let (radius, spacing) = (layout.support_radius, 0.2 * layout.support_radius);
        let carried = |at: [f64; 2], is_wet: &dyn Fn(f64, f64) -> bool| {
            let half = |k: i32| spacing * (f64::from(k) + 0.5);
            let places = (-20..20).flat_map(|i| (-20..20).map(move |j| (i, j)));
            let places = places.map(|(i, j)| [1.0 + half(i), 0.3 + half(j)]);
            let water = places.filter(|[x, y]| is_wet(x - 1.0, y - 0.3));
            let [mass, x, y] = water.fold([0.0; 3], |[mass, sum_x, sum_y], [x, y]| {
                let weight =
                    KernelChoice::WendlandC2.shape_at((x - at[0]).hypot(y - at[1]) / radius);
                [mass + weight, sum_x + weight * x, sum_y + weight * y]
            });
            crest.carried(at[0], [x / mass, y / mass], spacing)
        };
        for along in [0.5, 1.5, 3.5] {
            let at = [1.0 + along * spacing, 0.3 + 0.5 * spacing];
            let jet = |x: f64, _: f64| x < 0.0;
            let low_jet = |x: f64, y: f64| x < 0.0 && y < 3.0 * spacing;
            let sheet = |x: f64, y: f64| y > 0.0 && x < 0.15;
            assert_eq!([carried(at, &jet), carried(at, &low_jet)], [0.0; 2], "{along}");
            assert_eq!(carried(at, &sheet), 1.0, "{along}");
        }
        let far = [1.0 + 1.5 * radius, 0.3 + 0.5 * spacing];
        assert_eq!(carried(far, &|_, y| y > 0.0 && y < 1.5 * spacing), 1.0);
    }

    #[test]
    fn water_comes_to_a_crest_by_and_by() {
        let shape = CrestShape { height: 0.3, width: 0.2, floor: None };
        let layout = TankLayout::plain(1.0, 0.8, Some(shape));
        let face = Plane { point: [1.0, 0.0], normal: [1.0, 0.0] };
        let crest = Crest::of(shape, &layout, face, None);
        let reached = |level: f64| {
            let heights = (0..80).map(|row| 0.005 + 0.01 * f64::from(row));
            crest.reached(heights.map(|y| [y, f64::from(u8::from(y < level))]))
        };
        assert_eq!([0.0, 0.3 - crest.reach, 0.3, 0.5].map(reached), [0.0, 0.0, 1.0, 1.0]);
        let rising = [0.21, 0.23, 0.25, 0.27, 0.29].map(reached);
        assert!(rising.is_sorted() && rising[0] < 0.1 && rising[4] > 0.8, "{rising:?}");
    }

    /// A gauge at an upright face once stood on its top: at the end wall it read 0.8 m of water on
    /// a dry floor.
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
