//! The program itself, on threads: exit codes, bad input, interruption, the same bits every way.

mod common;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Child;
use std::time::Duration;

use common::job::{signal, wait_until};
use common::{
    Desk, TINY, TINY_CASES, assert_same, column, ended, expect_code, journal_lines, seawall, sweep,
};
use seawall::scene::{Kind, scene_keys};

#[test]
fn threads_and_branches_do_not_change_a_bit() {
    let desk = Desk::new(TINY);
    let reference = desk.path().join("one");
    sweep(0, &desk.file, &reference, &["--threads", "1"]);
    assert_eq!(journal_lines(&reference), 1 + TINY_CASES);
    for further in [&["--threads", "2"][..], &["--threads", "4"], &["--no-branch"]] {
        let out = desk.path().join(further.concat());
        sweep(0, &desk.file, &out, further);
        assert_same(&reference, &out);
    }
}

/// Starts a sweep that runs one case at a time.
fn started(out: &Path, file: &str) -> Child {
    let mut command = seawall();
    command.args(["sweep", "--quiet", "--threads", "1", "--film", "none", "--out"]);
    command.arg(out).arg(file).spawn().unwrap()
}

/// Waits until its journal has one more line, and not only the header, or it has ended.
fn wait_for_next(out: &Path, before: usize, child: &mut Child) {
    wait_until("another case", || {
        journal_lines(out) > before.max(1) || child.try_wait().unwrap().is_some()
    });
}

/// Kills a sweep three times, each time after another case, resumes it and compares.
fn kill_and_resume(file: &str, reference: &Path, out: &Path) {
    for _ in 0..3 {
        let before = journal_lines(out);
        let mut child = started(out, file);
        wait_for_next(out, before, &mut child);
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(journal_lines(out) > 1);
    sweep(0, file, out, &["--resume"]);
    assert_same(reference, out);
}

#[test]
fn a_killed_sweep_resumes_to_the_same_bits() {
    let desk = Desk::new(TINY);
    let reference = desk.path().join("reference");
    sweep(0, &desk.file, &reference, &[]);
    kill_and_resume(&desk.file, &reference, &desk.path().join("killed"));
}

#[test]
fn incompressible_water_has_the_same_bits_every_way() {
    let desk = Desk::new(TINY);
    let text = TINY
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.04\nscheme = \"isph\"")
        .replace("seawall_mass_kg_per_m = [50, 250]", "seawall_mass_kg_per_m = [5, 250]");
    std::fs::write(&desk.file, text).unwrap();
    let reference = desk.path().join("one");
    sweep(0, &desk.file, &reference, &["--threads", "1"]);
    assert_eq!(journal_lines(&reference), 1 + TINY_CASES);
    for further in [&["--threads", "2"][..], &["--no-branch"]] {
        let out = desk.path().join(further.concat());
        sweep(0, &desk.file, &out, further);
        assert_same(&reference, &out);
    }
    kill_and_resume(&desk.file, &reference, &desk.path().join("killed"));
}

#[test]
fn a_signal_ends_a_sweep_with_a_whole_journal() {
    let desk = Desk::new(TINY);
    let (reference, out) = (desk.path().join("reference"), desk.path().join("stopped"));
    sweep(0, &desk.file, &reference, &[]);
    for name in ["INT", "TERM", "USR1"] {
        let before = journal_lines(&out);
        let mut child = started(&out, &desk.file);
        wait_for_next(&out, before, &mut child);
        signal(child.id(), name);
        let code = child.wait().unwrap().code();
        // The sweep may have come to its end just before the signal.
        let finished = journal_lines(&out) == 1 + TINY_CASES;
        assert!(code == Some(3) || (finished && code == Some(0)), "{name}: {code:?}");
    }
    sweep(0, &desk.file, &out, &[]);
    assert_same(&reference, &out);
}

#[test]
fn signals_close_to_one_another_are_one() {
    let text = "name = \"long\"\n[numerics]\nparticle_spacing_m = 0.005\n\
                [grid]\nwave_height_ratio = [0.3]";
    let Desk { file, out, .. } = &Desk::new(text);
    let mut child = started(out, file);
    wait_until("the journal", || out.join("journal.jsonl").exists());
    // Less than a second of work is not worth a checkpoint.
    std::thread::sleep(Duration::from_millis(2500));
    // A terminal tells a program and what has started it, which passes it on.
    for _ in 0..2 {
        assert!(signal(child.id(), "INT"));
    }
    assert_eq!(child.wait().unwrap().code(), Some(3));
    let kept = std::fs::read_dir(out.join("checkpoints")).map_or(0, Iterator::count);
    assert_eq!(kept, 1, "it stopped in good order");
}

