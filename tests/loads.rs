//! Loads on the wall against hydrostatics and against one another.

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, EnvelopeRow, Unwatched, run_case};

fn run(scene: &str, numerics: &str) -> CaseResult {
    let config = CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap());
    run_case(&config.unwrap(), None, SimdPath::widest(), &Unwatched).unwrap()
}

const DEPTH: f64 = 0.2;
const WEIGHT: f64 = 9810.0;
const STILL: &str = "wave_height_ratio = 0\nend_time_s = 0.6\ntank_length_m = 0.6\n\
    wave_gauge_m = 0.3\n";

/// Σ p Δy.
fn integral(envelope: &[EnvelopeRow], of: impl Fn(&EnvelopeRow) -> f64) -> f64 {
    let apart = envelope[1].height_m - envelope[0].height_m;
    envelope.iter().map(of).sum::<f64>() * apart
}

#[test]
fn still_water_presses_by_its_weight_and_turns_the_wall_by_a_third_of_its_depth() {
    for (numerics, within) in [
        ("particle_spacing_m = 0.01", 0.004),
        ("particle_spacing_m = 0.01\nboundary = \"mls-linear\"", 0.004),
        ("particle_spacing_m = 0.0125\nscheme = \"isph\"", 0.02),
    ] {
        let result = run(STILL, numerics);
        let moment = result.outcome.moment_max.unwrap().value;
        assert!((moment - 1.0).abs() < within, "{numerics}: {moment}");
        assert_eq!(result.outcome.first_moment_max, None);
        assert_eq!((result.outcome.first_impulse, result.outcome.rise_time_s), (None, None));
        let envelope = &result.envelope;
        assert!(envelope.len() >= 15, "{numerics}: {envelope:?}");
        for row in envelope {
            let exact = WEIGHT * (DEPTH - row.height_m).max(0.0);
            let gap = (row.pressure_max_pa - exact) / (WEIGHT * DEPTH);
            assert!(gap.abs() < within, "{numerics}: {row:?}, {exact} Pa");
            assert_eq!(row.first_pressure_max_pa, None);
        }
        let force = integral(envelope, |row| row.pressure_max_pa);
        let exact = 0.5 * WEIGHT * DEPTH * DEPTH;
        assert!((force / exact - 1.0).abs() < within, "{numerics}: {force} N/m for {exact}");
    }
}

#[test]
fn a_leaning_wall_is_turned_by_the_water_above_it_too() {
    let result = run(&format!("{STILL}wall_angle_deg = 120"), "particle_spacing_m = 0.01");
    // n_x = sin 120°: the moment of still water is 1/n_x² that on an upright wall.
    let moment = result.outcome.moment_max.unwrap().value;
    assert!((moment / (4.0 / 3.0) - 1.0).abs() < 0.01, "{moment}");
}

#[test]
fn a_bed_under_the_wall_takes_its_share_of_depth_and_lever() {
    let bed = "bed = [[0, 0], [0.3, 0], [0.5, 0.05], [0.6, 0.05]]";
    let result = run(&format!("{STILL}{bed}"), "particle_spacing_m = 0.01");
    let moment = result.outcome.moment_max.unwrap().value;
    assert!((moment - 1.0).abs() < 0.005, "{moment}, over that of the depth at the wall");
}

/// The story: in the thin water of a high runup the envelope had up to 1.9 times the pressure that gauges at the wall read.
#[test]
fn the_envelope_has_what_gauges_at_the_wall_read() {
    let heights = [1.325, 1.525, 1.725, 1.825].map(|share| share * DEPTH);
    let gauge = |y: f64| format!("name = \"p\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = {y}");
    let gauges: Vec<_> = heights
        .iter()
        .map(|&y| gauge(y).replace("\"p\"", &format!("\"p{y:.3}\"")).parse().unwrap())
        .collect();
    let scene = "wave_height_ratio = 0.57\ntank_length_m = 2.5\nwave_gauge_m = 1.3\n\
        end_after_stroke_centre_s = 1.9\nhistory_interval_s = 0.0004";
    let numerics = "particle_spacing_m = 0.01".parse().unwrap();
    let config = CaseConfig::with_probes(&scene.parse().unwrap(), &numerics, &gauges).unwrap();
    let result = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
    let probes = result.probes.unwrap();
    // Maxima are those of means over 0.07 √(h/g).
    let window = (0.07 * (DEPTH / 9.81).sqrt() / 0.0004) as usize;
    for (k, height) in heights.into_iter().enumerate() {
        let read: Vec<_> = probes.values.chunks(heights.len()).map(|row| row[k]).collect();
        let means = read.windows(window).map(|some| some.iter().sum::<f64>() / window as f64);
        let read = means.fold(0.0, f64::max);
        let above = result.envelope.iter().position(|row| row.height_m > height).unwrap();
        let [below, above] = [above - 1, above].map(|at| &result.envelope[at]);
        let part = (height - below.height_m) / (above.height_m - below.height_m);
        let told = below.pressure_max_pa + part * (above.pressure_max_pa - below.pressure_max_pa);
        println!("{height:.3} {read} {told}");
        assert!((told - read).abs() < 0.03 * WEIGHT * DEPTH, "{height}: {told} Pa for {read}");
    }
}

#[test]
fn loads_of_a_solitary_wave_agree_with_its_force() {
    let scene = "wave_height_ratio = 0.4\ntank_length_m = 1.5\nwave_gauge_m = 0.75\n\
        end_after_stroke_centre_s = 1.6";
    let result = run(scene, "particle_spacing_m = 0.0125");
    let outcome = &result.outcome;
    let unit = 0.5 * WEIGHT * DEPTH * DEPTH;
    let force = outcome.first_force_max.unwrap();
    assert!(force.value > 2.0, "{force:?}");
    let first = |row: &EnvelopeRow| row.first_pressure_max_pa.unwrap();
    let of_first = integral(&result.envelope, first) / unit;
    let of_all = integral(&result.envelope, |row| row.pressure_max_pa) / unit;
    // What is largest at each height is at least what was there at once, and here hardly more.
    assert!(of_first > 0.985 * force.value, "{of_first} against {}", force.value);
    assert!(of_first < 1.06 * force.value, "{of_first} against {}", force.value);
    assert!(of_all >= of_first);
    // Under a crest of height R the lever is near a third of 1 + R, as if the water stood still.
    let (moment, runup) = (outcome.first_moment_max.unwrap(), outcome.first_runup_max.unwrap());
    let lever = moment.value / force.value;
    assert!(lever > 1.0 && lever < 1.1 * (1.0 + runup.value), "{lever} for R* = {}", runup.value);
    assert!((moment.time_s - force.time_s).abs() < 0.1);
    assert!(outcome.moment_max.unwrap().value >= moment.value);
    // The impulse against the history's own integral, and the rise against its course.
    let rows = result.history.windows(2);
    let sum: f64 = rows.map(|pair| (pair[1].time_s - pair[0].time_s) * (pair[0].force - 1.0)).sum();
    let impulse = outcome.first_impulse.unwrap();
    let whole = sum / (DEPTH / 9.81).sqrt();
    assert!((impulse / whole - 1.0).abs() < 0.05, "{impulse} against {whole}");
    let passed = |share: f64| {
        let level = 1.0 + share * (force.value - 1.0);
        result.history.iter().find(|row| row.force > level).unwrap().time_s
    };
    let rise = outcome.rise_time_s.unwrap();
    assert!((rise - (passed(0.9) - passed(0.1))).abs() < 0.02, "{rise}");
}
