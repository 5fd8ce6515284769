//! Regular waves: on their way against the theory of the full equations, and before a wall against its second
//! order; and what a train leaves of each of its waves.

mod common;
mod theory;

use common::{expect_code, run, write_file};
use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{Unwatched, WaveRow, run_case};
use theory::standing_wave_force::StandingWaveForce;
use theory::stream_function::StreamFunctionWave;
use toml::Table;

const DEPTH: f64 = 0.2;
const GRAVITY: f64 = 9.81;
const PERIOD: f64 = 1.0;

fn train(scene: &str) -> Vec<WaveRow> {
    let scene = format!("paddle = \"wave-train\"\nwave_period_s = {PERIOD}\n{scene}");
    let table = |text: &str| text.parse::<Table>().unwrap();
    let case = CaseConfig::with_probes(&table(&scene), &table("particle_spacing_m = 0.02"), &[]);
    run_case(&case.unwrap(), None, SimdPath::widest(), &Unwatched).unwrap().waves
}

fn mean(rows: &[WaveRow], of: impl Fn(&WaveRow) -> f64) -> f64 {
    rows.iter().map(of).sum::<f64>() / rows.len() as f64
}

/// Ten rows of particles, before the wall throws anything back.
#[test]
fn waves_on_their_way_are_those_of_stream_function_theory() {
    let rows =
        train("tank_length_m = 8\nwave_gauge_m = 2\nwave_height_ratio = 0.15\nend_time_s = 11\n");
    assert_eq!(rows.len(), 11);
    let rows = &rows[6..];
    let [crest, trough] = [0, 1].map(|n| mean(rows, |row| row.surface_m[n]));
    let theory = StreamFunctionWave::new(crest - trough, DEPTH, PERIOD, GRAVITY).unwrap();
    let [high, low] = theory.crest_and_trough();
    let harmonics = [0, 1].map(|n| mean(rows, |row| row.harmonics_m[n]));
    println!("crest {crest} {high}, trough {trough} {low}, harmonics {harmonics:?}");
    println!("{} {}", theory.harmonic(1), theory.harmonic(2));
    assert!(((crest - trough) / 0.03 - 1.0).abs() < 0.06);
    assert!((crest / high - 1.0).abs() < 0.05 && (trough / low - 1.0).abs() < 0.06);
    assert!((harmonics[0] / theory.harmonic(1) - 1.0).abs() < 0.03);
    assert!((harmonics[1] / theory.harmonic(2) - 1.0).abs() < 0.4);
}

/// What the wall bears before the paddle throws anything back.
#[test]
fn a_standing_wave_presses_the_wall_as_its_second_order_says() {
    let rows =
        train("tank_length_m = 4\nwave_gauge_m = 2\nwave_height_ratio = 0.1\nend_time_s = 10\n");
    let wavenumber = StreamFunctionWave::new(0.02, DEPTH, PERIOD, GRAVITY).unwrap().wavenumber();
    let theory = StandingWaveForce { amplitude: 0.02, depth: DEPTH, wavenumber, gravity: GRAVITY };
    let [largest, smallest] = theory.extremes();
    let [high, low] = [0, 1].map(|n| mean(&rows[6..], |row| row.force[n]));
    println!("F* {high} {largest}, {low} {smallest}");
    assert!((high / largest - 1.0).abs() < 0.02 && (low / smallest - 1.0).abs() < 0.02);
}

#[test]
fn each_wave_has_a_row_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = "name = \"few\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\npaddle = \"wave-train\"\n\
                wave_period_s = 1\nwave_height_ratio = 0.1\nend_time_s = 2.5\n[numerics]\n\
                particle_spacing_m = 0.025\n";
    let file = write_file(folder.path(), text);
    let out = folder.path().join("out");
    let output = run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    expect_code(&output, 0);
    let mut files = std::fs::read_dir(out.join("waves")).unwrap();
    let table = std::fs::read_to_string(files.next().unwrap().unwrap().path()).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines[0],
        "from_s,crest_m,trough_m,first_harmonic_m,second_harmonic_m,force_max,force_min,runup_max"
    );
    assert_eq!(lines.len(), 3, "two periods are whole: {table}");
    assert!(lines[1].starts_with("0,") && lines[2].starts_with("1,"));
    // A solitary wave has no periods.
    let text = text.replace("paddle = \"wave-train\"\nwave_period_s = 1\n", "");
    let file = write_file(folder.path(), &text);
    let out = folder.path().join("solitary");
    expect_code(&run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]), 0);
    assert!(!out.join("waves").exists());
}
