//! Ghosts of a tank: bed, left wall, right wall at any angle.

use super::bed::bed_sites;
use super::behind::behind;
use super::crest::Crest;
use super::crested::crested;
use super::ghosts::{BodySites, Ghosts, Reflection, Site};
use super::layout::{TankLayout, at};
use super::plane::Plane;
use super::profile::Profile;
use super::wall::{held_in, wall};

/// Ghosts of the bed (body 0), the left wall (1), the right wall (2), and of what keeps water
/// behind a crest (3). The walls have a face point for every row, upwards from the bed.
///
/// Every wall fills the normals of its face. The wedge between two walls' normals belongs to the
/// upright one and moves with it. At a right angle it continues both lattices; at other angles it
/// is filled ring by ring. At rest the right wall's toe is at x = `length` in its frame, and the
/// left one's at x = 0. With a `profile` that is the bed, and the right wall stands on its end.
pub fn tank_ghosts(layout: &TankLayout, profile: Option<&Profile>, strip_width: f64) -> Ghosts {
    let left = Plane { point: [0.0, 0.0], normal: [-1.0, 0.0] };
    let floor = Plane { point: [0.0, 0.0], normal: [0.0, -1.0] };
    let upright = right_normal(layout.wall_angle_deg);
    let Some(profile) = profile else {
        let right = Plane { point: [layout.length, 0.0], normal: upright };
        let mut bodies = vec![
            level_bed(layout, right, floor),
            wall(layout, left, floor),
            right_wall(layout, right, floor),
        ];
        bodies.extend(back_to_end(layout, right));
        let crest = layout.crest.map(|shape| Crest::of(shape, layout, right, None));
        return Ghosts { crest, ..Ghosts::new(&bodies, strip_width) };
    };
    let right = Plane { point: profile.end(), normal: upright };
    let last = profile.stretches().last().map_or(floor, |stretch| stretch.plane());
    // In whole columns, so that the columns stay where those of the water are.
    let before = (layout.bed_before_paddle / layout.spacing_x).round() * layout.spacing_x;
    let bed = profile.gone_on([before, layout.bed_beyond_wall]);
    let mut bodies =
        vec![bed_sites(layout, &bed), wall(layout, left, floor), right_wall(layout, right, last)];
    bodies.extend(back_to_end(layout, right));
    let crest = layout.crest.map(|shape| Crest::of(shape, layout, right, Some(profile)));
    let lagoon = profile.has_lagoon(layout.still_level);
    let shore = profile.shore(layout.still_level, layout.support_radius);
    let profile = Some(profile.clone());
    Ghosts { profile, lagoon, shore, crest, ..Ghosts::new(&bodies, strip_width) }
}

/// The wall at the end of the tank, up to its crest if it has one.
fn right_wall(layout: &TankLayout, face: Plane, floor: Plane) -> BodySites {
    let endless = wall(layout, face, floor);
    match layout.crest {
        Some(shape) => crested(shape, layout, endless),
        None => endless,
    }
}

/// Ghosts that keep the water behind the crest of a wall with this face, if any do.
fn back_to_end(layout: &TankLayout, face: Plane) -> Option<BodySites> {
    let shape = layout.crest?;
    let floor = shape.floor?;
    Some(behind(shape, face.point[0] + shape.width, floor, layout))
}

/// A level bed between the walls, and beyond as far as they may move.
fn level_bed(layout: &TankLayout, right: Plane, floor: Plane) -> BodySites {
    let TankLayout { length, spacing_x, spacing_y, .. } = *layout;
    let layers_y = (layout.support_radius / spacing_y).ceil() as i64;
    let columns = ((length + layout.bed_beyond_wall) / spacing_x).round() as i64;
    let leaning = right.normal[1] != 0.0;
    let mut bed = Vec::new();
    // Face points are numbered from the first column. Where a bed may run dry, no paddle moves
    // back, so no column lies before it.
    let before = (layout.bed_before_paddle / spacing_x).round() as i64;
    for column in -before..columns {
        for layer in 0..layers_y {
            let (x, depth) = (at(column, spacing_x), at(layer, spacing_y));
            let mirror = [x, depth];
            bed.push(Site {
                ghost: [x, -depth],
                mirror: if leaning { held_in(mirror, &[right, floor]) } else { mirror },
                reflection: Reflection::Plane { normal: floor.normal },
                distance: depth,
                face: if layout.dry_bed { column as u32 } else { Site::ALWAYS_WET },
                volume: spacing_x * spacing_y,
                twin: Site::ALONE,
            });
        }
    }
    // The bed of a wave tank never runs dry: it needs no face points.
    let bed_faces = if layout.dry_bed {
        (0..columns).map(|column| [at(column, spacing_x), 0.0]).collect()
    } else {
        Vec::new()
    };
    BodySites { sites: bed, faces: bed_faces, plane: floor }
}

fn right_normal(angle_deg: f64) -> [f64; 2] {
    if angle_deg == 90.0 {
        return [1.0, 0.0];
    }
    let angle = angle_deg.to_radians();
    [libm::sin(angle), libm::cos(angle)]
}
