//! The program under mpirun: the same bits as on threads, whatever the number of ranks.
#![cfg(feature = "mpi")]

mod common;

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use common::{TINY, TINY_CASES, assert_same, expect_code, journal_lines, run, write_file};

/// `mpirun` as it works for root, in a container, with more ranks than cores.
fn mpirun(ranks: usize) -> Command {
    let mut command = Command::new("mpirun");
    command
        .args(["-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none"])
        .arg(env!("CARGO_BIN_EXE_seawall"))
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .env("OMPI_MCA_btl_vader_single_copy_mechanism", "none");
    command
}

/// False, with a line that says so, where there is no mpirun.
fn mpirun_is_there() -> bool {
    let there = Command::new("mpirun").arg("--version").output().is_ok();
    if !there {
        println!("skipped: no mpirun");
    }
    there
}

fn reference(root: &Path, file: &Path) -> std::path::PathBuf {
    let out = root.join("reference");
    let arguments = ["sweep", "--out", out.to_str().unwrap(), file.to_str().unwrap()];
    expect_code(&run(&arguments), 0);
    out
}

#[test]
fn any_number_of_ranks_gives_the_same_bits() {
    if !mpirun_is_there() {
        return;
    }
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    let reference = reference(root.path(), &file);
    for ranks in [1, 2, 4] {
        let out = root.path().join(format!("ranks-{ranks}"));
        let output = mpirun(ranks).args(["sweep", "--out"]).args([&out, &file]).output().unwrap();
        expect_code(&output, 0);
        assert_same(&reference, &out);
    }
    let out = root.path().join("threads-2");
    let output = mpirun(2)
        .args(["sweep", "--threads", "2", "--no-branch", "--film", "none", "--out"])
        .args([&out, &file])
        .output()
        .unwrap();
    expect_code(&output, 0);
    assert_same(&reference, &out);
}

#[test]
fn an_interrupted_job_goes_on_with_another_number_of_ranks() {
    if !mpirun_is_there() {
        return;
    }
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    let reference = reference(root.path(), &file);
    for signal in ["-USR1", "-KILL"] {
        let out = root.path().join(signal);
        let mut child = mpirun(2)
            .args(["sweep", "--quiet", "--film", "none", "--out"])
            .args([&out, &file])
            .spawn()
            .unwrap();
        let start = Instant::now();
        while journal_lines(&out) < 2 && start.elapsed() < Duration::from_secs(120) {
            std::thread::sleep(Duration::from_millis(2));
        }
        let id = child.id().to_string();
        Command::new("kill").args([signal, &id]).status().unwrap();
        let code = child.wait().unwrap().code();
        if signal == "-USR1" && journal_lines(&out) < 1 + TINY_CASES {
            assert_eq!(code, Some(3));
        }
        // Ranks whose mpirun was killed may live on for a moment; the lock waits for them.
        let output = mpirun(3)
            .args(["sweep", "--film", "none", "--out"])
            .args([&out, &file])
            .output()
            .unwrap();
        expect_code(&output, 0);
        assert_same(&reference, &out);
    }
}

/// Two walls behind a shared stretch, which take a second or so each.
const LONG: &str = r#"
name = "long"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.5
wall = "movable"
seawall_mass_kg_per_m = 50
[numerics]
particle_spacing_m = 0.01
[grid]
wave_height_ratio = [0.3, 0.5]
spring_stiffness_n_per_m = [10, 1e4]
"#;

#[test]
fn ranks_take_up_the_cases_of_ranks_that_were_killed() {
    if !mpirun_is_there() {
        return;
    }
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), LONG);
    let reference = reference(root.path(), &file);
    let out = root.path().join("out");
    let often =
        ["sweep", "--checkpoint-every-s", "0.05", "--threads", "1", "--film", "none", "--out"];
    let mut told = String::new();
    for (ranks, checkpoints) in [(3, 2), (2, 1), (4, usize::MAX)] {
        let mut command = mpirun(ranks);
        let child = command.args(often).args([&out, &file]);
        let mut child = child.stderr(std::process::Stdio::piped()).spawn().unwrap();
        let start = Instant::now();
        let cases = || {
            let entries =
                std::fs::read_dir(out.join("checkpoints")).into_iter().flatten().flatten();
            entries.filter(|entry| entry.path().extension().is_some_and(|it| it == "case")).count()
        };
        while cases() < checkpoints && child.try_wait().unwrap().is_none() {
            assert!(start.elapsed() < Duration::from_secs(120), "no checkpoints");
            std::thread::sleep(Duration::from_millis(2));
        }
        let _ = child.kill();
        let output = child.wait_with_output().unwrap();
        told = String::from_utf8_lossy(&output.stderr).into_owned();
        std::thread::sleep(Duration::from_millis(500));
    }
    assert!(told.contains("checkpoint"), "{told}");
    assert_same(&reference, &out);
    assert!(!out.join("checkpoints").exists());
}

#[test]
fn only_rank_zero_speaks() {
    if !mpirun_is_there() {
        return;
    }
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), "name = \"a\"\n");
    let out = root.path().join("out");
    for executor in ["auto", "threads"] {
        let output = mpirun(3)
            .args(["sweep", "--executor", executor, "--out"])
            .args([&out, &file])
            .output()
            .unwrap();
        expect_code(&output, 2);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(told.matches("error: ").count(), 1, "{told}");
        assert!(!out.exists());
    }
}
