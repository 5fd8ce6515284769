//! Images behind the corner of bed and wall, where the angle is not a right one.
//!
//! Water fills the angle φ. Its images in bed and face fill two sectors of φ beside it. The rest of
//! the solid is 2π - 3φ. Images of images fill it, two sectors of φ at a time. They are k
//! reflections of the water, in bed and face by turns. One begins with the bed, the other with the
//! face.
//!
//! The last two sectors may be larger together than the rest. Then they overlap, and their images
//! are weighted by the rest over the two sectors. At φ = 2π/n no images overlap except those
//! that coincide, at a right angle n = 4.
//!
//! Either each of the two reflections is the inverse of the other, or each is its own inverse. Both
//! have the same weight. So j's image is as far from i as i's image is from j, with the same
//! weight. The matrix stays symmetric, and pressure takes no energy.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::images::{Mirrors, Point};
use crate::body::Place;

/// Tolerance: a corner is right if its cosine is smaller, and an angle is none if this small a part
/// of 2π.
const ROUNDING: f64 = 1e-9;

impl Mirrors<'_> {
    /// Whether these two walls make a corner with the bed that is not a right one.
    pub(super) fn askew(&self, one: usize, other: usize) -> bool {
        let bed = Place::Bed.number();
        let ([nx, ny], [mx, my]) = (self.planes[one].normal, self.planes[other].normal);
        let (along, across) = (nx * mx + ny * my, nx * my - ny * mx);
        (one == bed) != (other == bed) && along.abs() > ROUNDING && across.abs() > ROUNDING
    }

    /// Appends images of images of the first `n` points, the water, behind corners that are not
    /// right ones.
    pub(super) fn fill_corners(&self, n: usize, points: &mut Vec<Point>) {
        let bed = Place::Bed.number();
        for wall in (0..self.planes.len()).filter(|&wall| wall != bed && self.askew(bed, wall)) {
            let ([nx, ny], [mx, my]) = (self.planes[bed].normal, self.planes[wall].normal);
            let angle = PI - libm::acos(nx * mx + ny * my);
            if TAU - 3.0 * angle <= ROUNDING {
                continue;
            }
            let [x, y] = self.planes[wall].point;
            // The angle between the water and these images.
            let apart = angle.min(TAU - 3.0 * angle).min(FRAC_PI_2);
            let farthest = self.reach / libm::sin(apart);
            let in_reach =
                |place| [bed, wall].iter().all(|&q| self.planes[q].beyond(place) < self.reach);
            let mut near: Vec<[Point; 2]> = (points[..n].iter())
                .filter(|Point { place, .. }| (place[0] - x).hypot(place[1] - y) < farthest)
                .map(|&point| [self.mirrored_in(bed, point), self.mirrored_in(wall, point)])
                .collect();
            let (mut left, mut next) = (TAU - 3.0 * angle, [wall, bed]);
            while left > ROUNDING {
                let share = (left / (2.0 * angle)).min(1.0);
                for (point, by) in near.iter_mut().flat_map(|pair| pair.iter_mut().zip(next)) {
                    *point = self.mirrored_in(by, *point);
                    // The wedge behind a corner belongs to the wall.
                    let body = wall as u8;
                    if in_reach(point.place) {
                        points.push(Point { volume: share * point.volume, body, ..*point });
                    }
                }
                left -= 2.0 * angle;
                next.reverse();
            }
        }
    }
}