#[test]
fn a_finished_sweep_is_not_run_again() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let journal = std::fs::read(desk.out.join("journal.jsonl")).unwrap();
    let again = sweep(0, &desk.file, &desk.out, &[]);
    assert!(again.err.contains("is finished"));
    assert_eq!(std::fs::read(desk.out.join("journal.jsonl")).unwrap(), journal);
    sweep(0, &desk.file, &desk.out, &["--fresh", "--set", "scene.force_coupling=0.4"]);
    assert!(desk.path().join("out.old-1").is_dir());
    let status = ended(0, &["status", &desk.dir, "--format", "json"]);
    let status: serde_json::Value = status.json();
    assert_eq!(status["ok"], TINY_CASES);
}

#[test]
fn a_single_scene_runs_by_itself() {
    let desk = Desk::new(TINY);
    let text = TINY.split("[grid]").next().unwrap();
    std::fs::write(&desk.file, text.replace("movable", "fixed")).unwrap();
    let told = ended(0, &["run", &desk.file, "--out", &desk.dir]).out;
    assert!(told.contains("paddle work") && told.contains("energy gap"), "{told}");
    assert_eq!(std::fs::read_dir(desk.out.join("histories")).unwrap().count(), 1);
}

#[test]
fn check_and_dry_run_write_nothing() {
    let desk = Desk::new(TINY);
    let told = ended(0, &["check", &desk.file, "--format", "json"]).json();
    assert_eq!(told["cases"].as_array().unwrap().len(), TINY_CASES);
    assert_eq!(told["trunks"], 2);
    sweep(0, &desk.file, &desk.out, &["--dry-run"]);
    assert!(!desk.out.exists());
}

/// Bad input, the arguments after the file, and what the error says after the file's name.
const BAD: &[(&str, &[&str], &str)] = &[
    ("name = \"a\"\n", &[], "grid: is required"),
    ("[grid]\nwave_height_ratio = [0.2]", &[], "name: is required"),
    ("name = \"a\"\n[grid]\n", &[], "grid: holds no key"),
    ("name = \"a\"\n[gird]\nx = [1]", &[], "gird: unknown key; did you mean grid?"),
    ("name = \"a\"\n[grid]\nwave_height_ratio = []", &[], "grid.wave_height_ratio = []: must"),
    (
        "name = \"a\"\n[grid]\nwave_height_ratio = [0.2, nan]",
        &[],
        "grid.wave_height_ratio = nan: must be a finite",
    ),
    (
        "name = \"a\"\n[grid]\nwave_height_ratio = [0.2, 0.2]",
        &[],
        "grid.wave_height_ratio = 0.2: stands in the list twice",
    ),
    (
        "name = \"a\"\n[grid]\nwave_height_ratios = [0.2]",
        &[],
        "grid.wave_height_ratios: unknown key; did you mean wave_height_ratio?",
    ),
    (
        "name = \"a\"\n[numerics]\nparticle_spacing_m = -1\n[grid]\nwave_height_ratio = [0.2]",
        &[],
        "numerics.particle_spacing_m = -1: must be",
    ),
    (
        "name = \"a\"\n[grid]\nspring_stiffness_n_per_m = [1]",
        &[],
        "grid.spring_stiffness_n_per_m = 1: belongs to {walls with springs}",
    ),
    (TINY, &["--set", "numerics.kernel=gauss"], "numerics.kernel = \"gauss\": must be one of wend"),
    (
        TINY,
        &["--set", "particle_spacing_m=0.02"],
        "particle_spacing_m: unknown key; did you mean numerics.particle_spacing_m?",
    ),
    (
        TINY,
        &["--set", "numerics.particle_spacing_m=0.00001"],
        "numerics.particle_spacing_m = 0.00001: would cut 0.2 m² of water into 2,000,000,000 particles",
    ),
    (
        TINY,
        &["--set", "scene.wave_height_ratio=0.3"],
        "scene.wave_height_ratio = 0.3: [grid] sweeps this key",
    ),
    (TINY, &["--set", "grid.wave_height_ratio=0.3"], "grid.wave_height_ratio = 0.3: must be a"),
    ("name = \"a\nx", &[], "line "),
];

#[test]
fn bad_input_is_told_in_one_line_and_nothing_is_written() {
    let keys = scene_keys(Kind::Seawall);
    let spring = keys.iter().find(|key| key.name == "spring_stiffness_n_per_m").unwrap();
    let springs = spring.rule.only.unwrap().to_string();
    for (text, further, message) in BAD {
        let message = message.replace("{walls with springs}", &springs);
        let desk = Desk::new(text);
        let told = sweep(2, &desk.file, &desk.out, further).err;
        let expected = format!("error: {}: {message}", desk.file);
        assert!(told.starts_with(&expected), "{told:?} should start with {expected:?}");
        assert_eq!(told.lines().count(), 1, "{told:?}");
        assert!(!desk.out.exists());
    }
}

