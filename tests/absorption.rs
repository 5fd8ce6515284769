//! Paddles that let waves go which come back to them.

use crate::common::expect_refused;
use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case};
use toml::Table;

fn computed(scene: &str, gauge_m: f64) -> CaseResult {
    let table = |text: &str| text.parse::<Table>().unwrap();
    let gauge = format!("name = \"eta\"\nkind = \"elevation\"\nx_m = {gauge_m}");
    let case = CaseConfig::with_probes(
        &table(scene),
        &table("particle_spacing_m = 0.02"),
        &[table(&gauge)],
    );
    run_case(&case.unwrap(), None, SimdPath::widest(), &Unwatched).unwrap()
}

/// The highest surface at the gauge between two times, m.
fn highest(case: &CaseResult, [from, to]: [f64; 2]) -> f64 {
    let rows = case.probes.as_ref().unwrap().rows().filter(|(time, _)| (from..to).contains(time));
    rows.map(|(_, row)| row[0]).fold(0.0, f64::max)
}

/// A solitary wave goes to the wall and back. A paddle that stands throws it back once more; one that
/// absorbs does not.
#[test]
fn a_solitary_wave_leaves_by_the_paddle() {
    let scene = "tank_length_m = 4\nwave_gauge_m = 2\nwave_height_ratio = 0.2\nend_time_s = 8.5\n";
    let shares = ["", "absorption = true\n"].map(|key| {
        let case = computed(&(scene.to_owned() + key), 2.0);
        // It passes the gauge at some 2.2 s, comes back at 4.9 s, and thrown back again passes at 7.6 s.
        let [crest, again] = [[0.0, 3.5], [6.2, 8.5]].map(|window| highest(&case, window));
        println!("{key:?}: {crest} m, then {again} m, gap {} %", case.outcome.energy_gap_percent);
        assert!(case.outcome.energy_gap_percent.abs() < 1.5);
        assert!((crest / 0.04 - 1.0).abs() < 0.1, "{crest}");
        again / crest
    });
    assert!(shares[0] > 0.7 && shares[1] < 0.1, "{shares:?}");
}

/// The story: what the paddle read of its own wave passed for one that has come back, and took 2 % from the force.
#[test]
fn a_paddle_makes_the_same_wave_whether_or_not_it_absorbs() {
    let scene = "tank_length_m = 3\nwave_gauge_m = 1.5\nwave_height_ratio = 0.5\nend_after_stroke_centre_s = 2.2\n";
    let [throws, absorbs] = ["", "absorption = true\n"].map(|key| {
        let outcome = computed(&(scene.to_owned() + key), 1.5).outcome;
        [outcome.first_force_max.unwrap().value, outcome.measured_wave_height_ratio.unwrap()]
    });
    for (throws, absorbs) in throws.into_iter().zip(absorbs) {
        assert!((absorbs / throws - 1.0).abs() < 2e-3, "{absorbs} and {throws}");
    }
}

/// The story: a recorded stroke of the same wave lost 3 % of it, on any clock.
#[test]
fn a_recorded_stroke_makes_the_same_wave_whether_or_not_it_absorbs() {
    let scene = "paddle = \"recorded-stroke\"\nrecorded_stroke = \"sweeps/scenes/recorded_stroke.csv\"\n\
                 wave_height_ratio = 0.4\nend_time_s = 3.6\n";
    let [throws, absorbs] = ["", "absorption = true\n"].map(|key| {
        let outcome = computed(&(scene.to_owned() + key), 1.5).outcome;
        [outcome.first_force_max.unwrap().value, outcome.measured_wave_height_ratio.unwrap()]
    });
    for (throws, absorbs) in throws.into_iter().zip(absorbs) {
        assert!((absorbs / throws - 1.0).abs() < 2e-3, "{absorbs} and {throws}");
    }
}

/// The largest F* - 1 of each period of a second, and the energy gap in percent.
fn peaks(periods: u32) -> (Vec<f64>, f64) {
    let scene = format!(
        "tank_length_m = 2.6\nwave_gauge_m = 1.3\nwave_height_ratio = 0.1\npaddle = \"wave-train\"\n\
         wave_period_s = 1\nend_time_s = {periods}\nabsorption = true\n"
    );
    let case = computed(&scene, 1.3);
    let peak = |period: u32| {
        let within = f64::from(period)..f64::from(period + 1);
        let rows = case.history.iter().filter(|row| within.contains(&row.time_s));
        rows.map(|row| row.force - 1.0).fold(f64::NEG_INFINITY, f64::max)
    };
    let peaks: Vec<f64> = (0..periods).map(peak).collect();
    println!("{peaks:?}, gap {} %", case.outcome.energy_gap_percent);
    (peaks, case.outcome.energy_gap_percent)
}

/// The highest peak over the lowest.
fn spread(peaks: &[f64]) -> f64 {
    let [low, high] = [f64::min, f64::max]
        .map(|pick: fn(f64, f64) -> f64| peaks.iter().copied().reduce(pick).unwrap());
    assert!(low > 0.0, "{low}");
    high / low
}

/// Waves from a paddle that absorbs become the same from period to period.
#[test]
fn a_train_before_a_wall_becomes_periodic() {
    let (peaks, gap) = peaks(14);
    assert!(spread(&peaks[8..]) < 1.1, "{}", spread(&peaks[8..]));
    assert!(gap.abs() < 2.0, "{gap}");
}

/// Ten rows, and waves a spacing high: they stay what they are, and a paddle that throws waves back has
/// peaks that differ tenfold.
#[test]
fn a_train_stays_periodic_for_fifty_periods() {
    let (peaks, gap) = peaks(50);
    assert!(gap.abs() < 2.0, "{gap}");
    assert!(spread(&peaks[10..]) < 1.1, "{}", spread(&peaks[10..]));
    let [early, late] = [&peaks[10..20], &peaks[40..]].map(|ten| ten.iter().sum::<f64>() / 10.0);
    assert!((late / early - 1.0).abs() < 0.05, "{early} and {late}");
}

#[test]
fn what_cannot_absorb_is_told() {
    for (numerics, told) in [
        ("scheme = \"isph\"", "scene.absorption = true: is for scheme = \"wcsph\""),
        ("stop_when_settled = true", "scene.absorption = true: is not for stop_when_settled"),
    ] {
        let text = format!("name = \"no\"\n[scene]\nabsorption = true\n[numerics]\n{numerics}\n");
        expect_refused(&text, told);
    }
}
