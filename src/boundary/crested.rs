//! Ghosts of a wall that ends in a crest.

use super::crest::BACK;
use super::ghosts::{BodySites, Reflection, Site};
use super::layout::{CrestShape, TankLayout, at};

/// An endless wall, cut off at its crest. Its lattice ends at the bisector of the corner, and those
/// of top and back begin there. Points of the face go on above the crest, to measure the height of
/// the water over the edge. A back down to a floor is a body of its own.
pub(super) fn crested(shape: CrestShape, layout: &TankLayout, wall: BodySites) -> BodySites {
    let TankLayout { spacing_x, spacing_y, support_radius, .. } = *layout;
    let CrestShape { height, width, floor } = shape;
    let BodySites { sites, mut faces, plane } = wall;
    let front = plane.point[0];
    let back = front + width;
    let mut kept: Vec<Site> = Vec::new();
    for site in sites {
        let [x, y] = site.ghost;
        let share = past(height - y - (x - front).max(0.0), spacing_y);
        if share > 0.0 {
            kept.push(Site { volume: site.volume * share, ..site });
        }
    }
    kept.extend(flat(layout, [front, height], width, past));
    if floor.is_some() {
        return BodySites { sites: kept, faces, plane };
    }
    // As many layers as a thin wall has room for, so that water before it does not feel its back.
    let behind = ((width - support_radius) / spacing_x).floor().max(0.0) as i64;
    let behind = behind.min((support_radius / spacing_x).ceil() as i64);
    for row in 0..(BACK * support_radius / spacing_y).round() as i64 {
        let down = at(row, spacing_y);
        let face = faces.len() as u32;
        faces.push([back, height - down]);
        for layer in 0..behind {
            let depth = at(layer, spacing_x);
            let share = past(down - depth, spacing_y);
            if share > 0.0 {
                kept.push(Site {
                    ghost: [back - depth, height - down],
                    mirror: [back + depth, height - down],
                    reflection: Reflection::Plane { normal: [-1.0, 0.0] },
                    distance: depth,
                    face,
                    volume: spacing_x * spacing_y * share,
                    twin: Site::ALONE,
                });
            }
        }
    }
    BodySites { sites: kept, faces, plane }
}

/// The share of a ghost's cell that lies past the bisector of a corner. `cell` is the cell's size,
/// metres.
pub(super) fn past(across: f64, cell: f64) -> f64 {
    (0.5 + across * 0.5_f64.sqrt() / cell).clamp(0.0, 1.0)
}

/// Ghosts under a level stretch that begins at a place, metres. `share` gives the share of a ghost
/// that counts. Its arguments are the distance inside the bisectors of the corners at both ends,
/// and the breadth of the cell.
pub(super) fn flat(
    layout: &TankLayout,
    [from, height]: [f64; 2],
    length: f64,
    share: impl Fn(f64, f64) -> f64,
) -> Vec<Site> {
    let TankLayout { spacing_x, spacing_y, support_radius, .. } = *layout;
    let layers = (support_radius / spacing_y).ceil() as i64;
    let columns = (length / spacing_x).round().max(1.0);
    let breadth = length / columns;
    let mut sites = Vec::new();
    for column in 0..columns as i64 {
        for layer in 0..layers {
            let (along, depth) = (at(column, breadth), at(layer, spacing_y));
            let share = share(along.min(length - along) - depth, breadth);
            if share > 0.0 {
                sites.push(Site {
                    ghost: [from + along, height - depth],
                    mirror: [from + along, height + depth],
                    reflection: Reflection::Plane { normal: [0.0, -1.0] },
                    distance: depth,
                    face: Site::ALWAYS_WET,
                    volume: breadth * spacing_y * share,
                    twin: Site::ALONE,
                });
            }
        }
    }
    sites
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Place;
    use crate::boundary::crest::Crest;
    use crate::boundary::plane::Plane;
    use crate::boundary::tank_ghosts;

    fn layout(crest: Option<CrestShape>) -> TankLayout {
        TankLayout::plain(1.0, 0.8, crest)
    }

    #[test]
    fn ghosts_fill_the_wall_behind_face_top_and_back() {
        let shape = CrestShape { height: 0.5, width: 0.3, floor: None };
        let ghosts = tank_ghosts(&layout(Some(shape)), None, 0.05);
        let wall = &ghosts.bodies[Place::Right.number()];
        let area: f64 = wall.ghosts.clone().map(|g| ghosts.volume[g]).sum();
        // A strip of one support radius: the toe's block, the face, the top, the back. Corners
        // count once.
        let exact = 0.1 * 0.1 + 0.1 * 0.5 + 0.1 * 0.3 + 0.1 * 0.3 - 2.0 * 0.01;
        assert!((area / exact - 1.0).abs() < 0.02, "{area} of {exact}");
        let crest = ghosts.crest.as_ref().unwrap();
        for g in wall.ghosts.clone().filter(|&g| ghosts.volume[g] > 0.0) {
            let (x, y) = (ghosts.x[g], ghosts.y[g]);
            assert!(y < 0.5 && y < crest.outline.height(x) + 1e-12 || y < 0.0, "{x} {y}");
            let mirror = [ghosts.target_x[g], ghosts.target_y[g]];
            assert!(mirror[1] > crest.outline.height(mirror[0]) - 1e-9, "{mirror:?}");
        }
    }

    /// Below the reach of the corner, all is as behind an endless wall.
    #[test]
    fn far_below_its_crest_a_wall_is_endless() {
        let shape = CrestShape { height: 0.51, width: 0.2, floor: None };
        let low = |crest| {
            let ghosts = tank_ghosts(&layout(crest), None, 0.05);
            let wall = ghosts.bodies[Place::Right.number()].ghosts.clone();
            let below = wall.filter(|&g| ghosts.volume[g] > 0.0 && ghosts.y[g] < 0.39);
            let mut all: Vec<_> = below
                .filter(|&g| ghosts.x[g] < 1.1 && ghosts.target_x[g] < 1.0)
                .map(|g| [ghosts.x[g], ghosts.y[g], ghosts.volume[g], ghosts.target_x[g]])
                .collect();
            all.sort_by(|a, b| a.partial_cmp(b).unwrap());
            all
        };
        assert_eq!(low(Some(shape)), low(None));
    }

    #[test]
    fn water_is_gone_behind_the_back_and_below_it() {
        let shape = CrestShape { height: 0.5, width: 0.3, floor: None };
        let face = Plane { point: [1.0, 0.0], normal: [1.0, 0.0] };
        let crest = Crest::of(shape, &layout(Some(shape)), face, None);
        let gone = [[1.2, 0.51], [1.35, 0.55], [1.35, 0.45], [1.41, 0.9], [1.31, 0.39], [0.9, 0.1]];
        assert_eq!(
            gone.map(|place| crest.is_gone(place)),
            [false, false, false, true, true, false]
        );
        let row = |y: f64| crest.below([1.0, y], 0.02);
        assert!((row(0.495) - 0.015).abs() < 1e-12 && row(0.53) == 0.0 && row(0.1) == 0.02);
        assert_eq!(crest.below([1.3, 0.45], 0.02), 0.0);
    }
}
