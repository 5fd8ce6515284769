//! Ghosts behind a wall with a crest, where water stays: the wall's back, a level floor, an end
//! wall.

use super::crested::{flat, past};
use super::ghosts::{BodySites, Reflection, Site};
use super::layout::{CrestShape, FloorBehind, TankLayout};
use super::plane::Plane;
use super::wall::wall;

/// A tank of its own behind the back of the wall, at `back`. The back's lattice ends at the
/// bisector of the corner at its top. Floor and corners bear even the thinnest sheet of water, so
/// they do not ask face points whether they are wet.
pub(super) fn behind(
    shape: CrestShape,
    back: f64,
    floor: FloorBehind,
    tank: &TankLayout,
) -> BodySites {
    let FloorBehind { height, length, spacing: [spacing_x, spacing_y] } = floor;
    let wall_height = tank.wall_height - height;
    let layout = TankLayout { spacing_x, spacing_y, wall_height, ..*tank };
    let level = Plane { point: [back, height], normal: [0.0, -1.0] };
    let mut sites = flat(&layout, [back, height], length, |_, _| 1.0);
    let mut faces = Vec::new();
    for (x, outwards) in [(back, -1.0), (back + length, 1.0)] {
        let face = Plane { point: [x, height], normal: [outwards, 0.0] };
        let upright = wall(&layout, face, level);
        let first = faces.len() as u32;
        for site in upright.sites {
            let in_wall = (site.ghost[0] - x) * outwards;
            let share = match outwards < 0.0 {
                true => past(shape.height - site.ghost[1] - in_wall, spacing_y),
                false => 1.0,
            };
            let face = match site.reflection {
                Reflection::Corner => Site::ALWAYS_WET,
                Reflection::Plane { .. } => site.face + first,
            };
            if share > 0.0 {
                sites.push(Site { face, volume: site.volume * share, ..site });
            }
        }
        faces.extend(upright.faces);
    }
    // The outline takes the place of its planes.
    BodySites { sites, faces, plane: Plane::nowhere([0.0, -1.0]) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Place;
    use crate::boundary::tank_ghosts;

    #[test]
    fn ghosts_fill_back_floor_and_end_wall() {
        let floor = FloorBehind { height: -0.1, length: 0.4, spacing: [0.02, 0.02] };
        let shape = CrestShape { height: 0.3, width: 0.2, floor: Some(floor) };
        let layout = TankLayout::plain(1.0, 0.8, Some(shape));
        let ghosts = tank_ghosts(&layout, None, 0.05);
        let area = |place: Place| -> f64 {
            ghosts.bodies[place.number()].ghosts.clone().map(|g| ghosts.volume[g]).sum()
        };
        // The back less half of the corner at its top, the floor with two blocks, the end wall.
        let exact = 0.1 * 0.4 - 0.5 * 0.01 + 0.1 * 0.6 + 0.1 * 0.9;
        let found = area(Place::Behind);
        assert!((found / exact - 1.0).abs() < 0.02, "{found} of {exact}");
        // The wall has its toe's block, its face and its top, less half of both corners.
        let exact = 0.1 * 0.1 + 0.1 * 0.3 + 0.1 * 0.2 - 3.0 * 0.5 * 0.01;
        let found = area(Place::Right);
        assert!((found / exact - 1.0).abs() < 0.02, "{found} of {exact}");
        let crest = ghosts.crest.as_ref().unwrap();
        for g in ghosts.bodies[Place::Behind.number()].ghosts.clone() {
            let (x, y) = (ghosts.x[g], ghosts.y[g]);
            let [to_x, to_y] = [ghosts.target_x[g], ghosts.target_y[g]];
            assert!(y < crest.outline.height(x), "{x} {y}");
            assert!(to_y > crest.outline.height(to_x) - 1e-9, "{to_x} {to_y}");
            // None of its ghosts is in reach of the water before the wall.
            assert!(ghosts.volume[g] == 0.0 || x > 1.1 - 1e-9, "{x}");
        }
        let faces = ghosts.bodies[Place::Behind.number()].faces.clone();
        assert!(faces.clone().all(|face| {
            let x = ghosts.target_x[face];
            (x - 1.2).abs() < 1e-12 || (x - 1.6).abs() < 1e-12
        }));
    }
}
