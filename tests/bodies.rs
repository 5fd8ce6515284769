//! What paddles make of the water, and water of a caisson, on coarse particles.

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case, run_trunk};
use toml::Table;

const GAUGE: &str = "name = \"level\"\nkind = \"level\"\nx_m = 1.5\n";

fn table(text: &str) -> Table {
    text.parse().unwrap()
}

fn config(scene: &str, spacing: f64) -> CaseConfig {
    let numerics = table(&format!("particle_spacing_m = {spacing}"));
    CaseConfig::with_probes(&table(scene), &numerics, &[table(GAUGE)]).unwrap()
}

fn run(scene: &str, spacing: f64) -> CaseResult {
    run_case(&config(scene, spacing), None, SimdPath::widest(), &Unwatched).unwrap()
}

/// Amplitude of a harmonic of a period, over whole periods of even samples.
fn harmonic(series: &[(f64, f64)], rate: f64) -> f64 {
    let parts = series.iter().fold([0.0; 2], |[a, b], (time, level)| {
        let (sin, cos) = (rate * time).sin_cos();
        [a + level * cos, b + level * sin]
    });
    2.0 * parts[0].hypot(parts[1]) / series.len() as f64
}

#[test]
fn a_wave_train_has_the_crests_and_troughs_of_second_order() {
    let result = run(
        "paddle = \"wave-train\"\nwave_height_ratio = 0.3\nwave_period_s = 1\n\
         tank_length_m = 5\nend_time_s = 6\n",
        0.0125,
    );
    let levels = result.probes.unwrap();
    let at_rest = levels.values[0];
    let series: Vec<_> = (levels.time_s.iter().zip(&levels.values))
        .map(|(time, level)| (*time, level - at_rest))
        .filter(|(time, _)| (4.0..6.0).contains(time))
        .collect();
    let (height, depth, omega) = (0.06, 0.2, std::f64::consts::TAU);
    let mut k: f64 = 5.0;
    for _ in 0..100 {
        k = 0.5 * (k + omega * omega / (9.81 * (k * depth).tanh()));
    }
    let coth = 1.0 / (k * depth).tanh();
    // Stokes: η = H/2 cos θ + k H²/16 (3 coth³ kh - coth kh) cos 2θ.
    let second = k * height * height / 16.0 * (3.0 * coth.powi(3) - coth);
    let [first_read, second_read] = [omega, 2.0 * omega].map(|rate| harmonic(&series, rate));
    let ends = [f64::max, f64::min]
        .map(|pick: fn(f64, f64) -> f64| series.iter().map(|(_, level)| *level).fold(0.0, pick));
    println!("{first_read} {second_read} {second} {ends:?}");
    assert!((first_read / (0.5 * height) - 1.0).abs() < 0.08, "{first_read}");
    assert!((second_read / second - 1.0).abs() < 0.4, "{second_read} {second}");
    assert!((ends[0] / (0.5 * height + second) - 1.0).abs() < 0.12, "{ends:?}");
    assert!((ends[1] / (second - 0.5 * height) - 1.0).abs() < 0.15, "{ends:?}");
}

#[test]
fn a_recorded_solitary_stroke_makes_the_solitary_wave() {
    let ending = "wave_height_ratio = 0.4\nend_time_s = 3\n";
    let path = "sweeps/scenes/recorded_stroke.csv";
    let recorded = format!("paddle = \"recorded-stroke\"\nrecorded_stroke = \"{path}\"\n{ending}");
    let [recorded, made] = [recorded.as_str(), ending].map(|scene| run(scene, 0.02).outcome);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 0.01, "{a} {b}");
    near(recorded.force_max.value, made.force_max.value);
    near(recorded.runup_max.value, made.runup_max.value);
    near(recorded.measured_wave_height_ratio.unwrap(), made.measured_wave_height_ratio.unwrap());
}

