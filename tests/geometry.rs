//! Walls at any angle: mirrors, ghosts around corners, water up to the wall, water at rest there.

use seawall::body::Place;
use seawall::boundary::{Ghosts, Reflection, TankLayout, tank_ghosts};
use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::scheme::Scheme;
use seawall::simulation::{Unwatched, run_case};

const SPACING: f64 = 0.02;
const RADIUS: f64 = 0.08;
const LENGTH: f64 = 1.6;
const DEPTH: f64 = 0.24;

fn ghosts(angle_deg: f64) -> Ghosts {
    let layout = TankLayout {
        length: LENGTH,
        spacing_x: SPACING,
        spacing_y: SPACING,
        support_radius: RADIUS,
        wall_height: 3.0 * DEPTH,
        bed_beyond_wall: if angle_deg == 90.0 { 4.0 * RADIUS } else { 0.0 },
        bed_before_paddle: 0.0,
        wall_angle_deg: angle_deg,
        still_level: DEPTH,
        dry_bed: false,
        crest: None,
    };
    tank_ghosts(&layout, None, 0.06)
}

fn case(angle_deg: f64, more: &str) -> CaseConfig {
    let text = format!(
        "kind = \"hydrostatic\"\nstill_water_depth_m = {DEPTH}\ntank_length_m = {LENGTH}\n\
         wall_angle_deg = {angle_deg}\n{more}"
    );
    let numerics = format!("particle_spacing_m = {SPACING}\nsound_speed_ratio = 15");
    CaseConfig::from_tables(&text.parse().unwrap(), &numerics.parse().unwrap()).unwrap()
}

fn water(angle_deg: f64) -> Box<dyn Scheme> {
    let config = case(angle_deg, "");
    config.scene.build(&config.numerics, SimdPath::Portable).water
}

#[test]
fn the_mirror_of_a_mirror_is_the_ghost() {
    for angle in [90.0, 120.0, 150.0] {
        let ghosts = ghosts(angle);
        for body in &ghosts.bodies {
            for g in body.ghosts.clone() {
                let ghost = [ghosts.x[g], ghosts.y[g]];
                let mirror = [ghosts.target_x[g], ghosts.target_y[g]];
                let [toe_x, toe_y] = body.plane.point;
                let twice = match ghosts.reflection[g] {
                    Reflection::Corner => [2.0 * toe_x - mirror[0], 2.0 * toe_y - mirror[1]],
                    Reflection::Plane { normal: [nx, ny] } => {
                        assert!((nx.hypot(ny) - 1.0).abs() < 1e-15);
                        let beyond = 2.0 * body.plane.beyond(mirror);
                        [mirror[0] - beyond * nx, mirror[1] - beyond * ny]
                    }
                };
                let apart = (twice[0] - ghost[0]).hypot(twice[1] - ghost[1]);
                assert!(apart < 1e-12, "{ghost:?} of {mirror:?} at {angle}");
            }
        }
    }
}

#[test]
fn every_ghost_is_solid_and_mirrors_water() {
    for angle in [30.0, 60.0, 90.0, 120.0, 150.0] {
        let ghosts = ghosts(angle);
        let planes = [0, 1, 2].map(|body| ghosts.bodies[body].plane);
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for g in body.ghosts.clone().filter(|&g| ghosts.volume[g] > 0.0) {
                let solid =
                    planes.iter().any(|plane| plane.beyond([ghosts.x[g], ghosts.y[g]]) > 0.0);
                assert!(solid, "ghost {g} of {number} at {angle}");
                let mirror = [ghosts.target_x[g], ghosts.target_y[g]];
                // The bed of a wall that may move goes on behind it.
                if number == 0 && ghosts.x[g] > LENGTH {
                    continue;
                }
                let wet = planes.iter().all(|plane| plane.beyond(mirror) < 1e-12);
                assert!(wet, "mirror {mirror:?} of ghost {g} of {number} at {angle}");
            }
        }
    }
}

