//! What the launcher makes of the ranks: its exit codes, and another MPI's launcher.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::job::{LONG, is_mpich, kill_all, mpirun, room, signal, wait_for_lines};
use crate::common::{TINY, expect_code, run, seawall, write_file};

/// `mpirun` itself may return 1 then, which otherwise says that some case failed.
#[test]
fn who_ends_the_launcher_is_told_what_its_exit_code_means() {
    let Some((root, file)) = room(LONG) else { return };
    let out = root.path().join("out");
    let mut command = mpirun(2);
    let child = command.args(["sweep", "--threads", "1", "--film", "none", "--out"]);
    let child = child.arg(&out).arg(&file).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_lines(&out, 1);
    std::thread::sleep(Duration::from_millis(300));
    signal(child.id(), "INT");
    let output = child.wait_with_output().unwrap();
    // MPICH's launcher may return 0.
    assert!(is_mpich() || !output.status.success());
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = format!("seawall's own code is 3, as `seawall status {}", out.display());
    assert!(told.contains("the journal is whole. ") && told.contains(&code), "{told}");
    kill_all(&out);
    expect_code(&run(&["status", out.to_str().unwrap(), "--exit-code"]), 3);
}

/// The story: the line with the true code did not come where films were cut short.
#[test]
fn who_ends_the_launcher_in_the_films_is_told_the_true_code() {
    let text = LONG.replace("[0.3, 0.5]", "[0.5]").replace("[10, 1e4]", "[10]");
    let Some((root, file)) = room(&text) else { return };
    let out = root.path().join("out");
    let mut command = mpirun(2);
    let child = command.args(["sweep", "--threads", "1", "--out"]).arg(&out).arg(&file);
    let mut child = child.stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map_while(Result::ok);
    assert!(lines.any(|line| line.contains("filming 1 case")));
    signal(child.id(), "USR1");
    let told: Vec<_> = lines.collect();
    let code = child.wait().unwrap().code();
    assert!(is_mpich() || code == Some(3), "{code:?}");
    let last = told.iter().rfind(|line| line.contains("the journal is whole. "));
    assert!(
        last.is_some_and(|line| line.contains("may return 0 or 1; seawall's own code is 3")),
        "{told:#?}"
    );
    expect_code(&run(&["status", out.to_str().unwrap(), "--exit-code"]), 3);
}

/// The story: under the launcher of another MPI each process took itself for the whole job, and a job script came back
/// for ever.
#[test]
fn a_launcher_of_another_mpi_is_refused() {
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), TINY), root.path().join("out"));
    let sweep = |command: &mut Command| {
        let output = command.args(["sweep", "--out"]).arg(&out).arg(&file).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let wanted = "error: the launcher started 2 processes, but this program's MPI sees 1: ";
        assert_eq!(told.matches(wanted).count(), 1, "{told}");
        assert!(!out.exists());
        output
    };
    // As `srun` does with the wrong --mpi.
    let step = |rank: &str| {
        let mut command = seawall();
        command.env("SLURM_STEP_NUM_TASKS", "2").env("SLURM_PROCID", rank);
        command
    };
    expect_code(&sweep(&mut step("0")), 2);
    let other = if is_mpich() { "mpirun.openmpi" } else { "mpirun.mpich" };
    let mut command = Command::new(other);
    if command.arg("--version").output().is_ok() {
        let mut command = Command::new(other);
        command.args(["-n", "2", env!("CARGO_BIN_EXE_seawall")]);
        command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
        sweep(&mut command);
    }
    // A shell within an allocation has no step.
    let mut command = seawall();
    command
        .env("SLURM_NTASKS", "2")
        .env("SLURM_PROCID", "0")
        .args(["sweep", "--film", "none", "--out"]);
    expect_code(&command.arg(&out).arg(&file).output().unwrap(), 0);
}