/// The story: a recorded train had the numerics of a single wave, so its forces scattered from wave to wave and energy
/// came from its walls.
#[test]
fn a_recorded_train_makes_the_waves_of_the_train() {
    let tank = "wave_height_ratio = 0.1\ntank_length_m = 2.6\nend_time_s = 10\n";
    let train = format!("paddle = \"wave-train\"\nwave_period_s = 1\n{tank}");
    let made = config(&train, 0.025);
    let paddle = made.scene.seawall().unwrap().paddle().unwrap();
    let row = |time: f64| format!("{time},{}\n", paddle.motion(time).offset);
    let rows: String = (0..=1000).map(|k| row(0.01 * f64::from(k))).collect();
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), format!("time_s,stroke_m\n{rows}")).unwrap();
    let recorded =
        format!("paddle = \"recorded-stroke\"\nrecorded_stroke = {:?}\n{tank}", file.path());
    let played = config(&recorded, 0.025);
    assert_eq!(played.numerics, made.numerics);
    let [made, played] = [made, played].map(|case| {
        let result = run_case(&case, None, SimdPath::widest(), &Unwatched).unwrap();
        // The first of many recorded waves once stood for all of them, the smallest.
        let recorded = case.scene.seawall().unwrap().recorded.is_some();
        assert_eq!(result.outcome.first_force_max.is_none(), recorded);
        let history = result.history;
        (2..10).map(move |period| {
            let rows = history.iter().filter(|row| row.time_s as i32 == period);
            rows.map(|row| row.force).fold(0.0, f64::max)
        })
    });
    for (made, played) in made.zip(played) {
        assert!((played / made - 1.0).abs() < 2e-3, "{played} {made}");
    }
}

/// The story: a clock that shows 86400 s at the start, or the time since 1970, left the energy budget open by 274 %, or
/// the run never began.
#[test]
fn a_recorded_clock_may_begin_anywhere() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("stroke.csv");
    let [near, far, epoch] = [0.0, 86400.123, 1.7e9].map(|start| {
        let at = |after: f64| start + after;
        let points = [at(0.0), at(0.7), at(1.4)];
        let [first, second, third] = points;
        let text = format!("time_s,stroke_m\n{first},0\n{second},0.1\n{third},0.15\n");
        std::fs::write(&path, text).unwrap();
        let scene = format!(
            "paddle = \"recorded-stroke\"\nend_time_s = {}\nrecorded_stroke = {path:?}\n\
             wave_height_ratio = 0.2\ntank_length_m = 1.5\nwave_gauge_m = 1\n",
            at(1.5)
        );
        let case = config(&scene, 0.02);
        let result = run_case(&case, None, SimdPath::widest(), &Unwatched).unwrap();
        [result.outcome.energy_gap_percent, result.outcome.force_max.value]
    });
    for other in [far, epoch] {
        assert!((other[0] - near[0]).abs() < 0.01, "{near:?} {other:?}");
        assert!((other[1] / near[1] - 1.0).abs() < 1e-4, "{near:?} {other:?}");
    }
}

#[test]
fn what_the_file_says_is_part_of_the_case() {
    let directory = tempfile::tempdir().unwrap();
    let case = |name: &str, end: f64| {
        let path = directory.path().join(name);
        std::fs::write(&path, format!("time_s,stroke_m\n0,0\n1,0.1\n2,{end}\n")).unwrap();
        let scene = format!(
            "paddle = \"recorded-stroke\"\nend_time_s = 3\nrecorded_stroke = {:?}\n",
            path.to_str().unwrap()
        );
        config(&scene, 0.02)
    };
    let one = case("a.csv", 0.2);
    assert_eq!(one, case("b.csv", 0.2));
    assert_ne!(one, case("a.csv", 0.3));
    // As a worker gets it: without the file.
    let sent = serde_json::to_string(&one).unwrap();
    std::fs::remove_file(directory.path().join("a.csv")).unwrap();
    assert_eq!(serde_json::from_str::<CaseConfig>(&sent).unwrap(), one);
}