/// Water and ghosts together fill the support of every particle that is deep enough.
#[test]
fn the_support_is_full_around_corners_of_any_angle() {
    for angle in [60.0, 75.0, 90.0, 120.0, 150.0] {
        let water = water(angle);
        let (kernel, radius) = water.kernel();
        let (fluid, ghosts) = (water.fluid(), water.walls());
        let ends = [ghosts.bodies[1].plane.point[0], ghosts.bodies[2].plane.point[0]];
        let factor = kernel.normalisation() / (radius * radius);
        let mut seen = 0;
        for k in (0..fluid.len()).filter(|&k| fluid.y[k] < DEPTH - radius) {
            let near_wall =
                ghosts.bodies[Place::Right.number()].plane.beyond([fluid.x[k], fluid.y[k]])
                    > -radius;
            if !near_wall {
                continue;
            }
            let weight = |x: f64, y: f64| {
                let q = (x - fluid.x[k]).hypot(y - fluid.y[k]) / radius;
                if q < 1.0 { factor * kernel.shape_at(q) } else { 0.0 }
            };
            let of_water: f64 = (0..fluid.len())
                .map(|j| weight(fluid.x[j], fluid.y[j]) * fluid.mass[j] / fluid.density[j])
                .sum();
            let of_walls: f64 = ghosts
                .bodies
                .iter()
                .enumerate()
                .flat_map(|(number, body)| body.ghosts.clone().map(move |g| (number, g)))
                .filter(|&(number, g)| {
                    number > 0 || (ghosts.x[g] > ends[0] && ghosts.x[g] < ends[1])
                })
                .map(|(_, g)| weight(ghosts.x[g], ghosts.y[g]) * ghosts.volume[g])
                .sum();
            let full = of_water + of_walls;
            let place = [fluid.x[k], fluid.y[k]];
            assert!((full - 1.0).abs() < 0.05, "{full} at {place:?} before {angle} degrees");
            seen += 1;
        }
        assert!(seen > 15, "{seen} at {angle}");
    }
}

#[test]
fn water_fills_the_tank_up_to_the_wall() {
    for angle in [45.0_f64, 60.0, 90.0, 120.0, 150.0] {
        let water = water(angle);
        let (fluid, wall) = (water.fluid(), water.walls().bodies[Place::Right.number()].plane);
        let overhang = if angle == 90.0 { 0.0 } else { -1.0 / angle.to_radians().tan() };
        let area = DEPTH * (LENGTH + 0.5 * overhang * DEPTH);
        let mass: f64 = fluid.mass.iter().sum();
        assert!((mass / (1000.0 * area) - 1.0).abs() < 2e-3, "{mass} at {angle}");
        // No particle in the wall or too close to it, no place on its face without one.
        let (low, high) = if angle == 90.0 { (0.499, 0.72) } else { (0.3, 0.9) };
        let apart =
            |x: f64, y: f64| (0..fluid.len()).map(move |k| (fluid.x[k] - x, fluid.y[k] - y));
        let nearest = (0..fluid.len()).map(|k| -wall.beyond([fluid.x[k], fluid.y[k]]));
        let nearest = nearest.fold(f64::INFINITY, f64::min) / SPACING;
        assert!(nearest > low, "{nearest} at {angle}");
        for step in 0..(2.0 * (DEPTH / SPACING - 1.0)) as usize {
            let y = 0.5 * SPACING * (step as f64 + 1.0);
            let x = LENGTH + overhang * y;
            let gap = apart(x, y).map(|(dx, dy)| dx.hypot(dy)).fold(f64::INFINITY, f64::min);
            assert!(gap / SPACING < high, "{gap} at {y} up a wall of {angle}");
        }
    }
}

/// The story: rows and the ghosts of a leaning wall are lattices of different directions. Where
/// they meet, most of all in the toe, they overfilled space by 1 %; the water crept away from there
/// for seconds, and the pressure was 2 % low meanwhile.
#[test]
fn water_and_ghosts_press_evenly_on_each_other() {
    for angle in [40.0, 60.0, 75.0, 120.0, 135.0, 150.0] {
        let water = water(angle);
        let (kernel, radius) = water.kernel();
        let (fluid, ghosts) = (water.fluid(), water.walls());
        let factor = kernel.normalisation() / (radius * radius * radius);
        for k in (0..fluid.len()).filter(|&k| fluid.y[k] < DEPTH - radius) {
            let here = [fluid.x[k], fluid.y[k]];
            if ghosts.bodies[Place::Right.number()].plane.beyond(here) < -radius {
                continue;
            }
            let mut sum = [0.0; 2];
            let mut add = |x: f64, y: f64, volume: f64| {
                let (dx, dy) = (here[0] - x, here[1] - y);
                let distance = dx.hypot(dy);
                if distance > 0.0 && distance < radius {
                    let slope = factor * volume * kernel.slope_at(distance / radius) / distance;
                    sum = [sum[0] + slope * dx, sum[1] + slope * dy];
                }
            };
            for j in 0..fluid.len() {
                add(fluid.x[j], fluid.y[j], fluid.mass[j] / fluid.density[j]);
            }
            for g in 0..ghosts.len() {
                add(ghosts.x[g], ghosts.y[g], ghosts.volume[g]);
            }
            let push = sum[0].hypot(sum[1]) * SPACING;
            assert!(push < 1.5e-3, "{push} at {here:?} before {angle} degrees");
        }
    }
}

