//! Readings of the water: levels, and the pressure along a face.

use super::Isph;
use super::images::Point;
use crate::water::first_level;

impl Isph {
    /// The first height above `from` at which coverage falls to 1/2 along a line.
    pub(super) fn level_along(&self, line: impl Fn(f64) -> [f64; 2], from: f64) -> f64 {
        first_level(|y| self.near.average(line(y), |_| 0.0)[0], from, self.options.spacing)
    }

    /// Points of a body's face at r*, as a function of height.
    pub(super) fn face_line(&self, body: usize) -> Option<impl Fn(f64) -> [f64; 2] + use<>> {
        let plane = self.ghosts.bodies.get(body)?.plane.moved(self.face_offsets[body]);
        let [nx, ny] = plane.normal;
        (nx != 0.0).then_some(move |y: f64| [plane.point[0] - (y - plane.point[1]) * ny / nx, y])
    }

    /// The dynamic pressure of the water or of an image, Pa: p = p0 + a p1. Here a is the
    /// acceleration of the responding wall as far as it is known.
    fn settled_at(&self, point: &Point) -> f64 {
        let (j, walls) = (point.original as usize, &point.walls);
        let response = self.carried.response.get(j).copied().unwrap_or(0.0);
        self.pressure[j] + walls.pressure + self.answer * (response + walls.pressure_response)
    }

    /// Finds the water's pressures with that acceleration. All readings and the next step use
    /// these.
    pub(super) fn settle_pressures(&mut self) {
        let mut dynamic = std::mem::take(&mut self.dynamic);
        dynamic.clear();
        dynamic.extend(self.points[..self.fluid.len()].iter().map(|point| self.settled_at(point)));
        let settled = dynamic.iter().zip(&self.near.places[1]);
        self.whole.clear();
        self.whole.extend(settled.map(|(p, y)| self.options.whole_pressure(*p, *y)));
        self.dynamic = dynamic;
    }

    /// ∫ p dy over a face, from the mean pressure of the water and its images there.
    pub(super) fn pressure_on(&self, body: usize) -> f64 {
        let Some(line) = self.face_line(body) else { return 0.0 };
        let step = 0.5 * self.options.spacing;
        let top = self.level_along(&line, 0.0);
        let cells = (top / step).ceil().max(1.0);
        let height = top / cells;
        let mut force = 0.0;
        for cell in 0..cells as usize {
            let [_, pressure] = self.pressure_at(line((cell as f64 + 0.5) * height));
            force += pressure * height;
        }
        force
    }

    /// Coverage and mean pressure, Pa, at a place on a body's face.
    fn pressure_at(&self, place: [f64; 2]) -> [f64; 2] {
        let [coverage, mean] = self.near.average(place, |k| self.settled_at(&self.points[k]));
        let dynamic = mean / coverage.max(1e-3);
        [coverage, self.options.whole_pressure(dynamic, place[1]).max(0.0)]
    }

    /// Pressures at the points of a body's face, Pa, up to the first point out of the water. They
    /// are means over a support radius. So every other point is just as well the mean of its
    /// neighbours.
    pub(super) fn pressures_along(&self, body: usize, pressures: &mut Vec<f64>) {
        let faces = self.ghosts.bodies[body].faces.clone();
        pressures.clear();
        pressures.resize(faces.len(), 0.0);
        let Some(line) = self.face_line(body) else { return };
        let read = |row: usize| {
            let place = line(self.ghosts.target_y[faces.start + row]);
            let [coverage, pressure] = self.pressure_at(place);
            (coverage >= 0.5).then_some(pressure)
        };
        for row in (0..pressures.len()).step_by(2) {
            let Some(pressure) = read(row) else {
                // The water's edge is between the last two points that were read.
                if let Some(below) = row.checked_sub(1) {
                    pressures[below] = read(below).unwrap_or(0.0);
                }
                break;
            };
            pressures[row] = pressure;
            if row > 0 {
                pressures[row - 1] = 0.5 * (pressures[row - 2] + pressure);
            }
        }
    }
}
