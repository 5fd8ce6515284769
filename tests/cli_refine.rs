//! `[grid] refine` through the command line: the same points after any interruption and for any number of
//! threads, resumed, bounded and told.

use std::fs;
use std::path::Path;

use crate::common::{Desk, SOFT, column, ended, write_file};
use serde_json::Value;

const SPRINGS: &str = "spring_stiffness_n_per_m = [1e2, 1e4, 1e6]";

fn study(refine: &str) -> String {
    format!("{SOFT}{SPRINGS}\nrefine = {{ {refine} }}\n")
}

/// What a sweep tells a program.
fn sweep(file: &str, out: &Path, more: &[&str]) -> Value {
    let command = ["sweep", file, "--out", out.to_str().unwrap(), "--format", "json"];
    ended(0, &[&command[..], more].concat()).json()
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
    let told = sweep(&file, &whole, &["--threads", "2"]);
    let refined = &told["refined"];
    let added = refined["added"].as_u64().unwrap();
    assert!(added > 0 && refined["limit_hit"] == false, "{refined}");
    // The time of all rounds: it was that of the last.
    let manifest: Value =
        serde_json::from_str(&fs::read_to_string(whole.join("manifest.json")).unwrap()).unwrap();
    let rounds = manifest["sessions"].as_array().unwrap();
    let spent_s: f64 = rounds.iter().map(|round| round["wall_time_s"].as_f64().unwrap()).sum();
    assert!(rounds.len() > 1);
    assert!((told["wall_time_s"].as_f64().unwrap() - spent_s).abs() < 1e-6, "{told}");
    let rows = summary(&whole);
    assert_eq!(rows.len() as u64, 3 + added);
    let values = stiffnesses(&rows);
    assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "in the grid's order: {values:?}");
    assert!((values[1] / 1e2).log10() < 2.0);

    // The grid alone first, as if it had been stopped there; then the same file.
    let parts = root.path().join("parts");
    let plain = write_file(root.path(), &format!("{SOFT}{SPRINGS}\n"));
    sweep(&plain, &parts, &["--threads", "1"]);
    assert_eq!(summary(&parts).len(), 3);
    let file = write_file(root.path(), &study("quantity = \"first_force_max\", to = 0.05"));
    sweep(&file, &parts, &["--threads", "1"]);
    assert_eq!(summary(&parts), rows);
    // A last round of which a case is lost: its line and its file.
    let journal = fs::read_to_string(parts.join("journal.jsonl")).unwrap();
    let shorter = journal.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(parts.join("journal.jsonl"), format!("{shorter}\n")).unwrap();
    let status = ended(0, &["status", parts.to_str().unwrap(), "--format", "json"]).json();
    assert_eq!((status["cases"].as_u64(), status["left"].as_u64()), (Some(3 + added), Some(1)));
    sweep(&file, &parts, &[]);
    assert_eq!(summary(&parts), rows);
    // All commands know the added points.
    ended(0, &["verify", parts.to_str().unwrap(), "--rerun", "2"]);
    ended(0, &["report", parts.to_str().unwrap()]);
    assert_eq!(summary(&parts), rows);
    let text = ended(0, &["status", parts.to_str().unwrap()]).out;
    assert!(text.contains(&format!("{} of {} cases done", 3 + added, 3 + added)), "{text}");
}

#[test]
fn a_most_of_points_is_kept_to_and_told() {
    let refine = "quantity = \"first_force_max\", to = 1e-6, most = 1";
    let desk = Desk::new(&study(refine));
    let text = ended(0, &["check", &desk.file]).out;
    assert!(text.contains("refine              adds up to 1 point, round by round"), "{text}");
    assert_eq!(ended(0, &["sweep", &desk.file, "--dry-run"]).out, text);
    let told = sweep(&desk.file, &desk.out, &[]);
    assert_eq!(
        (&told["refined"]["added"], &told["refined"]["limit_hit"]),
        (&1.into(), &true.into())
    );
    let text = desk.sweep(&[]).out;
    assert!(text.contains("grid.refine.most = 1 is reached: no more are allowed"), "{text}");
    assert!(text.contains("1 point added where first_force_max bends"), "{text}");
}

#[test]
fn bad_refinements_are_refused() {
    let root = tempfile::tempdir().unwrap();
    let refused = |text: &str, more: &[&str]| {
        let file = write_file(root.path(), text);
        ended(2, &[&["check", &file], more].concat()).err
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
    ended(2, &["sweep", &file, "--out", out.to_str().unwrap(), "--max-error", "2"]);
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
    assert_eq!(column(&out, "half_waves"), ["1", "2", "3", "4"]);
    // Nothing is left between them, and the curve still bends.
    let refined = &told["refined"];
    assert_eq!((&refined["added"], &refined["open_intervals"]), (&2.into(), &3.into()));

    // Two neighbours alone: no third point says how the curve bends, and none can be had.
    let out = root.path().join("two");
    let file = write_file(root.path(), &study("[1, 2]"));
    let told = ended(0, &["sweep", &file, "--out", out.to_str().unwrap()]).out;
    assert!(told.contains("in all but 1 interval, of which no third point tells"), "{told}");
}

/// The story: points were spent on the steps of a volume that counts whole particles, or none were added between them.
#[test]
fn volumes_are_not_refined_below_a_few_particles_without_a_word() {
    let root = tempfile::tempdir().unwrap();
    let told = |to: f64| {
        let text = format!(
            "name = \"a\"\n[scene]\nbehind = \"outflow\"\ncrest_width_m = 0.1\n[numerics]\nparticle_spacing_m = 0.02\n\
             [grid]\ncrest_freeboard_m = [0.04, 0.08, 0.12]\n\
             refine = {{ quantity = \"overtopping_volume_m2\", to = {to} }}\n"
        );
        let file = write_file(root.path(), &text);
        let checked = ended(0, &["check", &file, "--format", "json"]).json();
        checked["warnings"]
            .to_string()
            .contains("a volume counts whole particles, here of up to 0.0004 m²")
    };
    assert_eq!([0.0005, 0.0015, 0.0017].map(told), [true, true, false]);
}
