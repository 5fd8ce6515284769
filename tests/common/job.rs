//! Jobs of several processes: how one is started, who belongs to it, and how it is killed.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::{journal_lines, write_file};

/// The launcher: `mpirun`, or what `SEAWALL_MPIRUN` names, such as `mpirun.mpich`.
fn launcher() -> String {
    std::env::var("SEAWALL_MPIRUN").unwrap_or_else(|_| "mpirun".to_owned())
}

/// Whether the launcher is MPICH's. It loses exit codes.
pub fn is_mpich() -> bool {
    let told = Command::new(launcher()).arg("--version").output();
    told.is_ok_and(|told| String::from_utf8_lossy(&told.stdout).contains("HYDRA"))
}

/// `mpirun` as it works for root, in a container, with more ranks than cores.
pub fn mpirun(ranks: usize) -> Command {
    let mut command = Command::new(launcher());
    command.args(["-n", &ranks.to_string()]);
    if !is_mpich() {
        command.args(["--oversubscribe", "--bind-to", "none"]);
    }
    command
        .arg(env!("CARGO_BIN_EXE_seawall"))
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .env("OMPI_MCA_btl_vader_single_copy_mechanism", "none");
    command
}

/// False, with a line that says so, where there is no mpirun.
pub fn mpirun_is_there() -> bool {
    let there = Command::new(launcher()).arg("--version").output().is_ok();
    if !there {
        println!("skipped: no mpirun");
    }
    there
}

/// A folder with a sweep file for a job, and the file's path; none where there is no mpirun.
pub fn room(text: &str) -> Option<(TempDir, String)> {
    mpirun_is_there().then(|| {
        let root = tempfile::tempdir().unwrap();
        let file = write_file(root.path(), text);
        (root, file)
    })
}

/// Two walls behind a shared stretch, which take a few seconds each.
pub const LONG: &str = r#"
name = "long"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 3.0
wall = "movable"
seawall_mass_kg_per_m = 50
[numerics]
particle_spacing_m = 0.01
[grid]
wave_height_ratio = [0.3, 0.5]
spring_stiffness_n_per_m = [10, 1e4]
"#;

/// The processes that have a path on their command line: a launcher and its ranks. Dead ones have none.
pub fn processes(of: &Path) -> Vec<u32> {
    let numbers = std::fs::read_dir("/proc").unwrap().flatten();
    let numbers = numbers.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    let named = |number: &u32| {
        let line = std::fs::read(format!("/proc/{number}/cmdline")).unwrap_or_default();
        line.split(|&byte| byte == 0).any(|word| word == of.as_os_str().as_encoded_bytes())
    };
    numbers.filter(named).collect()
}

/// Kills a launcher and its ranks, and returns once none is left: ranks may outlive their launcher.
pub fn kill_all(of: &Path) {
    let start = Instant::now();
    loop {
        let left = processes(of);
        if left.is_empty() {
            return;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "{left:?} live on");
        let left = left.iter().map(u32::to_string);
        let _ = Command::new("kill").arg("-KILL").args(left).stderr(Stdio::null()).status();
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The process that is this rank of a job.
pub fn rank(of: &Path, number: usize) -> u32 {
    let variables = ["OMPI_COMM_WORLD_RANK", "PMI_RANK"].map(|name| format!("{name}={number}"));
    let is = |process: &u32| {
        let told = std::fs::read(format!("/proc/{process}/environ")).unwrap_or_default();
        told.split(|&byte| byte == 0).any(|word| variables.iter().any(|one| word == one.as_bytes()))
    };
    processes(of).into_iter().find(is).expect("there is no such rank")
}

/// Waits for something to be so, for so many seconds at most.
pub fn wait_within(seconds: u64, what: &str, mut so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !so() {
        assert!(start.elapsed() < Duration::from_secs(seconds), "{what}: not in {seconds} s");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// The same for two minutes.
pub fn wait_until(what: &str, so: impl FnMut() -> bool) {
    wait_within(120, what, so);
}

/// Waits until so many lines are in the journal of a sweep.
pub fn wait_for_lines(out: &Path, lines: usize) {
    wait_until("lines in the journal", || journal_lines(out) >= lines);
}

/// Sends a signal. Whether there was such a process.
pub fn signal(process: u32, name: &str) -> bool {
    let kill = [&format!("-{name}"), &process.to_string()];
    Command::new("kill").args(kill).status().unwrap().success()
}