/// The story: still water before a leaning wall began to turn after some seconds. In the 35 s of the source's tank energy
/// came from nowhere at 60 degrees, and at 45 degrees the water sank by 9 mm.
#[test]
fn still_water_before_a_leaning_wall_does_not_begin_to_turn() {
    let hydrostatic = "kind = \"hydrostatic\"\nend_time_s = 16\nwall_angle_deg = 60";
    let seawall =
        "still_water_depth_m = 0.3\ntank_length_m = 2\nwave_height_ratio = 0\nend_time_s = 12\n";
    for (scene, angle) in
        [(hydrostatic, ""), (seawall, "wall_angle_deg = 45"), (seawall, "wall_angle_deg = 135")]
    {
        let numerics = "particle_spacing_m = 0.02".parse().unwrap();
        let scene = format!("{scene}{angle}");
        let config = CaseConfig::from_tables(&scene.parse().unwrap(), &numerics).unwrap();
        let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
        println!("{scene}: {:?}", result.energy);
        assert!(result.energy.kinetic < 0.2, "{scene}: {:?}", result.energy);
        assert!(result.energy.potential.abs() < 1.2, "{scene}: {:?}", result.energy);
    }
}

/// 25 rows as in the source's wave tank: pressure within 1 % of ρgh, at an upright wall within 0.2 %,
/// up to one spacing below the surface there, three at a leaning wall, from the first instant on.
#[test]
fn still_water_rests_at_an_incline() {
    for (angle, highest, most) in
        [(60.0, 0.24, 1.0), (90.0, 0.24, 0.2), (120.0, 0.22, 1.0), (150.0, 0.22, 1.0)]
    {
        let scene = format!(
            "kind = \"hydrostatic\"\nstill_water_depth_m = 0.25\ntank_length_m = 0.75\n\
             wall_angle_deg = {angle}\nend_time_s = 0.4\nhistory_interval_s = 0.01"
        );
        let numerics = "particle_spacing_m = 0.01\nsound_speed_ratio = 15";
        let heights = [0.0, 0.02, 0.05, 0.1, 0.15, 0.2, highest];
        let probes = heights.map(|y| {
            let text = format!("name = \"P{y}\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = {y}");
            text.parse().unwrap()
        });
        let config =
            CaseConfig::with_probes(&scene.parse().unwrap(), &numerics.parse().unwrap(), &probes);
        let config = config.unwrap();
        let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
        assert_eq!(result.outcome.particles_lost, 0);
        for row in &result.history {
            assert!((row.force - 1.0).abs() < 0.04, "F* = {} at {angle}", row.force);
            assert!(row.runup.abs() < 0.04, "R* = {} at {angle}", row.runup);
        }
        for y in heights {
            let name = format!("P{y}_worst_gap_full");
            let found = result.readings.iter().find(|reading| reading.name == name);
            let gap = found.unwrap_or_else(|| panic!("{name}")).value;
            assert!(gap < most, "{gap} % of rho g h at {y} m up a wall of {angle} degrees");
        }
        let potential = 0.5 * 1000.0 * 9.81 * 0.25 * 0.25 * 0.75;
        assert!(result.energy.kinetic < 1e-4 * potential, "{:?}", result.energy);
    }
}

/// Incompressible SPH visited each wall once: what a leaning wall pushed behind the bed stayed there
/// until the next step. Four particles were lost, and the energy budget missed 18 %; now 5 %.
#[test]
fn a_wave_keeps_its_particles_under_a_wall_that_leans_over_it() {
    let scene = "wall_angle_deg = 40\nwave_height_ratio = 0.3\nstill_water_depth_m = 0.25\n\
                 tank_length_m = 3\nwave_gauge_m = 1.5\nend_after_stroke_centre_s = 2";
    for scheme in ["wcsph", "isph"] {
        let numerics = format!("particle_spacing_m = 0.03\nscheme = \"{scheme}\"");
        let config = CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap());
        let result = run_case(&config.unwrap(), None, SimdPath::widest(), &Unwatched).unwrap();
        assert_eq!(result.outcome.particles_lost, 0, "{scheme}");
        let gap = result.outcome.energy_gap_percent;
        assert!(gap.abs() < 8.0, "{scheme}: {gap} %");
    }
}

#[test]
fn planes_push_back_along_their_normal() {
    let wall = ghosts(120.0).bodies[Place::Right.number()].plane.moved(0.3);
    let inside = wall.in_front([LENGTH + 0.6, 0.1], 0.01);
    assert!((wall.beyond(inside) + 0.01).abs() < 1e-12);
    let turned = wall.with_across([0.4, -0.7], |across| -across);
    let back = wall.with_across(turned, |across| -across);
    assert!((back[0] - 0.4).abs() < 1e-15 && (back[1] + 0.7).abs() < 1e-15);
    assert!((turned[0].hypot(turned[1]) - 0.65_f64.sqrt()).abs() < 1e-15);
}
