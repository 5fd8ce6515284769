//! The contract of boundary interpolators: what every ghost must hold, on every instruction set.

mod basin;

use basin::*;
use seawall::body::BodyMotion;
use seawall::boundary::{GhostGravity, Reflection};
use seawall::pairs::Record;

#[test]
fn a_uniform_field_is_reproduced() {
    everywhere(|with| {
        for ghost_gravity in [GhostGravity::InSum, GhostGravity::AtMirror] {
            let moving = BodyMotion { velocity: 0.7, ..BodyMotion::default() };
            let mut basin = Basin::new(&lattice(0.4), [moving; 3]);
            with(&mut basin);
            basin.rules.gravity = 0.0;
            basin.rules.ghost_gravity = ghost_gravity;
            let filled = basin.fill(|_, _| 700.0, |_, _| [0.7, 0.0]);
            assert!(basin.wet(&filled).count() > 200);
            for (_, _, [x, y], record) in basin.wet(&filled) {
                let what = format!("at {x:.3}, {y:.3}");
                assert_close(record[Record::PRESSURE], 700.0, 1e-9, &what);
                assert_close(record[Record::VX], 0.7, 1e-12, &what);
                assert_close(record[Record::VY], 0.0, 1e-12, &what);
            }
        }
    });
}

#[test]
fn still_water_is_continued_exactly() {
    everywhere(|with| {
        let mut basin = Basin::new(&lattice(0.4), still());
        with(&mut basin);
        let exact = |y: f64| DENSITY * GRAVITY * (DEPTH - y);
        let filled = basin.fill(|_, y| exact(y), |_, _| [0.0; 2]);
        for (g, _, [x, y], record) in basin.wet(&filled) {
            // Above the waterline ghosts fade out, and never pull.
            let pressure = record[Record::PRESSURE];
            let expected = if y > DEPTH && pressure == 0.0 { 0.0 } else { exact(y) };
            assert_close(pressure, expected, 1e-8, &format!("ghost {g} at {x:.3}, {y:.3}"));
            assert_eq!(record[Record::PRESSURE], record[Record::PRESSURE_YY]);
            assert_eq!(record[Record::PRESSURE_XY], 0.0);
        }
    });
}

/// The pressures of all ghosts, by their numbers, in water that accelerates upwards so fast, m/s², and has this pressure.
fn pressures(basin: &mut Basin, up: f64, exact: impl Fn(f64) -> f64) -> Vec<(usize, f64, f64)> {
    basin.acceleration = [0.0, up];
    let filled = basin.fill(|_, y| exact(y), |_, _| [0.0; 2]);
    let told = basin.wet(&filled).map(|(g, _, [_, y], record)| (g, y, record[Record::PRESSURE]));
    told.collect()
}

#[test]
fn water_that_falls_along_the_walls_is_continued_exactly() {
    everywhere(|with| {
        let mut basin = Basin::new(&lattice(0.4), still());
        with(&mut basin);
        basin.rules.ghost_gravity = GhostGravity::Falling;
        let beside = |basin: &Basin, g: usize| {
            let reflection = basin.ghosts.reflection[g];
            matches!(reflection, Reflection::Plane { normal: [nx, _] } if nx.abs() == 1.0)
        };
        // From free fall to twice the weight.
        for up in [-GRAVITY, -0.4 * GRAVITY, 0.7 * GRAVITY] {
            let exact = |y: f64| DENSITY * (GRAVITY + up) * (2.0 * DEPTH - y);
            let told = pressures(&mut basin, up, exact);
            let walls: Vec<_> = told.iter().filter(|(g, ..)| beside(&basin, *g)).collect();
            assert!(walls.len() > 50, "{} ghosts beside the walls", walls.len());
            for (g, y, pressure) in walls {
                assert_close(
                    *pressure,
                    exact(*y),
                    1e-8,
                    &format!("ghost {g} at {y:.3}, {up} m/s²"),
                );
            }
        }
        // No water is lighter than in free fall, and none is heavier than twice.
        let exact = |y: f64| DENSITY * GRAVITY * (DEPTH - y);
        for bound in [-GRAVITY, GRAVITY] {
            let [most, more] = [1.0, 3.0].map(|times| pressures(&mut basin, times * bound, exact));
            assert_eq!(most.len(), more.len());
            for ((g, y, most), (.., more)) in most.into_iter().zip(more) {
                assert_close(most, more, 1e-8, &format!("ghost {g} at {y:.3}, {bound} m/s²"));
            }
        }
        // The bed carries it.
        let [rests, falls] = [0.0, -GRAVITY].map(|up| pressures(&mut basin, up, exact));
        for (rests, falls) in rests.iter().zip(&falls) {
            let is_moved = (rests.2 - falls.2).abs() > 1e-9;
            assert!(!is_moved || beside(&basin, rests.0), "ghost {} at {}", rests.0, rests.1);
        }
        assert!(rests != falls);
    });
}

