//! Dam breaks of few particles, whose energy must be accounted for.

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Stopped, Unwatched, run_case};

fn computed(scene: &str, numerics: &str) -> Result<CaseResult, Stopped> {
    let config = CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap());
    run_case(&config.unwrap(), None, SimdPath::widest(), &Unwatched)
}

/// The shipped column with these keys besides: its result, and the share of its energy that is lost
/// unaccounted for.
fn collapse(scene: &str, numerics: &str) -> (CaseResult, f64) {
    let scene = format!(
        "kind = \"dam-break\"\ncolumn_height_m = 0.6\ncolumn_length_m = 1.2\n\
         tank_length_m = 3.2196\n{scene}"
    );
    let numerics = format!("{numerics}\nsound_speed_ratio = 20");
    let result = computed(&scene, &numerics);
    let result = result.unwrap_or_else(|stopped| panic!("{numerics}: {stopped:?}"));
    let start = 0.5 * 1000.0 * 9.81 * 1.2 * 0.6 * 0.6;
    let share = result.energy.residual() / start;
    (result, share)
}

/// The story: the monitor ended every dam break of the default preset below some twenty rows, and
/// every one with walls that hold the water, with energy that came from nowhere. Water near the
/// surface that expanded against no pressure was booked as charged with elastic energy, and a
/// tangential velocity turned round at a wall entered the continuity equation as compression that
/// no force did work on.
#[test]
fn no_energy_appears_as_a_coarse_column_collapses() {
    for (preset, slip) in
        [("default", "free"), ("default", "no"), ("huang2019", "free"), ("huang2019", "no")]
    {
        let numerics =
            format!("preset = \"{preset}\"\nslip = \"{slip}\"\nparticle_spacing_m = 0.05");
        let (result, share) = collapse("", &numerics);
        assert!((-0.025..0.05).contains(&share), "{preset}, {slip}: {share}");
        assert_eq!(result.outcome.particles_lost, 0);
    }
}

/// The story: the first air that water closed in counted. The splash of the front closed in some after 2.7 and 4.5 √(H/g), and
/// the tongue does after 6.
#[test]
fn the_tongue_closes_the_cavity_and_not_the_splash() {
    for (preset, spacing) in [("default", 0.03), ("default", 0.0175), ("huang2019", 0.03)] {
        let (result, _) =
            collapse("", &format!("preset = \"{preset}\"\nparticle_spacing_m = {spacing}"));
        let closure = result.readings.iter().find(|it| it.name == "cavity_closure").unwrap().value;
        assert!((5.9..6.2).contains(&closure), "{preset}, {spacing} m: {closure}");
    }
}

/// What comes back from the wall plunges on the water behind it. Runs of more than 8 √(H/g) ended there, as energy
/// came from nowhere or single particles ran away. The water comes to lie as deep as the tank is long.
#[test]
fn a_column_runs_on_when_its_front_comes_back() {
    let scene = "kind = \"dam-break\"\nend_time_s = 6";
    let numerics = "particle_spacing_m = 0.03";
    let config =
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap();
    let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
    let weight = |length: f64, depth: f64| 0.5 * 1000.0 * 9.81 * length * depth * depth;
    let start = weight(1.2, 0.6);
    let (lost, share) =
        (start - weight(3.2196, 0.6 * 1.2 / 3.2196), result.energy.residual() / start);
    println!("{share} of the energy missing, {} of {lost} J/m fallen", -result.energy.potential);
    assert!(share.abs() < 0.05, "{share}");
    assert!((-result.energy.potential / lost - 1.0).abs() < 0.1);
}

/// The story: jets up the wall were called runaway from twice the speed of a fall from the column's
/// top, 6.9 m/s; its front alone has 1.4 times that speed. Whole runs of the shipped scene ended so at
/// some spacings, at the impact.
#[test]
fn the_jet_of_an_impact_is_no_runaway() {
    let scene = "initial_density = \"dam-break\"\nend_time_s = 0.8";
    let numerics = "preset = \"huang2019\"\nboundary = \"mls-quadratic\"\n\
                    ghost_gravity = \"at-mirror\"\nparticle_spacing_m = 0.015";
    let (_, share) = collapse(scene, numerics);
    assert!(share.abs() < 0.02, "{share}");
}

