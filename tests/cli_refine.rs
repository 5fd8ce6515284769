//! `[grid] refine` through the command line: the same points after any interruption and for any number of
//! threads, resumed, bounded and told.

mod common;

use std::fs;
use std::path::Path;

use common::{SOFT, expect_code, run, write_file};
use serde_json::Value;

const SPRINGS: &str = "spring_stiffness_n_per_m = [1e2, 1e4, 1e6]";

fn study(refine: &str) -> String {
    format!("{SOFT}{SPRINGS}\nrefine = {{ {refine} }}\n")
}

fn sweep(file: &Path, out: &Path, more: &[&str]) -> std::process::Output {
    let command = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    run(&[&command[..], &["--format", "json"], more].concat())
}

fn json(output: &std::process::Output) -> Value {
    expect_code(output, 0);
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The summary without the wall time.
fn summary(out: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let timed = reader.headers().unwrap().iter().position(|name| name == "wall_time_s").unwrap();
    let cells = |row: csv::StringRecord| {
        let cells = row.iter().enumerate().filter(|(place, _)| *place != timed);
        cells.map(|(_, cell)| cell.to_owned()).collect()
    };
    reader.records().map(|row| cells(row.unwrap())).collect()
}

fn stiffnesses(rows: &[Vec<String>]) -> Vec<f64> {
    rows.iter().map(|row| row[4].parse().unwrap()).collect()
}

#[test]
fn points_are_added_where_the_curve_bends_and_come_again_after_an_interruption() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), &study("quantity = \"first_force_max\", to = 0.05"));
    let whole = root.path().join("whole");
    let told = json(&sweep(&file, &whole, &["--threads", "2"]));
    let refined = &told["refined"];
    let added = refined["added"].as_u64().unwrap();
    assert!(added > 0 && refined["limit_hit"] == false, "{refined}");
    let rows = summary(&whole);
    assert_eq!(rows.len() as u64, 3 + added);
    let values = stiffnesses(&rows);
    assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "in the grid's order: {values:?}");
    assert!((values[1] / 1e2).log10() < 2.0);

    // The grid alone first, as if it had been stopped there; then the same file.
    let parts = root.path().join("parts");
    let plain = write_file(root.path(), &format!("{SOFT}{SPRINGS}\n"));
    expect_code(&sweep(&plain, &parts, &["--threads", "1"]), 0);
    assert_eq!(summary(&parts).len(), 3);
    let file = write_file(root.path(), &study("quantity = \"first_force_max\", to = 0.05"));
    json(&sweep(&file, &parts, &["--threads", "1"]));
    assert_eq!(summary(&parts), rows);
    // A last round of which a case is lost: its line and its file.
    let journal = fs::read_to_string(parts.join("journal.jsonl")).unwrap();
    let shorter = journal.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(parts.join("journal.jsonl"), format!("{shorter}\n")).unwrap();
    let status = run(&["status", parts.to_str().unwrap(), "--format", "json"]);
    let status = json(&status);
    assert_eq!((status["cases"].as_u64(), status["left"].as_u64()), (Some(3 + added), Some(1)));
    json(&sweep(&file, &parts, &[]));
    assert_eq!(summary(&parts), rows);
    // All commands know the added points.
    expect_code(&run(&["verify", parts.to_str().unwrap(), "--rerun", "2"]), 0);
    expect_code(&run(&["report", parts.to_str().unwrap()]), 0);
    assert_eq!(summary(&parts), rows);
    let text = run(&["status", parts.to_str().unwrap()]);
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(text.contains(&format!("{} of {} cases done", 3 + added, 3 + added)), "{text}");
}