#[test]
fn compressible_still_water_is_continued_to_second_order() {
    let sound = 10.0 * (GRAVITY * DEPTH).sqrt();
    let exact =
        |y: f64| DENSITY * sound * sound * (GRAVITY * (DEPTH - y) / (sound * sound)).exp_m1();
    let mut basin = Basin::new(&lattice(0.4), still());
    basin.rules.sound_speed = sound;
    let filled = basin.fill(|_, y| exact(y), |_, _| [0.0; 2]);
    // What a density that is uniform over the distance from mirror point to ghost leaves out.
    let tolerance = 0.5 * DENSITY * (GRAVITY * 2.0 * RADIUS / sound).powi(2);
    for (_, _, [x, y], record) in basin.wet(&filled).filter(|ghost| ghost.2[1] < DEPTH) {
        assert_close(record[Record::PRESSURE], exact(y), tolerance, &format!("{x:.3}, {y:.3}"));
    }
}

#[test]
fn water_between_accelerating_walls_is_continued_exactly() {
    everywhere(|with| {
        let acceleration = 3.0;
        let moving = BodyMotion { acceleration, ..BodyMotion::default() };
        let mut basin = Basin::new(&lattice(0.4), [BodyMotion::default(), moving, moving]);
        with(&mut basin);
        basin.responds = WALL;
        let exact = |x: f64, y: f64| {
            DENSITY * (GRAVITY * (2.0 * DEPTH - y) - acceleration * (x - 0.5 * LENGTH))
        };
        let filled = basin.fill(exact, |_, _| [0.0; 2]);
        for (g, number, [x, y], record) in basin.wet(&filled) {
            if number == 0 || y > DEPTH - SPACING {
                continue;
            }
            let response = filled.responses[g][0];
            assert_eq!(response == 0.0, number == PADDLE);
            let pressure = record[Record::PRESSURE] + response * acceleration;
            assert_close(pressure, exact(x, y), 1e-8, &format!("ghost {g} at {x:.3}, {y:.3}"));
        }
    });
}

#[test]
fn a_coincident_particle_gives_its_own_values() {
    with_each(SHEPARD, |with| {
        let mut basin = Basin::new(&lattice(0.0), still());
        with(&mut basin);
        basin.rules.gravity = 0.0;
        let rough = |x: f64, y: f64| 500.0 + 300.0 * (70.0 * x).sin() * (90.0 * y).cos();
        let filled = basin.fill(rough, |_, _| [0.0; 2]);
        let mut seen = 0;
        for (g, number, _, record) in basin.wet(&filled) {
            let (x, y) = (basin.ghosts.target_x[g], basin.ghosts.target_y[g]);
            if number == 0 && !(0.0..LENGTH).contains(&x) || y > DEPTH {
                continue;
            }
            assert_close(record[Record::PRESSURE], rough(x, y), 1e-6, &format!("{x:.3}, {y:.3}"));
            seen += 1;
        }
        assert!(seen > 150, "{seen}");
    });
}

#[test]
fn one_particle_is_enough_and_none_is_no_water() {
    everywhere(|with| {
        let wall = BodyMotion { velocity: 0.4, ..BodyMotion::default() };
        let place = [LENGTH - 0.013, 0.017];
        let mut basin = Basin::new(&[place], [BodyMotion::default(), BodyMotion::default(), wall]);
        with(&mut basin);
        let filled = basin.fill(|_, _| 900.0, |_, _| [0.4, 0.0]);
        let mut reached = 0;
        for (number, body) in basin.ghosts.bodies.iter().enumerate() {
            for g in body.ghosts.clone() {
                let record = &filled.records[g].0;
                let target = if basin.rules.interpolator.at_ghost() {
                    [basin.ghosts.x[g], basin.ghosts.y[g]]
                } else {
                    [basin.ghosts.target_x[g], basin.ghosts.target_y[g]]
                };
                let apart = (target[0] - place[0]).hypot(target[1] - place[1]);
                let expected = 900.0 - DENSITY * GRAVITY * (basin.ghosts.y[g] - place[1]);
                if apart >= RADIUS {
                    let velocity = [basin.bodies[number].velocity, 0.0];
                    assert_eq!(record[Record::PRESSURE], 0.0);
                    assert_eq!(record[Record::WEIGHT], 0.0);
                    assert_eq!([record[Record::VX], record[Record::VY]], velocity);
                } else if apart < 0.9 * RADIUS {
                    let expected = if record[Record::WEIGHT] != 0.0 || expected > 0.0 {
                        expected
                    } else {
                        0.0
                    };
                    assert_close(record[Record::PRESSURE], expected, 1e-8, "one particle");
                    reached += 1;
                }
                assert!(record.iter().all(|value| value.is_finite()));
            }
        }
        assert!(reached > 10, "{reached}");
    });
}

