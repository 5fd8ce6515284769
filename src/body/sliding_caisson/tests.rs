use super::*;

/// m = 2, F_0 = 200, μ_s N = 50, μ_k N = 30.
fn caisson() -> SlidingCaisson {
    SlidingCaisson::at_rest(2.0, 200.0, [50.0, 30.0])
}

#[test]
fn it_stands_within_its_threshold_on_either_side() {
    for force in [150.0, 200.0, 250.0] {
        let mut caisson = caisson();
        assert!(!caisson.lets_go(force));
        assert_eq!(caisson.kick(force, 1.0, 0.1), WallStep::default());
        assert!(!caisson.has_moved() && caisson.rests());
    }
    assert!(caisson().lets_go(250.1) && caisson().lets_go(149.9));
    assert_eq!(caisson().kick(260.0, 1.0, 0.1).acceleration, 10.0);
    assert_eq!(caisson().kick(140.0, 1.0, 0.1).acceleration, -10.0);
}

/// The excess over F_0 is 60 for 1 s, 40 for 1 s, zero, -80 for 0.5 s, and zero.
#[test]
fn pieces_of_constant_force_give_the_exact_slide() {
    let mut caisson = caisson();
    let mut slide = |force: f64, steps: u32| {
        for _ in 0..steps {
            caisson.advance(force, 1.0, 1.0 / 64.0);
        }
        [caisson.displacement, caisson.velocity]
    };
    // M = 3: 10 m/s² for 1 s, 10/3 m/s² for 1 s, -10 m/s² until it stands.
    let near = |[x, v]: [f64; 2], [exact_x, exact_v]: [f64; 2]| {
        assert!((x - exact_x).abs() < 1e-12 && (v - exact_v).abs() < 1e-12, "{x} {v}");
    };
    near(slide(260.0, 64), [5.0, 10.0]);
    let (x, v) = (5.0 + 10.0 + 5.0 / 3.0, 10.0 + 10.0 / 3.0);
    near(slide(240.0, 64), [x, v]);
    let stands = x + v * v / 20.0;
    near(slide(200.0, 64), [x + v - 5.0, v - 10.0]);
    near(slide(200.0, 64), [stands, 0.0]);
    near(slide(240.0, 64), [stands, 0.0]);
    // Back: -50/3 m/s² for 0.5 s, then 10 m/s² against the motion.
    let back = 50.0 / 6.0;
    near(slide(120.0, 32), [stands - 0.25 * back, -back]);
    near(slide(200.0, 64), [stands - 0.25 * back - back * back / 20.0, 0.0]);
}

#[test]
fn it_turns_within_a_step_where_the_force_throws_it_back() {
    let mut caisson = SlidingCaisson { velocity: 1.0, ..caisson() };
    let step = caisson.advance(110.0, 0.0, 0.1);
    // -60 m/s² for 1/60 s, then -30 m/s².
    let left = 0.1 - 1.0 / 60.0;
    assert!((caisson.velocity + 30.0 * left).abs() < 1e-12);
    assert!((step.travel - 1.0 / 120.0 + 15.0 * left * left).abs() < 1e-12);
}

/// The force is F_0 + 120 sin ωt for half a period, then F_0. The caisson starts at ωt_1 =
/// asin(50/120).
fn end_of_half_sine(steps: u32, law: fn(&mut SlidingCaisson, f64, f64) -> WallStep) -> f64 {
    let (mut caisson, dt) = (caisson(), 0.5 / f64::from(steps));
    for step in 0..12 * steps {
        let middle = dt * (f64::from(step) + 0.5);
        let push = if middle < 0.5 { 120.0 * libm::sin(OMEGA * middle) } else { 0.0 };
        law(&mut caisson, 200.0 + push, dt);
    }
    assert!(caisson.rests());
    caisson.displacement
}

/// Half a period is half a second.
const OMEGA: f64 = std::f64::consts::TAU;

#[test]
fn a_half_sine_of_force_gives_the_exact_slide() {
    let (push, friction, inertia) = (120.0, 30.0, 3.0);
    let start = libm::asin(50.0 / push) / OMEGA;
    let (since, cos) = (0.5 - start, libm::cos(OMEGA * start));
    // (120 sin ωt - 30)/3, integrated once and twice from t_1 to half a period.
    let velocity = (push / OMEGA * (cos + 1.0) - friction * since) / inertia;
    let travel = (push / OMEGA * (cos * since + libm::sin(OMEGA * start) / OMEGA)
        - 0.5 * friction * since * since)
        / inertia;
    let exact = travel + 0.5 * velocity * velocity * inertia / friction;
    let advance = |steps| {
        let law = |wall: &mut SlidingCaisson, force, dt| wall.advance(force, 1.0, dt);
        (end_of_half_sine(steps, law) / exact - 1.0).abs()
    };
    let kick = |steps| {
        let law = |wall: &mut SlidingCaisson, force, dt| wall.kick(force, 1.0, dt);
        (end_of_half_sine(steps, law) / exact - 1.0).abs()
    };
    assert!(advance(200) < 5e-3 && advance(2000) < 5e-4, "{}", advance(200));
    assert!(kick(200) < 2e-2 && kick(2000) < 2e-3, "{}", kick(200));
}

#[test]
fn friction_and_the_water_behind_take_what_is_not_motion() {
    let (mut caisson, mut held) = (caisson(), 0.0);
    let (mut work, mut way) = (0.0, 0.0);
    for step in 0..4000 {
        let force = if step < 1000 { 260.0 } else { 200.0 };
        let step = caisson.advance(force, 0.0, 1e-3);
        work += force * step.travel;
        way += step.travel;
        held += (force - caisson.driving(force, step.travel)) * step.travel;
    }
    assert!(caisson.rests());
    assert!((held - 230.0 * way).abs() < 1e-9 * held, "{held}");
    assert!((work - held).abs() < 1e-6 * work, "{work} {held}");
}

#[test]
fn its_acceleration_jumps_where_it_breaks_loose_turns_round_and_stops() {
    let mut caisson = caisson();
    let mut jumps = |force: f64| caisson.kick(force, 1.0, 0.1).jumps;
    let told = [200.0, 260.0, 260.0, 200.0, 100.0, 100.0, 240.0, 240.0, 200.0].map(&mut jumps);
    assert_eq!(told, [false, true, false, false, true, false, false, true, false]);
}