#[test]
fn a_most_of_points_is_kept_to_and_told() {
    let root = tempfile::tempdir().unwrap();
    let refine = "quantity = \"first_force_max\", to = 1e-6, most = 1";
    let file = write_file(root.path(), &study(refine));
    let output = run(&["check", file.to_str().unwrap()]);
    expect_code(&output, 0);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("refine              adds up to 1 points, round by round"), "{text}");
    let out = root.path().join("out");
    let dry = run(&["sweep", file.to_str().unwrap(), "--dry-run"]);
    assert_eq!(dry.stdout, output.stdout);
    let told = json(&sweep(&file, &out, &[]));
    assert_eq!(
        (&told["refined"]["added"], &told["refined"]["limit_hit"]),
        (&1.into(), &true.into())
    );
    let human = run(&["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    let text = String::from_utf8_lossy(&human.stdout).into_owned();
    assert!(text.contains("grid.refine.most = 1 points were added: no more are allowed"), "{text}");
    assert!(text.contains("1 point added where first_force_max bends"), "{text}");
}

#[test]
fn bad_refinements_are_refused() {
    let root = tempfile::tempdir().unwrap();
    let refused = |text: &str, more: &[&str]| {
        let file = write_file(root.path(), text);
        let output = run(&[&["check", file.to_str().unwrap()], more].concat());
        expect_code(&output, 2);
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    for (refine, message) in [
        ("quantity = \"displacement_mx\", to = 0.02", "did you mean displacement_max?"),
        (
            "quantity = \"wall_time_s\", to = 1",
            "grid.refine.quantity = \"wall_time_s\": must be one of",
        ),
        ("quantity = \"force_max\"", "grid.refine.to"),
        ("quantity = \"force_max\", to = 0", "grid.refine.to = 0: must be a finite number above 0"),
        ("quantity = \"force_max\", to = 0.1, most = 0", "grid.refine.most = 0: must be"),
        (
            "quantity = \"force_max\", to = 0.1, mots = 3",
            "grid.refine.mots: unknown key; did you mean most?",
        ),
    ] {
        let told = refused(&study(refine), &[]);
        assert!(told.contains(message), "{told}");
    }
    let told = refused(&format!("{SOFT}{SPRINGS}\nrefine = 3\n"), &[]);
    assert!(told.contains("grid.refine = 3: must be {"), "{told}");
    let text = study("quantity = \"force_max\", to = 0.1");
    let told = refused(&text.replace("[1e2, 1e4, 1e6]", "[1e2, 1e6, 1e4]"), &[]);
    assert!(told.contains("must rise or fall from value to value"), "{told}");
    let told = refused(&text, &["--set", "accuracy.max_error_percent=2"]);
    assert!(told.contains("cannot stand beside grid.refine"), "{told}");
    let file = write_file(root.path(), &text);
    let out = root.path().join("out");
    let output = sweep(&file, &out, &["--max-error", "2"]);
    expect_code(&output, 2);
    assert!(!out.exists());
}

#[test]
fn whole_numbers_get_whole_numbers_between_and_no_more_is_told_than_is_known() {
    let root = tempfile::tempdir().unwrap();
    let study = |values: &str| {
        format!(
            "name = \"waves\"\n[scene]\nkind = \"standing-wave\"\nend_after_periods = 0.5\n\
             [numerics]\nparticle_spacing_m = 0.05\n[grid]\nhalf_waves = {values}\n\
             refine = {{ quantity = \"runup_max\", to = 1e-9 }}\n"
        )
    };
    let out = root.path().join("out");
    let told = sweep(&write_file(root.path(), &study("[1, 4]")), &out, &[]);
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let place = reader.headers().unwrap().iter().position(|name| name == "half_waves").unwrap();
    let values: Vec<_> = reader.records().map(|row| row.unwrap()[place].to_owned()).collect();
    assert_eq!(values, ["1", "2", "3", "4"]);
    // Nothing is left between them, and the curve still bends.
    let refined = &json(&told)["refined"];
    assert_eq!((&refined["added"], &refined["open_intervals"]), (&2.into(), &3.into()));

    // Two neighbours alone: no third point says how the curve bends, and none can be had.
    let out = root.path().join("two");
    let file = write_file(root.path(), &study("[1, 2]"));
    let told = run(&["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    let told = String::from_utf8(told.stdout).unwrap();
    assert!(told.contains("in all but 1 interval, of which no third point tells"), "{told}");
}
