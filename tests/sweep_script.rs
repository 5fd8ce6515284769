//! `scripts/sweep` around a job that is told to end, is killed, or whose launcher loses exit codes.
#![cfg(all(feature = "mpi", target_os = "linux"))]

mod common;
mod scripts;

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::job::{
    LONG, is_mpich, kill_all, processes, room, signal, wait_for_lines, wait_until, wait_within,
};
use common::{TINY, TINY_CASES, Told, assert_same, expect_code, run};

/// A place with a sweep file.
struct Room {
    root: tempfile::TempDir,
    file: String,
    out: PathBuf,
}

impl Room {
    /// None where there is no mpirun.
    fn new(text: &str) -> Option<Room> {
        let (root, file) = room(text)?;
        let out = root.path().join("out");
        Some(Room { root, file, out })
    }

    /// The script, with the program that is tested.
    fn script(&self, more: &[&str]) -> Command {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/sweep");
        let mut command = Command::new(script);
        command.env("SEAWALL_MPI_BINARY", env!("CARGO_BIN_EXE_seawall"));
        command.env("CARGO_TARGET_DIR", self.root.path().join("target"));
        command.arg(&self.file).arg("--out").arg(&self.out).args(["--threads", "1"]).args(more);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    /// The script with a launcher in front of the true one, of which `$true_mpirun` is the path.
    fn script_under(&self, launcher: &str) -> Command {
        let shims = self.root.path().join("shims");
        let path = std::env::var("PATH").unwrap();
        let found = std::env::split_paths(&path).map(|folder| folder.join("mpirun"));
        let found = found.into_iter().find(|file| file.is_file()).unwrap();
        fs::create_dir(&shims).unwrap();
        let shim = shims.join("mpirun");
        let found = found.display();
        fs::write(&shim, format!("#!/bin/bash\ntrue_mpirun={found}\n{launcher}\n")).unwrap();
        fs::set_permissions(&shim, fs::Permissions::from_mode(0o755)).unwrap();
        let mut command = self.script(&[]);
        command.env("PATH", format!("{}:{path}", shims.display()));
        command
    }

    /// The same sweep, undisturbed.
    fn reference(&self) -> PathBuf {
        let out = self.root.path().join("reference");
        let (file, told) = (&self.file, out.to_str().unwrap());
        expect_code(&run(&["sweep", file, "--out", told]), 0);
        out
    }

    /// Those of its processes whose program has this name.
    fn named(&self, name: &str) -> Vec<u32> {
        let is = |number: &u32| {
            let told = fs::read_to_string(format!("/proc/{number}/comm")).unwrap_or_default();
            told.trim() == name
        };
        processes(&self.out).into_iter().filter(is).collect()
    }

    fn launcher(&self) -> u32 {
        *self.named("mpirun").last().expect("there is no mpirun")
    }
}

fn ended(child: Child) -> Output {
    child.wait_with_output().unwrap()
}

/// A trial run has no journal. Its code was taken for that of a job that died: 70.
#[test]
fn a_dry_run_ends_as_the_program_does() {
    let Some(room) = Room::new(TINY) else { return };
    expect_code(&room.script(&["--dry-run", "--quiet"]).output().unwrap(), 0);
    expect_code(
        &room.script(&["--dry-run", "--set", "numerics.kernel=\"none\""]).output().unwrap(),
        2,
    );
    assert!(!room.out.exists());
}

#[test]
fn a_launcher_that_is_told_to_end_gives_the_code_of_an_interrupted_sweep() {
    for name in ["INT", "TERM"] {
        let Some(room) = Room::new(LONG) else { return };
        let child = room.script(&[]).spawn().unwrap();
        wait_for_lines(&room.out, 1);
        signal(room.launcher(), name);
        expect_code(&ended(child), 3);
        expect_code(&run(&["status", room.out.to_str().unwrap(), "--exit-code"]), 3);
    }
}

#[test]
fn a_launcher_that_loses_codes_changes_none() {
    let loses = "\"$true_mpirun\" \"$@\"; exit 0";
    let Some(room) = Room::new(TINY) else { return };
    expect_code(&room.script_under(loses).output().unwrap(), 0);
    let Some(room) = Room::new(&format!("{TINY}\n[limits]\nsteps = 10\n")) else { return };
    expect_code(&room.script_under(loses).output().unwrap(), 1);
    expect_code(&run(&["status", room.out.to_str().unwrap(), "--exit-code"]), 1);
    let Some(room) = Room::new("name = \"a\"\n[gird]\n") else { return };
    expect_code(&room.script_under(loses).output().unwrap(), 2);
    let Some(room) = Room::new(LONG) else { return };
    let child = room.script_under(loses).spawn().unwrap();
    wait_for_lines(&room.out, 1);
    signal(room.launcher(), "TERM");
    expect_code(&ended(child), 3);
}

/// The launcher used to die of the script's own signal when it was as good as done: exit code 138.
#[test]
fn ctrl_c_when_the_job_is_done_gives_the_code_of_the_sweep() {
    let Some(room) = Room::new(TINY) else { return };
    // Trials of the launcher leave at once.
    let slow_to_leave = "[[ \"$*\" = *sweep* && \"$*\" != *--dry-run* ]] || exec \"$true_mpirun\" \"$@\"\n\
        \"$true_mpirun\" \"$@\" || exit; trap - USR1; sleep 60 >&- 2>&- & wait";
    let child = room.script_under(slow_to_leave).spawn().unwrap();
    wait_for_lines(&room.out, 1 + TINY_CASES);
    wait_until("report.html", || room.out.join("report.html").is_file());
    wait_until("the end of the ranks", || room.named("seawall").is_empty());
    signal(child.id(), "INT");
    let output = ended(child);
    assert!(String::from_utf8_lossy(&output.stderr).contains("stopping"), "it came too late");
    expect_code(&output, 0);
}

/// Bash cannot run a trap while it reads a `$(...)`. Where the script had one after the job's end it returned 2.
#[test]
fn ctrl_c_while_the_script_looks_back_gives_the_code_of_the_sweep() {
    let at_once = "[[ \"$*\" = *sweep* ]] || exec \"$true_mpirun\" \"$@\"\n\
                   while [ \"$1\" != --ending ]; do shift; done; trap '' USR1\n\
                   printf 'out %s\\ncode 1\\n' /tmp >\"$2\"; touch \"$0.done\"";
    for _ in 0..12 {
        let Some(room) = Room::new(TINY) else { return };
        let child = room.script_under(at_once).spawn().unwrap();
        let start = Instant::now();
        // Without a pause: the script looks back for a moment only.
        while !room.root.path().join("shims/mpirun.done").is_file() {
            assert!(start.elapsed() < Duration::from_secs(60), "the job does not end");
        }
        let often = format!("for n in {{1..25}}; do kill -INT {}; sleep 0.002; done", child.id());
        let kills = Command::new("bash").args(["-c", &often]).stderr(Stdio::null()).status();
        kills.unwrap();
        expect_code(&ended(child), 1);
    }
}

#[test]
fn a_killed_script_leaves_nobody_at_work() {
    let Some(room) = Room::new(LONG) else { return };
    let mut child = room.script(&[]).spawn().unwrap();
    wait_for_lines(&room.out, 1);
    child.kill().unwrap();
    child.wait().unwrap();
    wait_within(10, "the end of the job", || processes(&room.out).is_empty());
    expect_code(&run(&["status", room.out.to_str().unwrap(), "--exit-code"]), 3);
}

/// Open MPI removes the files in which ranks share memory only where these end by themselves.
#[test]
fn killed_ranks_leave_no_shared_memory() {
    if !is_mpich() {
        return;
    }
    let Some(room) = Room::new(LONG) else { return };
    let child = room.script(&[]).spawn().unwrap();
    wait_for_lines(&room.out, 1);
    let environment = fs::read(format!("/proc/{}/environ", room.launcher())).unwrap();
    let environment = String::from_utf8_lossy(&environment).into_owned();
    let name = "OMPI_MCA_btl_vader_backing_directory=";
    let folder = environment.split('\0').find_map(|setting| setting.strip_prefix(name));
    let folder = Path::new(folder.expect("ranks share memory in a folder of their own"));
    assert!(fs::read_dir(folder).unwrap().count() > 0, "{}", folder.display());
    signal(room.launcher(), "KILL");
    expect_code(&ended(child), 3);
    kill_all(&room.out);
    assert!(!folder.exists(), "{}", folder.display());
}

#[test]
fn a_job_that_dies_is_started_again_until_it_is_done() {
    let Some(room) = Room::new(TINY) else { return };
    let reference = room.reference();
    let child = room.script(&["--keep-going"]).spawn().unwrap();
    for lines in [2, 4] {
        wait_for_lines(&room.out, lines);
        if let Some(&rank) = room.named("seawall").first() {
            signal(rank, "KILL");
        }
    }
    let told = Told::of(ended(child), 0).err;
    assert!(told.contains("starting it again"), "{told}");
    assert_same(&reference, &room.out);
}

#[test]
fn a_job_that_gets_no_further_is_given_up() {
    let Some(room) = Room::new(TINY) else { return };
    let starts = room.root.path().join("starts");
    let dies = format!(
        "[[ \"$*\" = *sweep* ]] || exec \"$true_mpirun\" \"$@\"; echo >>'{}'; exit 9",
        starts.display()
    );
    let output = room.script_under(&dies).arg("--keep-going").output().unwrap();
    expect_code(&output, 70);
    assert_eq!(fs::read_to_string(&starts).unwrap().lines().count(), 3);
}

/// Films were no progress: a job that died after each of them was given up.
#[test]
fn a_job_that_makes_one_more_film_is_started_again() {
    let Some(room) = Room::new(TINY) else { return };
    let starts = room.root.path().join("starts");
    let dies = format!(
        "[[ \"$*\" = *sweep* ]] || exec \"$true_mpirun\" \"$@\"; echo >>'{0}'\n\
         mkdir -p '{1}/films'; touch '{1}/journal.jsonl'; [ $(wc -l <'{0}') -gt 4 ] || echo >\"{1}/films/$RANDOM$RANDOM\"\n\
         while [ \"$1\" != --ending ]; do shift; done; echo 'out {1}' >\"$2\"; exit 9",
        starts.display(),
        room.out.display()
    );
    let output = room.script_under(&dies).arg("--keep-going").output().unwrap();
    expect_code(&output, 70);
    assert_eq!(fs::read_to_string(&starts).unwrap().lines().count(), 6);
}

/// The story: told alone to end, as `kill` and batch systems do, these scripts left what they had started at work.
#[test]
fn scripts_pass_on_the_signal_that_ends_them() {
    for (script, stub) in [("nightly", "seawall"), ("test", "cargo")] {
        let root = tempfile::tempdir().unwrap();
        let parts =
            ["scripts", "sweeps"].map(|part| Path::new(env!("CARGO_MANIFEST_DIR")).join(part));
        let copied = Command::new("cp").arg("-r").args(parts).arg(root.path()).status().unwrap();
        assert!(copied.success());
        let (program, started) = (root.path().join(stub), root.path().join("started"));
        let works = format!(
            "#!/bin/bash\n[[ $* = *--version ]] && exit\nsleep 600 &\necho $! >'{0}.new'\n\
             mv '{0}.new' '{0}'\nwait",
            started.display()
        );
        fs::write(&program, works).unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        let path = format!("{}:{}", root.path().display(), std::env::var("PATH").unwrap());
        let mut command = Command::new(root.path().join("scripts").join(script));
        command.env("PATH", path).env("CARGO_TARGET_DIR", root.path().join("target"));
        command.env("SEAWALL_BINARY", &program).stdout(Stdio::null()).stderr(Stdio::null());
        let child = command.spawn().unwrap();
        wait_until(script, || started.is_file());
        let at_work = fs::read_to_string(&started).unwrap();
        signal(child.id(), "TERM");
        expect_code(&ended(child), 143);
        let command = Path::new("/proc").join(at_work.trim()).join("cmdline");
        let is_gone = || !fs::read(&command).is_ok_and(|words| !words.is_empty());
        wait_within(10, "the end of what the script began", is_gone);
    }
}
