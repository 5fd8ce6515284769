use super::*;
use crate::math::simd::SimdPath;
use crate::scene::CaseConfig;

/// Still water before leaning walls, 15 rows deep. A gauge over the face of a wall that leans away
/// reads the surface up to the edge of the water, and the face beyond it. A gauge under an overhang
/// reads the face.
#[test]
fn gauges_at_leaning_walls_read_the_surface_or_the_face() {
    let level = |angle: f64, x: f64| {
        let scene = format!("kind = \"hydrostatic\"\nwall_angle_deg = {angle}\ntank_length_m = 2");
        let config = CaseConfig::of(&scene, "particle_spacing_m = 0.02");
        let mut tank = config.scene.build(&config.numerics, SimdPath::Portable);
        let bodies = tank.motions(0.0);
        tank.water.prepare(&bodies, 1e-4).unwrap();
        let mut near = Near::default();
        Sounding::new(tank.water.as_ref(), &bodies, (9.81, 0.02, 1000.0), &mut near).level(x, 1.2)
    };
    let depth = level(90.0, 0.5);
    for x in [1.9, 2.0, 2.1, 1.92 + depth] {
        let found = level(135.0, x);
        assert!((found - depth).abs() < 0.004, "{found} at {x}, {depth} inside");
    }
    for (angle, x, face) in [(135.0, 2.1 + depth, depth + 0.1), (45.0, 1.9, 0.1)] {
        let found = level(angle, x);
        assert!((found - face).abs() < 1e-9, "{found} at {x}, the face is at {face}");
    }
}

#[test]
fn a_void_is_the_share_that_water_leaves_empty() {
    let config = CaseConfig::of("kind = \"hydrostatic\"", "particle_spacing_m = 0.02");
    let mut tank = config.scene.build(&config.numerics, SimdPath::Portable);
    let mut bodies = tank.motions(0.0);
    tank.water.prepare(&bodies, 1e-4).unwrap();
    let (kernel, radius) = tank.water.kernel();
    for apart in [0.0, 0.2, 0.4] {
        bodies[Place::Right].offset = apart * tank.spacing;
        let mut near = Near::default();
        let mut water =
            Sounding::new(tank.water.as_ref(), &bodies, (9.81, 0.02, 1000.0), &mut near);
        let void = water.void((water.face(Place::Right).point, [0.0, 1.0]), 0.6);
        // In the toe's corner, where the empty strip continues through the bed.
        let filled = kernel.half_plane_fraction(-apart * tank.spacing / radius);
        let exact = 1.0 - filled / (1.0 - filled);
        assert!((void - exact).abs() < 0.02, "{void}, and {exact} by the kernel alone");
    }
}

/// The last stretch of a bed need not be a whole number of columns long.
#[test]
fn still_water_leaves_no_void_at_the_foot_of_a_wall_on_a_bed() {
    for shelf in [0.6, 0.607, 0.61, 0.613] {
        let scene = format!(
            "bed = [[0, 0], [0.4, 0], [{}, 0.1], [1.6, 0.1]]\n\
             wave_height_ratio = 0\nend_time_s = 1\ntank_length_m = 1.6\nwave_gauge_m = 0.3\n\
             still_water_depth_m = 0.3",
            1.6 - shelf
        );
        let numerics = "particle_spacing_m = 0.02\nboundary = \"normalized\"";
        let config = CaseConfig::of(&scene, numerics);
        let mut tank = config.scene.build(&config.numerics, SimdPath::Portable);
        let bodies = tank.motions(0.0);
        tank.water.prepare(&bodies, 1e-4).unwrap();
        let mut near = Near::default();
        let mut water =
            Sounding::new(tank.water.as_ref(), &bodies, (9.81, 0.02, 1000.0), &mut near);
        let void = water.void((water.face(Place::Right).point, [0.0, 1.0]), 0.3);
        assert!(void < 0.03, "a shelf of {shelf} m: {void}");
    }
}
