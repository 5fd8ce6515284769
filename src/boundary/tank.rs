//! Ghosts of a rectangular wave tank: bed, paddle, seawall.

use super::ghosts::{Ghosts, Reflection, Site};

/// The tank at rest, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TankLayout {
    /// From the paddle's face to the wall's face.
    pub length: f64,
    /// Particle spacing along the bed.
    pub spacing_x: f64,
    /// Particle spacing upwards.
    pub spacing_y: f64,
    /// Support radius of the kernel: how thick a wall must be.
    pub support_radius: f64,
    /// How far the walls rise above the bed.
    pub wall_height: f64,
    /// How far the bed goes on behind the wall, for the wall to move over.
    pub bed_beyond_wall: f64,
}

/// Ghosts of the bed (body 0), the paddle (1) and the seawall (2), the latter two with
/// a face point for every row, upwards from the bed.
/// The corner blocks below the walls move with the walls. The seawall's frame has its face at
/// x = `length` and the paddle's at x = 0 when they are at rest.
pub fn tank_ghosts(layout: &TankLayout, strip_width: f64) -> Ghosts {
    let TankLayout { length, spacing_x, spacing_y, .. } = *layout;
    let layers_x = (layout.support_radius / spacing_x).ceil() as i64;
    let layers_y = (layout.support_radius / spacing_y).ceil() as i64;
    let columns = ((length + layout.bed_beyond_wall) / spacing_x).round() as i64;
    let rows = (layout.wall_height / spacing_y).round() as i64;
    let at_x = |column: i64| (column as f64 + 0.5) * spacing_x;
    let at_y = |row: i64| (row as f64 + 0.5) * spacing_y;

    let mut bed = Vec::new();
    for column in 0..columns {
        for layer in 0..layers_y {
            let (x, depth) = (at_x(column), at_y(layer));
            bed.push(Site {
                ghost: [x, -depth],
                mirror: [x, depth],
                reflection: Reflection::Plane { normal: [0.0, -1.0] },
                distance: depth,
                face: Site::ALWAYS_WET,
            });
        }
    }
    // The bed of a tank never runs dry: it needs no face points.
    let bed_faces = Vec::new();

    let upright = |face_x: f64, outwards: f64| {
        let mut sites = Vec::new();
        for layer in 0..layers_x {
            let distance = at_x(layer);
            let x = face_x + outwards * distance;
            let mirror_x = face_x - outwards * distance;
            for row in 0..rows {
                sites.push(Site {
                    ghost: [x, at_y(row)],
                    mirror: [mirror_x, at_y(row)],
                    reflection: Reflection::Plane { normal: [outwards, 0.0] },
                    distance,
                    face: row as u32,
                });
            }
            for layer in 0..layers_y {
                let depth = at_y(layer);
                sites.push(Site {
                    ghost: [x, -depth],
                    mirror: [mirror_x, depth],
                    reflection: Reflection::Corner,
                    distance: distance.hypot(depth),
                    face: 0,
                });
            }
        }
        let faces: Vec<[f64; 2]> = (0..rows).map(|row| [face_x, at_y(row)]).collect();
        (sites, faces)
    };
    let bodies = [(bed, bed_faces), upright(0.0, -1.0), upright(length, 1.0)];
    Ghosts::new(&bodies, spacing_x * spacing_y, strip_width)
}