/// The story: where the wall is near, the front comes back soon, and jets of water that meet were called runaway. Some
/// particles beside cavities were pressed to twice their density.
#[test]
fn a_front_that_comes_back_soon_is_no_runaway() {
    for (height, length, tank, rows) in [(0.6, 1.2, 2.1, 40.0), (0.6, 1.2, 2.6, 48.0)] {
        let scene = format!(
            "kind = \"dam-break\"\ncolumn_height_m = {height}\ncolumn_length_m = {length}\ntank_length_m = {tank}"
        );
        let numerics = format!("particle_spacing_m = {}", height / rows);
        let result = computed(&scene, &numerics);
        let gap = result.unwrap_or_else(|stopped| panic!("{stopped:?}")).outcome.energy_gap_percent;
        assert!(gap.abs() < 1.5, "{tank}: {gap} %");
    }
}

/// The story: checks came with the samples of the history. With few of them a run that lost its books ended well.
#[test]
fn a_sick_run_ends_whatever_its_history() {
    let ended = |interval: f64| {
        let scene = format!(
            "kind = \"dam-break\"\ncolumn_height_m = 0.57\ncolumn_length_m = 0.19\ntank_length_m = 3.2\n\
             history_interval_s = {interval}"
        );
        let numerics = "particle_spacing_m = 0.031\ncourant_number = 1.8";
        computed(&scene, numerics).map(|_| ())
    };
    let fine = format!("{:?}", ended(0.002).unwrap_err());
    assert!(fine.contains("EnergyGrowth"), "{fine}");
    for interval in [0.3, 1.9] {
        assert!(
            format!("{:?}", ended(interval).unwrap_err()).contains("EnergyGrowth"),
            "{interval}"
        );
    }
}

/// The story: the long steps of columns that are twice as long as high ended square ones with energy from nowhere.
#[test]
fn square_columns_collapse_in_tanks_of_any_length() {
    for tank_length in [1.4, 2.0, 2.6] {
        let scene = format!(
            "kind = \"dam-break\"\ncolumn_height_m = 0.57\ncolumn_length_m = 0.57\n\
             tank_length_m = {tank_length}"
        );
        let result = computed(&scene, "particle_spacing_m = 0.031").unwrap();
        let gap = result.outcome.energy_gap_percent;
        assert!(gap.abs() < 2.5, "{tank_length}: {gap} %");
    }
}

/// Between walls that hold it a column stands still. What momentum it has is rounding, of which the gap was
/// told as up to 63 %.
#[test]
fn a_column_that_stands_still_has_no_momentum_to_miss() {
    let told = |tank: f64| {
        let scene = format!(
            "kind = \"dam-break\"\ncolumn_height_m = 0.4\ncolumn_length_m = 0.3\n\
             tank_length_m = {tank}\ninitial_density = \"hydrostatic\"\nend_time_s = 0.3"
        );
        let result = computed(&scene, "particle_spacing_m = 0.02").unwrap();
        result.readings.iter().any(|reading| reading.name == "horizontal_momentum_gap")
    };
    assert!(!told(0.3));
    assert!(told(0.6));
}

/// The story: a column as long as its tank began with the pressure of one that is released. The wall at its end had none,
/// and F* rose to 1.5 before the water came to rest.
#[test]
fn a_column_that_fills_its_tank_rests_from_the_start() {
    let force = |density: &str| {
        let scene = format!(
            "kind = \"dam-break\"\ncolumn_height_m = 0.4\ncolumn_length_m = 0.6\n\
             tank_length_m = 0.6\n{density}\nend_time_s = 0.3"
        );
        let result = computed(&scene, "particle_spacing_m = 0.02").unwrap();
        (result.outcome.force_max.value, result.outcome.force_max_raw)
    };
    let (smooth, raw) = force("");
    assert!((smooth - 1.0).abs() < 0.01 && (raw - 1.0).abs() < 0.01, "{smooth} {raw}");
    assert_eq!(force("initial_density = \"hydrostatic\""), (smooth, raw));
    assert!(force("initial_density = \"dam-break\"").0 > 1.2);
}
