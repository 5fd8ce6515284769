//! Ghosts of a box that water fills, and of no walls at all.

use super::ghosts::{BodySites, Ghosts, Reflection, Site};
use super::layout::TankLayout;
use super::plane::Plane;

/// Ghosts of a box of this height: the bed (body 0), the left wall (1), the right wall (2) and the
/// lid (3). The walls have a face point for every row, and the corners' ghosts are theirs. All is
/// always wet.
pub fn box_ghosts(layout: &TankLayout, height: f64, strip_width: f64) -> Ghosts {
    let TankLayout { length, spacing_x, spacing_y, support_radius, .. } = *layout;
    let columns = (length / spacing_x).round() as i64;
    let rows = (height / spacing_y).round() as i64;
    let layers_x = (support_radius / spacing_x).ceil() as i64;
    let layers_y = (support_radius / spacing_y).ceil() as i64;
    let place =
        |column: i64, row: i64| [(column as f64 + 0.5) * spacing_x, (row as f64 + 0.5) * spacing_y];
    let mut bodies = [
        Plane { point: [0.0, 0.0], normal: [0.0, -1.0] },
        Plane { point: [0.0, 0.0], normal: [-1.0, 0.0] },
        Plane { point: [length, 0.0], normal: [1.0, 0.0] },
        Plane { point: [0.0, height], normal: [0.0, 1.0] },
    ]
    .map(|plane| BodySites { sites: Vec::new(), faces: Vec::new(), plane });
    for column in -layers_x..columns + layers_x {
        for row in -layers_y..rows + layers_y {
            let [between, level] = [(0..columns).contains(&column), (0..rows).contains(&row)];
            if between && level {
                continue;
            }
            let body = match between {
                true if row < 0 => 0,
                true => 3,
                false if column < 0 => 1,
                false => 2,
            };
            let ghost = place(column, row);
            let held = |cell: i64, cells: i64| match cell {
                cell if cell < 0 => -1 - cell,
                cell if cell >= cells => 2 * cells - 1 - cell,
                cell => cell,
            };
            let mirror = place(held(column, columns), held(row, rows));
            let apart = [ghost[0] - mirror[0], ghost[1] - mirror[1]];
            bodies[body].sites.push(Site {
                ghost,
                mirror,
                reflection: if between || level {
                    Reflection::Plane { normal: bodies[body].plane.normal }
                } else {
                    Reflection::Corner
                },
                distance: 0.5 * apart[0].hypot(apart[1]),
                face: Site::ALWAYS_WET,
                volume: spacing_x * spacing_y,
                twin: Site::ALONE,
            });
        }
    }
    for (body, x) in [(1, 0.0), (2, length)] {
        bodies[body].faces = (0..rows).map(|row| [x, place(0, row)[1]]).collect();
    }
    Ghosts::new(&bodies, strip_width)
}

/// The bodies of a tank without ghosts. Their faces lie out of reach.
pub fn no_ghosts(strip_width: f64) -> Ghosts {
    let bodies = [[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0]].map(|normal| BodySites {
        sites: Vec::new(),
        faces: Vec::new(),
        plane: Plane::nowhere(normal),
    });
    Ghosts::new(&bodies, strip_width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_ringed_and_mirrors_its_own_inside() {
        let layout = TankLayout {
            spacing_x: 0.1,
            spacing_y: 0.1,
            support_radius: 0.3,
            ..TankLayout::plain(1.0, 0.0, None)
        };
        let ghosts = box_ghosts(&layout, 0.8, 0.25);
        let area: f64 = ghosts.volume.iter().sum();
        assert!((area - (1.6 * 1.4 - 0.8)).abs() < 1e-9, "{area}");
        assert_eq!(ghosts.bodies.len(), 4);
        for g in (0..ghosts.len()).filter(|&g| ghosts.volume[g] > 0.0) {
            let (x, y) = (ghosts.target_x[g], ghosts.target_y[g]);
            assert!(x > 0.0 && x < 1.0 && y > 0.0 && y < 0.8);
            let apart = (ghosts.x[g] - x).hypot(ghosts.y[g] - y);
            assert!((0.5 * apart - ghosts.distance[g]).abs() < 1e-12);
        }
        assert!(no_ghosts(0.25).is_empty());
    }
}
