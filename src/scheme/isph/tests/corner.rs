//! Images behind corners of every angle.

use super::*;
use crate::boundary::tank_ghosts;

/// Water of depth 1 and length 2 before a wall with its toe at x = 2. Each row of the lattice ends
/// at the wall.
fn before_a_wall(angle_deg: f64, jitter: f64) -> Isph {
    let spacing = 0.05;
    let lean = angle_deg.to_radians();
    let layout = TankLayout { length: 2.0, wall_angle_deg: angle_deg, ..layout(spacing) };
    let mut random = noise();
    let mut points = Vec::new();
    for row in 0..20 {
        let y = (f64::from(row) + 0.5) * spacing;
        let length = 2.0 - y * lean.cos() / lean.sin();
        let count = (length / spacing).round();
        for column in 0..count as u32 {
            let x = (f64::from(column) + 0.5) * length / count;
            let [dx, dy] = [random(), random()].map(|random| jitter * spacing * random);
            points.push([x + dx, y + dy, DENSITY, DENSITY * spacing * length / count]);
        }
    }
    let ghosts = tank_ghosts(&layout, None, spacing);
    let options = options(spacing, Laplacian::Exact);
    let fluid = Fluid::at_rest(points);
    let mut water = Isph::new(options, ghosts, fluid, usize::MAX, SimdPath::widest());
    lists(&mut water);
    water
}

/// Images of images once left a part of every corner empty but of a right one: 84 of 360 degrees at
/// 92.
#[test]
fn corners_are_full_at_every_angle() {
    for angle in [60.0, 66.0, 72.0, 81.0, 89.99, 90.0, 90.01, 92.0, 100.0, 110.0, 120.0] {
        let water = before_a_wall(angle, 0.0);
        let [coverage, _] = water.near.average([2.0, 0.0], |_| 0.0);
        assert!((coverage - 1.0).abs() < 0.06, "{coverage} at {angle} degrees");
        // A full support has the moment of the plane.
        for i in 0..water.fluid.len() {
            if (water.fluid.x[i] - 2.0).hypot(water.fluid.y[i]) < 0.15 {
                let completeness = water.operators.completeness[i];
                assert!(completeness > 0.85, "{completeness} at {angle} degrees");
            }
        }
    }
}

#[test]
fn the_exact_laplacian_is_symmetric_behind_corners_too() {
    for angle in [45.0, 60.0, 75.0, 90.0, 100.0, 115.0] {
        let mut water = before_a_wall(angle, 0.1);
        let a = field(&water, |x, y| (7.0 * x).sin() + (31.0 * x * y).cos());
        let b = field(&water, |x, y| (5.0 * y).cos() - (23.0 * x).sin() * y);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (image_a, image_b) = (exact_product(&mut water, &a), exact_product(&mut water, &b));
        let (one, other) = (dot(&a, &image_b), dot(&b, &image_a));
        let off = (one - other).abs() / dot(&a, &image_a);
        assert!(off < 1e-11, "{one} {other} at {angle} degrees");
    }
}