#[test]
fn bad_usage_has_exit_code_two() {
    let desk = Desk::new(TINY);
    let (file, out) = (desk.file.as_str(), desk.dir.as_str());
    let missing = desk.path().join("missing.toml");
    let bad: &[&[&str]] = &[
        &[],
        &["swep", file],
        &["sweep"],
        &["sweep", missing.to_str().unwrap()],
        &["sweep", file, "--threads", "0"],
        &["sweep", file, "--resume", "--fresh"],
        &["sweep", file, "--set", "kernel"],
        &["sweep", file, "--executor", "carrier-pigeon"],
        &["run", file, "--out", out],
        &["status", out],
        &["report", out],
        &["sweep", file, "--out", desk.path().to_str().unwrap()],
    ];
    for arguments in bad {
        ended(2, arguments);
    }
    assert!(!Path::new(out).exists());
}

#[test]
fn another_sweeps_directory_is_refused() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let other = sweep(2, &desk.file, &desk.out, &["--set", "scene.force_coupling=0.4"]);
    assert!(other.err.contains("holds another sweep"));
    // The story: who had edited the file was not told what was another.
    std::fs::write(&desk.file, TINY.replace("[0.4, 0.5]", "[0.4, 0.5, 0.6]")).unwrap();
    let edited = sweep(2, &desk.file, &desk.out, &[]);
    let key = "grid.wave_height_ratio is [0.4, 0.5] there and [0.4, 0.5, 0.6] here";
    let told = format!("holds another sweep (\"tiny\", 8 cases): {key}; ");
    assert!(edited.err.contains(&told), "{}", edited.err);
    // Nor who had set a key on the command line, and did not set it again.
    let set = ["--set", "grid.wave_height_ratio=[0.4]"];
    sweep(0, &desk.file, &desk.out, &[&set[..], &["--fresh"]].concat());
    let without = sweep(2, &desk.file, &desk.out, &[]);
    let told = "cases): it was made with --set grid.wave_height_ratio=[0.4]; choose another --out";
    assert!(without.err.contains(told), "{}", without.err);
}

#[test]
fn copies_under_a_launcher_are_refused_once() {
    let desk = Desk::new(TINY);
    for (rank, code, lines) in [("0", 2, 1), ("1", 0, 0)] {
        let output = seawall()
            .args(["sweep", "--executor", "threads", "--out"])
            .args([&desk.dir, &desk.file])
            .env("OMPI_COMM_WORLD_SIZE", "2")
            .env("OMPI_COMM_WORLD_RANK", rank)
            .output()
            .unwrap();
        expect_code(&output, code);
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), lines);
        assert!(!desk.out.exists());
    }
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let desk = Desk::new(TINY);
    let mut child = seawall()
        .args(["check", "-v", &desk.file])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

/// The process holds less of each case than the journal: JSON has all of it nevertheless.
#[test]
fn json_has_the_whole_record_of_every_case() {
    let desk = Desk::new(TINY);
    for _ in 0..2 {
        let told = sweep(0, &desk.file, &desk.out, &["--format", "json"]).json();
        let records = told["records"].as_array().unwrap();
        assert_eq!(records.len(), TINY_CASES);
        for record in records {
            assert!(!record["values"].as_object().unwrap().is_empty(), "{record}");
            assert!(!record["files"].as_object().unwrap().is_empty(), "{record}");
            assert!(!record["phases"].as_array().unwrap().is_empty(), "{record}");
            assert!(!record["host"].as_str().unwrap().is_empty(), "{record}");
        }
    }
}

/// As docs/files.md tells who gives each job of an array a part of the grid.
#[test]
fn parts_of_a_grid_have_the_rows_of_the_whole() {
    let desk = Desk::new(TINY);
    let rows = |out: &Path| {
        let ids = column(out, "case_id");
        let forces = column(out, "force_max");
        ids.into_iter().zip(forces).collect::<BTreeMap<_, _>>()
    };
    sweep(0, &desk.file, &desk.out, &[]);
    let mut parts = BTreeMap::new();
    for wave in ["0.4", "0.5"] {
        let (out, set) = (desk.path().join(wave), format!("grid.wave_height_ratio=[{wave}]"));
        sweep(0, &desk.file, &out, &["--set", &set]);
        parts.extend(rows(&out));
    }
    assert_eq!(parts.len(), 8);
    assert_eq!(parts, rows(&desk.out));
}
