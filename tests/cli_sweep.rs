//! The program itself, on threads: exit codes, bad input, interruption, the same bits every way.

mod common;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use common::{TINY, TINY_CASES, assert_same, expect_code, journal_lines, run, seawall, write_file};

fn sweep(file: &Path, out: &Path, further: &[&str]) -> std::process::Output {
    let mut arguments = vec!["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    arguments.extend(["--film", "none"]);
    arguments.extend(further);
    run(&arguments)
}

fn directory() -> (tempfile::TempDir, PathBuf) {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    (root, file)
}

#[test]
fn threads_and_branches_do_not_change_a_bit() {
    let (root, file) = directory();
    let reference = root.path().join("one");
    expect_code(&sweep(&file, &reference, &["--threads", "1"]), 0);
    assert_eq!(journal_lines(&reference), 1 + TINY_CASES);
    for further in [&["--threads", "2"][..], &["--threads", "4"], &["--no-branch"]] {
        let out = root.path().join(further.concat());
        expect_code(&sweep(&file, &out, further), 0);
        assert_same(&reference, &out);
    }
}

/// Kills a sweep three times, each time after another case, resumes it and compares.
fn kill_and_resume(file: &Path, reference: &Path, out: &Path) {
    for _ in 0..3 {
        let before = journal_lines(out);
        let mut child = seawall()
            .args(["sweep", "--quiet", "--threads", "1", "--film", "none", "--out"])
            .args([out, file])
            .spawn()
            .unwrap();
        let start = Instant::now();
        while journal_lines(out) < before.max(1) + 1
            && child.try_wait().unwrap().is_none()
            && start.elapsed() < Duration::from_secs(120)
        {
            std::thread::sleep(Duration::from_millis(2));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(journal_lines(out) > 1);
    expect_code(&sweep(file, out, &["--resume"]), 0);
    assert_same(reference, out);
}

#[test]
fn a_killed_sweep_resumes_to_the_same_bits() {
    let (root, file) = directory();
    let reference = root.path().join("reference");
    expect_code(&sweep(&file, &reference, &[]), 0);
    kill_and_resume(&file, &reference, &root.path().join("killed"));
}

#[test]
fn incompressible_water_has_the_same_bits_every_way() {
    let (root, file) = directory();
    let text = TINY
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.04\nscheme = \"isph\"")
        .replace("seawall_mass_kg_per_m = [50, 250]", "seawall_mass_kg_per_m = [5, 250]");
    std::fs::write(&file, text).unwrap();
    let reference = root.path().join("one");
    expect_code(&sweep(&file, &reference, &["--threads", "1"]), 0);
    assert_eq!(journal_lines(&reference), 1 + TINY_CASES);
    for further in [&["--threads", "2"][..], &["--no-branch"]] {
        let out = root.path().join(further.concat());
        expect_code(&sweep(&file, &out, further), 0);
        assert_same(&reference, &out);
    }
    kill_and_resume(&file, &reference, &root.path().join("killed"));
}

#[test]
fn a_signal_ends_a_sweep_with_a_whole_journal() {
    let (root, file) = directory();
    let (reference, out) = (root.path().join("reference"), root.path().join("stopped"));
    expect_code(&sweep(&file, &reference, &[]), 0);
    for signal in ["-INT", "-TERM", "-USR1"] {
        let before = journal_lines(&out);
        let mut child = seawall()
            .args(["sweep", "--quiet", "--threads", "1", "--film", "none", "--out"])
            .args([&out, &file])
            .spawn()
            .unwrap();
        while journal_lines(&out) < before.max(1) + 1 && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        let id = child.id().to_string();
        let sent = std::process::Command::new("kill").args([signal, &id]).status().unwrap();
        let code = child.wait().unwrap().code();
        // The sweep may have come to its end just before the signal.
        let finished = journal_lines(&out) == 1 + TINY_CASES;
        assert!(code == Some(3) || (finished && code == Some(0)), "{signal}: {code:?} {sent}");
    }
    expect_code(&sweep(&file, &out, &[]), 0);
    assert_same(&reference, &out);
}

#[test]
fn signals_close_to_one_another_are_one() {
    let root = tempfile::tempdir().unwrap();
    let text = "name = \"long\"\n[numerics]\nparticle_spacing_m = 0.005\n\
                [grid]\nwave_height_ratio = [0.3]";
    let (file, out) = (common::write_file(root.path(), text), root.path().join("out"));
    let mut child = seawall()
        .args(["sweep", "--quiet", "--threads", "1", "--film", "none", "--out"])
        .args([&out, &file])
        .spawn()
        .unwrap();
    while !out.join("journal.jsonl").exists() {
        std::thread::sleep(Duration::from_millis(10));
    }
    // Less than a second of work is not worth a checkpoint.
    std::thread::sleep(Duration::from_millis(2500));
    // A terminal tells a program and what has started it, which passes it on.
    for _ in 0..2 {
        let id = child.id().to_string();
        assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    }
    assert_eq!(child.wait().unwrap().code(), Some(3));
    let kept = std::fs::read_dir(out.join("checkpoints")).map_or(0, Iterator::count);
    assert_eq!(kept, 1, "it stopped in good order");
}

#[test]
fn a_finished_sweep_is_not_run_again() {
    let (root, file) = directory();
    let out = root.path().join("out");
    expect_code(&sweep(&file, &out, &[]), 0);
    let journal = std::fs::read(out.join("journal.jsonl")).unwrap();
    let again = sweep(&file, &out, &[]);
    expect_code(&again, 0);
    assert!(String::from_utf8_lossy(&again.stderr).contains("is finished"));
    assert_eq!(std::fs::read(out.join("journal.jsonl")).unwrap(), journal);
    expect_code(&sweep(&file, &out, &["--fresh", "--set", "scene.force_coupling=0.4"]), 0);
    assert!(root.path().join("out.old-1").is_dir());
    let status = run(&["status", out.to_str().unwrap(), "--format", "json"]);
    expect_code(&status, 0);
    let status: serde_json::Value = serde_json::from_slice(&status.stdout).unwrap();
    assert_eq!(status["ok"], TINY_CASES);
}

#[test]
fn a_single_scene_runs_by_itself() {
    let (root, file) = directory();
    let text = TINY.split("[grid]").next().unwrap();
    std::fs::write(&file, text.replace("movable", "fixed")).unwrap();
    let out = root.path().join("out");
    let done = run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    expect_code(&done, 0);
    let told = String::from_utf8_lossy(&done.stdout);
    assert!(told.contains("paddle work") && told.contains("residual"), "{told}");
    assert_eq!(std::fs::read_dir(out.join("histories")).unwrap().count(), 1);
}

#[test]
fn check_and_dry_run_write_nothing() {
    let (root, file) = directory();
    let out = root.path().join("out");
    let checked = run(&["check", file.to_str().unwrap(), "--format", "json"]);
    expect_code(&checked, 0);
    let told: serde_json::Value = serde_json::from_slice(&checked.stdout).unwrap();
    assert_eq!(told["cases"].as_array().unwrap().len(), TINY_CASES);
    assert_eq!(told["trunks"], 2);
    expect_code(&sweep(&file, &out, &["--dry-run"]), 0);
    assert!(!out.exists());
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
        "grid.spring_stiffness_n_per_m = 1: belongs to wall = \"movable\"",
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
    for (text, further, message) in BAD {
        let root = tempfile::tempdir().unwrap();
        let file = write_file(root.path(), text);
        let out = root.path().join("out");
        let output = sweep(&file, &out, further);
        expect_code(&output, 2);
        let told = String::from_utf8(output.stderr).unwrap();
        let expected = format!("error: {}: {message}", file.display());
        assert!(told.starts_with(&expected), "{told:?} should start with {expected:?}");
        assert_eq!(told.lines().count(), 1, "{told:?}");
        assert!(!out.exists());
    }
}

#[test]
fn bad_usage_has_exit_code_two() {
    let (root, file) = directory();
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let out = out.to_str().unwrap();
    let missing = root.path().join("missing.toml");
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
        &["sweep", file, "--out", root.path().to_str().unwrap()],
    ];
    for arguments in bad {
        expect_code(&run(arguments), 2);
    }
    assert!(!Path::new(out).exists());
}

#[test]
fn another_sweeps_directory_is_refused() {
    let (root, file) = directory();
    let out = root.path().join("out");
    expect_code(&sweep(&file, &out, &[]), 0);
    let other = sweep(&file, &out, &["--set", "scene.force_coupling=0.4"]);
    expect_code(&other, 2);
    assert!(String::from_utf8_lossy(&other.stderr).contains("holds another sweep"));
}

#[test]
fn copies_under_a_launcher_are_refused_once() {
    let (root, file) = directory();
    let out = root.path().join("out");
    for (rank, code, lines) in [("0", 2, 1), ("1", 0, 0)] {
        let output = seawall()
            .args(["sweep", "--executor", "threads", "--out"])
            .args([&out, &file])
            .env("OMPI_COMM_WORLD_SIZE", "2")
            .env("OMPI_COMM_WORLD_RANK", rank)
            .output()
            .unwrap();
        expect_code(&output, code);
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), lines);
        assert!(!out.exists());
    }
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let (_root, file) = directory();
    let mut child = seawall()
        .args(["check", "-v", file.to_str().unwrap()])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

/// The process holds less of each case than the journal: JSON has all of it nevertheless.
#[test]
fn json_has_the_whole_record_of_every_case() {
    let (root, file) = directory();
    let out = root.path().join("out");
    for _ in 0..2 {
        let output = sweep(&file, &out, &["--format", "json"]);
        expect_code(&output, 0);
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
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
