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

/// `check` told default numerics with the ids and the cost of other cases than those that the sweep then had.
#[test]
fn check_chooses_numerics_for_a_wanted_error_as_sweep_does() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[10, 1e4]", "[10]");
    let text = text.replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.02");
    let file = write_file(root.path(), &text);
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let told = |arguments: &[&str]| {
        let output = run(&[arguments, &["--format", "json"]].concat());
        expect_code(&output, 0);
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    let checked = told(&["check", file, "--max-error", "60"]);
    assert_eq!(checked["max_error_percent"], 60.0);
    assert_eq!(checked["companions"], 2);
    assert_ne!(checked["cases"], told(&["check", file])["cases"]);
    assert_eq!(checked, told(&["sweep", file, "--dry-run", "--max-error", "60"]));
    expect_code(&run(&["sweep", file, "--max-error", "60", "--out", out.to_str().unwrap()]), 0);
    let table = fs::read_to_string(out.join("max_error.csv")).unwrap();
    let swept: Vec<_> = table.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    let cases = checked["cases"].as_array().unwrap().iter();
    assert_eq!(cases.map(|case| case["id"].as_str().unwrap()).collect::<Vec<_>>(), swept);

    fs::write(file, text.replace("[grid]", "[accuracy]\nmax_error_percent = 60\n[grid]")).unwrap();
    assert_eq!(checked, told(&["check", file]));
    let words = run(&["check", file]);
    let notes = String::from_utf8_lossy(&words.stderr).into_owned();
    assert!(notes.contains("the cheapest that is expected to be within 60 %"), "{notes}");
    let words = String::from_utf8_lossy(&words.stdout).into_owned();
    assert!(words.contains("\nmax error           60 %: these are the numerics that"), "{words}");
    assert!(words.contains(" with what runs again, without films\n"), "{words}");
    let seconds =
        ["estimated_time_s", "longest_time_s"].map(|name| checked[name].as_f64().unwrap());
    assert!(seconds[1] > 5.0 * seconds[0], "{seconds:?}");

    // A single scene runs as it is.
    let scene = "name = \"a\"\n[accuracy]\nmax_error_percent = 60";
    fs::write(file, scene).unwrap();
    let warned = told(&["check", file])["warnings"].to_string();
    assert!(warned.contains("accuracy.max_error_percent = 60: only `seawall sweep`"), "{warned}");
    let refused = run(&["check", file, "--max-error", "2"]);
    expect_code(&refused, 2);
    let words = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(words.contains("--max-error 2: chooses the numerics of a sweep"), "{words}");
}