#[test]
fn velocities_are_mirrored() {
    with_each(SHEPARD, |with| {
        for no_slip in [false, true] {
            let at = |velocity| BodyMotion { velocity, ..BodyMotion::default() };
            let mut basin = Basin::new(&lattice(0.0), [at(0.0), at(0.3), at(-0.2)]);
            with(&mut basin);
            basin.rules.no_slip = no_slip;
            let rough = |x: f64, y: f64| [(50.0 * x).sin(), (60.0 * y + 9.0 * x).cos()];
            let filled = basin.fill(|_, _| 0.0, rough);
            let (mut planes, mut corners) = (0, 0);
            for (g, number, _, record) in basin.wet(&filled) {
                let (x, y) = (basin.ghosts.target_x[g], basin.ghosts.target_y[g]);
                if number == 0 && !(0.0..LENGTH).contains(&x) || y > DEPTH {
                    continue;
                }
                let (wall, [vx, vy]) = (basin.bodies[number].velocity, rough(x, y));
                let along = if no_slip { -1.0 } else { 1.0 };
                let expected = match basin.ghosts.reflection[g] {
                    Reflection::Corner => [2.0 * wall - vx, -vy],
                    Reflection::Plane { normal } if normal[0] == 0.0 => {
                        [wall + along * (vx - wall), -vy]
                    }
                    Reflection::Plane { .. } => [2.0 * wall - vx, along * vy],
                };
                let what = format!("ghost {g} of {number}");
                assert_close(record[Record::VX], expected[0], 1e-9, &what);
                assert_close(record[Record::VY], expected[1], 1e-9, &what);
                match basin.ghosts.reflection[g] {
                    Reflection::Corner => corners += 1,
                    Reflection::Plane { .. } => planes += 1,
                }
            }
            assert!(planes > 150 && corners > 20, "{planes} {corners}");
        }
    });
}

/// The wall moves into rough water: the velocity at a ghost is bounded by the water's.
#[test]
fn a_particle_at_the_face_is_not_thrown_about() {
    everywhere(|with| {
        for distance in [1e-9, 1e-4, 0.3 * SPACING] {
            let mut basin = Basin::new(&[[LENGTH - distance, 0.03]], still());
            with(&mut basin);
            let filled = basin.fill(|_, _| 0.0, |_, _| [1.0, 1.0]);
            for record in &filled.records {
                assert!(record.0[Record::VX].abs() <= 3.0 && record.0[Record::VY].abs() <= 3.0);
            }
        }
    });
}

/// Across the wall a linear flow goes on beyond it, wherever the particles happen to be.
#[test]
fn a_linear_flow_goes_on_through_the_wall() {
    everywhere(|with| {
        let (wall, slope) = (0.25, 7.0);
        let moving = BodyMotion { velocity: wall, ..BodyMotion::default() };
        let mut basin =
            Basin::new(&lattice(0.4), [BodyMotion::default(), BodyMotion::default(), moving]);
        with(&mut basin);
        // Around a ghost farther out the water is so near that the mirror's limit sets in.
        let at_ghost = basin.rules.interpolator.at_ghost();
        let farthest = if at_ghost { SPACING } else { 0.5 * RADIUS };
        let flow = |x: f64, _: f64| [wall + slope * (x - LENGTH), 0.0];
        let filled = basin.fill(|_, _| 0.0, flow);
        let mut seen = 0;
        for (g, number, [x, y], record) in basin.wet(&filled) {
            let plane = matches!(basin.ghosts.reflection[g], Reflection::Plane { .. });
            if number != WALL || !plane || basin.ghosts.distance[g] > farthest {
                continue;
            }
            assert_close(record[Record::VX], flow(x, y)[0], 1e-9, &format!("ghost {g}"));
            seen += 1;
        }
        assert!(seen > if at_ghost { 8 } else { 15 }, "{seen}");
    });
}
