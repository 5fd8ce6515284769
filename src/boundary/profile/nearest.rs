//! The nearest place of a bed.

use super::{Profile, SHORTEST, Stretch};
use crate::boundary::plane::Plane;

/// Distances that differ by more than this differ despite rounding, metres.
const CLEAR: f64 = 1e-6;

impl Profile {
    /// The face of the bed nearest to a place in the water, if it is within `near`, metres.
    pub fn face_within(&self, place: [f64; 2], near: f64) -> Option<Plane> {
        let over = |x: f64| place[1] - self.height(x) > near;
        if over(place[0]) && over(place[0] - near) && over(place[0] + near) {
            return None;
        }
        let (face, behind) = self.nearest(place);
        (behind > -near).then_some(face)
    }

    /// The nearest place of the bed to a place in or near the water. Returns the face there, and
    /// how far behind it the place lies, metres; negative in the water.
    pub fn nearest(&self, place: [f64; 2]) -> (Plane, f64) {
        let mut best = (f64::INFINITY, self.0[0]);
        let see = |foot: [f64; 2], best: &mut (f64, [f64; 2])| {
            let square = (place[0] - foot[0]).powi(2) + (place[1] - foot[1]).powi(2);
            if square < best.0 {
                *best = (square, foot);
            }
        };
        let [first, last] = [self.0[0], self.end()];
        see([place[0].min(first[0]), first[1]], &mut best);
        see([place[0].max(last[0]), last[1]], &mut best);
        // It is no farther than straight up or down. Of thousands of stretches only few are as
        // near.
        let straight = (place[1] - self.height(place[0])).abs();
        for pair in self.between(place[0] - straight - CLEAR, place[0] + straight + CLEAR) {
            let nearest = best.0.sqrt() + CLEAR;
            if gap_square(place, pair) <= nearest * nearest {
                see(Stretch::between(pair[0], pair[1]).foot(place), &mut best);
            }
        }
        let foot = best.1;
        let away = (place[0] - foot[0]).hypot(place[1] - foot[1]);
        let inside = place[1] < self.height(place[0]);
        let normal = if away > SHORTEST {
            let sign = if inside { 1.0 } else { -1.0 };
            [0, 1].map(|axis| sign * (place[axis] - foot[axis]) / away)
        } else {
            [0.0, -1.0]
        };
        (Plane { point: foot, normal }, if inside { away } else { -away })
    }

    /// The stretches, as their ends, that have a place between two x.
    fn between(&self, left: f64, right: f64) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        let points = self.points();
        let first = points.partition_point(|point| point[0] < left).saturating_sub(1);
        let last = (points.partition_point(|point| point[0] <= right) + 1).min(points.len());
        points[first..last.max(first)].windows(2).map(|pair| [pair[0], pair[1]])
    }
}

/// Square of the distance between a place and the bounding box of a stretch, m².
fn gap_square(place: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let gap = |axis: usize| {
        let [low, high] = [from[axis].min(to[axis]), from[axis].max(to[axis])];
        (low - place[axis]).max(place[axis] - high).max(0.0)
    };
    gap(0).powi(2) + gap(1).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The result of a search over all stretches, in their order.
    fn plainly(bed: &Profile, place: [f64; 2]) -> [f64; 2] {
        let [first, last] = [bed.points()[0], bed.end()];
        let ends = [[place[0].min(first[0]), first[1]], [place[0].max(last[0]), last[1]]];
        let feet = ends.into_iter().chain(bed.stretches().map(|stretch| stretch.foot(place)));
        let square = |foot: &[f64; 2]| (place[0] - foot[0]).powi(2) + (place[1] - foot[1]).powi(2);
        let mut best = (f64::INFINITY, first);
        for foot in feet.filter(|foot| square(foot).is_finite()) {
            if square(&foot) < best.0 {
                best = (square(&foot), foot);
            }
        }
        best.1
    }

    /// A bed of 4,000 points was once searched whole for every particle near it, at every step.
    #[test]
    fn the_nearest_place_is_that_of_all_stretches_to_the_bit() {
        let mut random = 7_u64;
        let mut next = move || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            (random >> 11) as f64 / (1_u64 << 53) as f64
        };
        for count in [2, 3, 10, 300] {
            for smooth in [1.0, 0.01] {
                let mut points = vec![[0.0, 0.0], [0.5, 0.0]];
                for at in 1..count {
                    let [x, y] = points[at];
                    let upright = next() < 0.2;
                    let along = if upright { 0.0 } else { (0.1 + next()) * 3.0 / count as f64 };
                    points.push([x + along, y + smooth * (next() - 0.45) * 3.0 / count as f64]);
                }
                let Ok(bed) = Profile::checked(points.clone()) else { panic!("{points:?}") };
                for _ in 0..2000 {
                    let place = [5.0 * next() - 0.5, 2.0 * next() - 1.0];
                    let (face, _) = bed.nearest(place);
                    assert_eq!(face.point, plainly(&bed, place), "{count}: {place:?}");
                }
                // At the bends several stretches are equally near.
                for &place in &points {
                    assert_eq!(bed.nearest(place).0.point, plainly(&bed, place));
                }
            }
        }
    }
}