#[test]
fn a_paddle_without_its_keys_is_told_so() {
    let bad = [
        (
            "paddle = \"wave-train\"\nend_time_s = 1",
            "scene.wave_period_s: is needed where paddle = \"wave-train\"",
        ),
        ("paddle = \"recorded-stroke\"\nend_time_s = 1", "scene.recorded_stroke: is needed"),
        ("wave_period_s = 1", "scene.wave_period_s = 1: belongs to paddle = \"wave-train\""),
        (
            "paddle = \"wave-train\"\nwave_period_s = 1",
            "scene.end_time_s: is needed where no stroke",
        ),
        (
            "paddle = \"wave-train\"\nwave_period_s = 9\nend_time_s = 1",
            "scene.wave_period_s = 9: must be 1.152 s or less: longer waves are too long",
        ),
        (
            "paddle = \"recorded-stroke\"\nrecorded_stroke = \"no.csv\"\nend_time_s = 1",
            "scene.recorded_stroke = \"no.csv\": cannot be read",
        ),
    ];
    for (scene, message) in bad {
        let told = CaseConfig::from_tables(&table(scene), &Table::new()).unwrap_err().to_string();
        assert!(told.starts_with(message), "{told:?} should start with {message:?}");
    }
}

#[test]
fn a_caisson_slides_once_the_wave_beats_its_friction_and_stays_where_it_stops() {
    let case = config(
        "wave_height_ratio = 0.5\nwall = \"caisson\"\nseawall_mass_kg_per_m = 60\n\
         submerged_weight_n_per_m = 300\nstatic_friction = 0.6\nkinetic_friction = 0.5\n",
        0.016,
    );
    let path = SimdPath::widest();
    let whole = run_case(&case, None, path, &Unwatched).unwrap();
    let trunk = run_trunk(&case.trunk().unwrap(), path, &Unwatched).unwrap();
    let branch = run_case(&case, Some(&trunk.checkpoint), path, &Unwatched).unwrap();
    assert_eq!(whole.history, branch.history);
    assert_eq!(whole.outcome, branch.outcome);
    // ½ρgh² = 196.2 N/m and μ_s N = 180 N/m.
    let threshold = 1.0 + 180.0 / 196.2;
    let start = whole.history.iter().position(|row| row.displacement != 0.0).unwrap();
    let (stands, slides) = whole.history.split_at(start);
    // It waits for a full step.
    assert!(stands.iter().all(|row| row.force <= 1.01 * threshold));
    assert!(slides[0].force > 0.95 * threshold && trunk.time_s <= slides[0].time_s);
    let last = whole.history.last().unwrap();
    assert!(last.displacement > 0.5 && last.wall_velocity_m_per_s == 0.0, "{last:?}");
    assert_eq!(Some(last.displacement), whole.outcome.displacement_max.map(|m| m.value));
    assert!(whole.outcome.energy_gap_percent.abs() < 1.0);
    // Friction and the water behind it, over the way, take nearly all that the wave gave it.
    let way = 0.2 * last.displacement;
    let taken = (196.2 + 150.0) * way;
    assert!((whole.energy.threshold_device / taken - 1.0).abs() < 0.02, "{taken}");
}

/// The story: the largest F* of a caisson was told as 1.87 where it had stood up to 1.917. What was taken off as the
/// water's sound was the jump of the wall's own acceleration.
#[test]
fn a_caisson_that_slid_was_pressed_with_what_it_holds() {
    for (height, friction) in [(0.4, 0.6), (0.5, 0.8)] {
        let scene = format!(
            "wall = \"caisson\"\nseawall_mass_kg_per_m = 60\nsubmerged_weight_n_per_m = 300\n\
             static_friction = {friction}\nkinetic_friction = 0.1\nwave_height_ratio = {height}\n\
             history_interval_s = 0.0005"
        );
        let result = run(&scene, 0.016);
        let holds = 1.0 + friction * 300.0 / (0.5 * 9810.0 * 0.2 * 0.2);
        let told = result.outcome.force_max.value;
        let span = 0.07 * (0.2_f64 / 9.81).sqrt();
        let rows = &result.history;
        let mean = |middle: f64| {
            let near = rows.iter().filter(|row| (row.time_s - middle).abs() <= 0.5 * span);
            let forces: Vec<_> = near.map(|row| row.force).collect();
            forces.iter().sum::<f64>() / forces.len() as f64
        };
        let largest = rows.iter().map(|row| mean(row.time_s)).fold(0.0, f64::max);
        println!("{holds} {told} {largest} {:?}", result.outcome.first_force_max);
        assert!(result.outcome.displacement_max.unwrap().value > 0.5);
        // The rest is that of the running mean.
        assert!(told >= 0.99 * holds, "{told} of {holds}, mean {largest}");
    }
}
