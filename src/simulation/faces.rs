//! The faces of walls, bed and lid, and the water's pressure on them.

use super::run::Run;
use super::sounding::Sounding;
use crate::body::{Motions, Place};
use crate::boundary::{Crest, Profile};

/// The face of a body at an instant: a line of points at a distance of at most a particle spacing.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Whose face it is.
    pub place: Place,
    /// Velocity of the body along x, m/s.
    pub velocity: f64,
    /// x and y, metres. Along bed and lid they go from the left; along walls they go up and over
    /// the crest.
    pub points: Vec<[f64; 2]>,
    /// The water's pressure at the points, Pa, as a pressure probe there would read it; 0 where it
    /// is dry.
    pub pressure: Vec<f64>,
}

impl Run {
    /// The faces of all bodies; none if there are no walls.
    pub(super) fn faces(&mut self, bodies: &Motions) -> Vec<Face> {
        let Run { tank, near, .. } = self;
        let ghosts = tank.water.walls();
        if ghosts.is_empty() {
            return Vec::new();
        }
        let crest = ghosts.crest.as_ref();
        // The last face points of a wall with a crest belong to its back.
        let tall = if crest.is_some() { Place::Left } else { Place::Right };
        let top = ghosts.bodies[tall.number()].faces.clone().next_back();
        let top = top.map_or(tank.frame.depth, |face| ghosts.target_y[face] + 0.5 * tank.spacing);
        let scales = (tank.frame.gravity, tank.spacing, tank.frame.density);
        let mut water = Sounding::new(tank.water.as_ref(), bodies, scales, near);
        let last = if ghosts.keeps_behind() { Place::Behind } else { Place::Lid };
        let places = [Place::Bed, Place::Left, Place::Right, last];
        let present = places.into_iter().take(bodies.len());
        let mut face = |place: Place| {
            if let Some(line) = crest.and_then(Crest::line_behind).filter(|_| place == last) {
                let points = along(line, tank.spacing);
                let pressure = water.pressures(&points, [0.0, 1.0]);
                return Face { place, velocity: 0.0, points, pressure };
            }
            let crest = crest.filter(|_| place == Place::Right);
            let ends = ends(&water, place, crest.map_or(top, |crest| crest.height));
            let mut points = match &ghosts.profile {
                Some(bed) if place == Place::Bed => along_bed(bed, ends, tank.spacing),
                _ => between(ends, tank.spacing),
            };
            let [[x0, y0], [x1, y1]] = ends;
            let long = (x1 - x0).hypot(y1 - y0);
            let upright = [0.0, 1.0];
            let flat = matches!(place, Place::Bed | Place::Lid);
            let up = if flat { upright } else { [(x1 - x0) / long, (y1 - y0) / long] };
            let mut pressure = water.pressures(&points, up);
            if let Some(crest) = crest {
                // Its top continues its face.
                let over = between(crest.ends.map(|x| [x, crest.height]), tank.spacing);
                pressure.extend_from_slice(&water.pressures(&over[1..], upright));
                points.extend_from_slice(&over[1..]);
            }
            Face { place, velocity: bodies[place].velocity, points, pressure }
        };
        present.map(&mut face).collect()
    }
}

/// Where a face starts and ends, metres; walls rise to this height.
fn ends(water: &Sounding<'_>, place: Place, top: f64) -> [[f64; 2]; 2] {
    let face = water.face(place);
    let [left, right] = [Place::Left, Place::Right].map(|wall| water.face(wall).point[0]);
    let ([x, y], [nx, ny]) = (face.point, face.normal);
    match place {
        Place::Bed | Place::Lid | Place::Behind => [[left, y], [right, y]],
        Place::Left | Place::Right => [[x, y], [x - (top - y) * ny / nx, top]],
    }
}

/// Points on a bed that is not level, at most a spacing apart.
fn along_bed(bed: &Profile, [[left, _], [right, _]]: [[f64; 2]; 2], spacing: f64) -> Vec<[f64; 2]> {
    let inside = bed.points().iter().copied().filter(|[x, _]| *x > left && *x < right);
    let first = [[left, bed.height(left)]];
    let last = [[right, bed.end()[1]]];
    along(&first.into_iter().chain(inside).chain(last).collect::<Vec<_>>(), spacing)
}

/// Points on a line with corners, at most a spacing apart.
fn along(corners: &[[f64; 2]], spacing: f64) -> Vec<[f64; 2]> {
    let mut points = vec![corners[0]];
    for pair in corners.windows(2) {
        points.extend_from_slice(&between([pair[0], pair[1]], spacing)[1..]);
    }
    points
}

/// Points on a straight line, at most a spacing apart.
fn between([from, to]: [[f64; 2]; 2], spacing: f64) -> Vec<[f64; 2]> {
    let way = [to[0] - from[0], to[1] - from[1]];
    let pieces = (way[0].hypot(way[1]) / spacing).ceil().max(1.0) as u32;
    let at = |k: u32| {
        let share = f64::from(k) / f64::from(pieces);
        [from[0] + share * way[0], from[1] + share * way[1]]
    };
    (0..=pieces).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::SimdPath;
    use crate::math::team::Team;
    use crate::scene::CaseConfig;

    fn faces(scene: &str, numerics: &str) -> Vec<Face> {
        let config = CaseConfig::of(scene, numerics);
        let mut run = Run::start(&config, SimdPath::Portable, &Team::of(1));
        let bodies = run.tank.motions(0.0);
        run.tank.water.prepare(&bodies, 1e-4).unwrap();
        run.faces(&bodies)
    }

    #[test]
    fn still_water_presses_with_its_weight_on_every_face() {
        for (scheme, angle) in [("wcsph", 90), ("wcsph", 120), ("isph", 90)] {
            let scene = format!("kind = \"hydrostatic\"\nwall_angle_deg = {angle}");
            let numerics = format!("particle_spacing_m = 0.015\nscheme = \"{scheme}\"");
            let faces = faces(&scene, &numerics);
            assert_eq!(faces.iter().map(|face| face.place as usize).collect::<Vec<_>>(), [0, 1, 2]);
            for face in faces {
                assert_eq!((face.points.len(), face.velocity), (face.pressure.len(), 0.0));
                for (&[x, y], pressure) in face.points.iter().zip(&face.pressure) {
                    let still = 9810.0 * (0.3 - y).max(0.0);
                    let gap = (pressure - still).abs();
                    assert!(gap < 0.02 * 9810.0 * 0.3, "{scheme} {angle} {x} {y} {pressure}");
                }
            }
        }
    }

    #[test]
    fn a_leaning_wall_has_a_leaning_face() {
        let scene = "kind = \"hydrostatic\"\nwall_angle_deg = 120";
        let wall = faces(scene, "particle_spacing_m = 0.03").pop().unwrap();
        let [x, y] = wall.points[wall.points.len() - 1];
        assert!(((x - 1.0) / y - (30.0_f64).to_radians().tan()).abs() < 1e-9, "{x} {y}");
        let scene = "kind = \"rotating-patch\"";
        assert_eq!(faces(scene, "particle_spacing_m = 0.05"), []);
    }
}
