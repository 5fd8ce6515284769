//! Runs driven over the edge end with a typed reason, and smaller steps bring them back.

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, FailureKind, Stopped, Unwatched, run_case};

/// A short, coarse tank; a second of work.
fn config(numerics: &str) -> CaseConfig {
    let scene = "tank_length_m = 1.0\nwave_gauge_m = 0.5\nend_after_stroke_centre_s = 0.8";
    let numerics = format!("particle_spacing_m = 0.025\n{numerics}");
    CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap()
}

fn run(numerics: &str) -> Result<CaseResult, Stopped> {
    run_case(&config(numerics), None, SimdPath::widest(), &Unwatched)
}

/// Strong damping of sound; in the longest steps that the door lets in unstable within a few.
const DAMPED: &str = "bulk_damping = 1";

#[test]
fn energy_from_nowhere_ends_a_run_early() {
    let numerics = format!("{DAMPED}\ncourant_number = 2.5\nsound_speed_ratio = 8");
    let Err(Stopped::Failed(failure)) = run(&numerics) else { panic!("this cannot be stable") };
    assert_eq!(failure.kind, FailureKind::EnergyGrowth);
    assert!(failure.time_s < 0.2, "{failure}");
    assert!(failure.detail.contains("particle"), "{failure}");
}

#[test]
fn a_retry_takes_half_the_step_and_says_so() {
    let mut retried = run(&format!("{DAMPED}\ncourant_number = 2.5\nretries = 2")).unwrap();
    let told = retried.outcome.recovered.take().unwrap();
    assert!(told.starts_with("recovered with 1/2 of the time step after energy-growth"), "{told}");
    let halved = run(&format!("{DAMPED}\ncourant_number = 1.25")).unwrap();
    assert_eq!(retried.outcome, halved.outcome);
    assert_eq!(retried.history, halved.history);
}

/// Viscosity is explicit: where it is strong, steps get shorter by themselves.
#[test]
fn strong_viscosity_takes_shorter_steps() {
    let mild = run("").unwrap().outcome;
    let strong = run("artificial_viscosity = 0.5").unwrap().outcome;
    assert!(strong.health.closest().0 <= 0.5, "{:?}", strong.health);
    let ratio = strong.steps as f64 / mild.steps as f64;
    assert!((ratio - 1.8).abs() < 0.02, "{ratio}");
}

#[test]
fn a_healthy_run_stays_far_from_every_bound() {
    let outcome = run("retries = 2").unwrap().outcome;
    let (share, bound) = outcome.health.closest();
    assert!(share > 0.0 && share < 0.5, "{bound}: {share}");
    assert_eq!(outcome.recovered, None);
}

/// The story: with ten and a half rows, rows stood closer than columns. After 40 s the water moved with 0.9 J/m, and
/// R* was 0.02; with twelve and a half rows such runs ended after a minute.
#[test]
fn still_water_rests_whatever_its_depth() {
    for scheme in ["wcsph", "isph"] {
        let scene = "still_water_depth_m = 0.21\ntank_length_m = 0.8\nwave_gauge_m = 0.4\n\
                     wave_height_ratio = 0\nend_time_s = 40";
        let numerics = format!("particle_spacing_m = 0.02\nscheme = \"{scheme}\"");
        let config =
            CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap();
        let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
        let kinetic = result.energy.kinetic;
        println!("{scheme}: {kinetic:.1e} J/m");
        assert!(kinetic < 1e-6, "{scheme}: {kinetic:.1e} J/m");
    }
}

/// Every interpolator holds still water: none lets it creep along the walls.
#[test]
fn still_water_stays_still() {
    let scene =
        "kind = \"hydrostatic\"\nstill_water_depth_m = 0.3\ntank_length_m = 0.6\nend_time_s = 4";
    let potential = 0.5 * 1000.0 * 9.81 * 0.3 * 0.3 * 0.6;
    for boundary in
        ["improved-shepard", "normalized", "sfdi", "mls-linear", "mls-quadratic", "dummy"]
    {
        let numerics = format!("particle_spacing_m = 0.02\nboundary = \"{boundary}\"");
        let config =
            CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap();
        let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
        let kinetic = result.energy.kinetic / potential;
        println!("{boundary}: {kinetic:.1e} of the potential energy");
        assert!(kinetic < 1e-7, "{boundary}: {kinetic:.1e} of the potential energy");
        assert_eq!(result.outcome.boundary_fallbacks, 0, "{boundary}");
    }
}
