//! `accuracy`, `stress` and `--max-error` from outside: files, exit codes, resuming.

mod common;

use std::fs;

use common::{TINY, expect_code, journal_lines, run, write_file};

/// A short tank at rest and a wave in it, with two methods of which one is unknown.
const MATRIX: &str = r#"
name = "tiny_matrix"
[[case]]
name = "still"
about = "water at rest"
quick = true
scene = { wave_height_ratio = 0.0, end_time_s = 0.5, tank_length_m = 1.0, wave_gauge_m = 0.5 }
numerics = { particle_spacing_m = 0.04 }
truth = { force_end = 1.0, runup_end = 0.0 }
pass = { force_end = [0.9, 1.1] }
[[case]]
name = "impossible"
about = "water at rest that is asked to press twice as hard"
scene = { wave_height_ratio = 0.0, end_time_s = 0.5, tank_length_m = 1.0, wave_gauge_m = 0.5 }
numerics = { particle_spacing_m = 0.05 }
pass = { force_end = [1.9, 2.1] }
[[method]]
name = "default"
quick = true
[[method]]
name = "unknown"
numerics = { kernel = "no-such-kernel" }
"#;

#[test]
fn stress_judges_by_the_criteria_and_resumes() {
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), MATRIX), root.path().join("out"));
    let command = ["stress", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    expect_code(&run(&command), 1);
    let lines = journal_lines(&out);
    let again = run(&[&command[..], &["--format", "json"]].concat());
    expect_code(&again, 1);
    assert_eq!(journal_lines(&out), lines, "nothing is run twice");
    let told: serde_json::Value = serde_json::from_slice(&again.stdout).unwrap();
    let verdicts: Vec<_> = told["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["verdict"].as_str().unwrap())
        .collect();
    assert_eq!(verdicts, ["passed", "not-there", "missed", "not-there"]);
    let page = fs::read_to_string(out.join("stress.md")).unwrap();
    assert!(page.contains("Criterion: force_end in [1.9, 2.1]"), "{page}");
    let quick = root.path().join("quick");
    let quiet =
        run(&["stress", command[1], "--quick", "--quiet", "--out", quick.to_str().unwrap()]);
    expect_code(&quiet, 0);
    assert!(quiet.stdout.is_empty());
}

#[test]
fn accuracy_writes_its_table_figure_and_page() {
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), MATRIX), root.path().join("out"));
    expect_code(
        &run(&["accuracy", file.to_str().unwrap(), "--quick", "--out", out.to_str().unwrap()]),
        0,
    );
    let table = fs::read_to_string(out.join("accuracy.csv")).unwrap();
    assert!(table.lines().any(|line| line.starts_with("all,default,")), "{table}");
    assert!(
        out.join("accuracy.md").is_file() && out.join("figures/error-against-time.svg").is_file()
    );
}

#[test]
fn what_is_no_matrix_is_refused() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    for command in ["accuracy", "stress"] {
        let output = run(&[command, file.to_str().unwrap()]);
        expect_code(&output, 2);
        assert!(String::from_utf8_lossy(&output.stderr).contains("sweep.toml"));
    }
}

#[test]
fn a_wanted_error_is_chosen_for_verified_and_told() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[10, 1e4]", "[10]");
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let (file, out) = (file.to_str().unwrap(), out.to_str().unwrap());
    let sweep = |error: &str| run(&["sweep", file, "--max-error", error, "--out", out]);
    expect_code(&sweep("0"), 2);
    expect_code(&sweep("60"), 0);
    let table = fs::read_to_string(root.path().join("out/max_error.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2);
    assert!(table.lines().skip(1).all(|line| line.ends_with(",60,true")), "{table}");
    expect_code(&sweep("50"), 2); // another sweep's directory
    let swept = text.replace("particle_spacing_m = 0.025\n", "");
    let swept = swept.replace("[grid]", "[grid]\nparticle_spacing_m = [0.02, 0.04]");
    fs::write(file, swept).unwrap();
    let told = run(&["sweep", file, "--max-error", "2", "--out", "nowhere"]);
    expect_code(&told, 2);
    assert!(String::from_utf8_lossy(&told.stderr).contains("[grid] sweeps it"));
}
