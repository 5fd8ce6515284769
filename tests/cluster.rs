//! What a cluster needs: a job script that queues itself again until all is done, and a look from outside.
//! `scripts/slurm` tries the same on a true Slurm.

mod common;

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::job::{LONG, is_mpich, mpirun, mpirun_is_there, signal, wait_for_lines, wait_until};
use common::{Desk, TINY, Told, assert_same, ended, expect_code, journal_lines, run, seawall};

/// The job script of a study.
fn script(root: &Path, file: &str, out: &Path, launcher: &str) -> PathBuf {
    let out = out.to_str().unwrap();
    let resources = ["--nodes", "3", "--time", "1-12:00:00", "--ranks-per-node", "4"];
    let places = ["--out", out, "--launcher", launcher];
    let output = ended(0, &[&["slurm", file][..], &resources, &places].concat());
    let path = root.join("job.sh");
    fs::write(&path, output.out).unwrap();
    path
}

/// Writes a script that can be run.
fn program(path: &Path, text: &str) {
    fs::write(path, text).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// Runs it as Slurm would. To be queued again ends it, as Slurm does, and leaves a file `queued`. The queue says what
/// a file `state` says, else that the job runs.
fn job(root: &Path, script: &Path) -> Command {
    let [queued, state] = ["queued", "state"].map(|name| root.join(name).display().to_string());
    let control = format!("#!/bin/sh\necho \"$@\" >>'{queued}'\nkill -9 $PPID\n");
    program(&root.join("scontrol"), &control);
    let queue = format!("#!/bin/sh\ncat '{state}' 2>/dev/null || echo RUNNING None\n");
    program(&root.join("squeue"), &queue);
    let path = std::env::var("PATH").unwrap();
    let mut command = Command::new("bash");
    command.arg(script).env("PATH", format!("{}:{path}", root.display())).env("SLURM_JOB_ID", "17");
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn queued(root: &Path) -> String {
    fs::read_to_string(root.join("queued")).unwrap_or_default()
}

/// A stand-in for `srun` that runs this script in place of the study.
fn stand_in(root: &Path, script: &str) -> String {
    let path = root.join("stand-in");
    program(&path, &format!("#!/bin/bash\n{script}\n"));
    path.to_str().unwrap().to_owned()
}

/// The story: the stroke of a paddle was sought where the job had been put into the queue.
#[test]
fn a_job_runs_where_its_script_was_made() {
    let desk = Desk::new(
        &TINY
            .replace(
                "[numerics]",
                "paddle = \"recorded-stroke\"\nend_time_s = 0.1\n\
        recorded_stroke = \"a stroke.csv\"\n[numerics]",
            )
            .replace("end_after_stroke_centre_s = 0.8\n", "")
            .replace("wave_height_ratio = [0.4, 0.5]\n", ""),
    );
    let folder = desk.path().join("it's here");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("a stroke.csv"), "time_s,stroke_m\n0,0\n0.5,0.01\n1,0.02\n").unwrap();
    let words = ["slurm", &desk.file, "--nodes", "1", "--time", "30", "--out", &desk.dir];
    let made = seawall().args(words).args(["--launcher", "env"]).current_dir(&folder).output();
    let text = common::Told::of(made.unwrap(), 0).out;
    let path = desk.path().join("job.sh");
    fs::write(&path, text).unwrap();
    expect_code(&job(desk.path(), &path).current_dir("/").output().unwrap(), 0);
    assert_eq!(journal_lines(&desk.out), 5);
}

/// The story: cases were done and films were left. The job died after one, and was not put back into the queue.
#[test]
fn a_new_film_is_progress() {
    let desk = without_page();
    let root = desk.path();
    for (does, again) in [("true", false), ("mkdir -p films && touch films/a.html", true)] {
        let launcher = stand_in(root, &format!("cd '{}' && {does}; kill -9 $$", desk.dir));
        let script = script(root, &desk.file, &desk.out, &launcher);
        job(root, &script).output().unwrap();
        assert_eq!(!queued(root).is_empty(), again, "{does}");
    }
}

/// A study whose cases are all done and whose page is not: the next sweep owes films and page.
fn without_page() -> Desk {
    let desk = Desk::new(TINY);
    let page = desk.out.join("report.html");
    ended(0, &["sweep", &desk.file, "--out", &desk.dir, "--film", "none"]);
    fs::remove_file(&page).unwrap();
    fs::create_dir(&page).unwrap();
    ended(2, &["sweep", &desk.file, "--out", &desk.dir, "--film", "none"]);
    fs::remove_dir(&page).unwrap();
    expect_code(&run(&["status", &desk.dir, "--exit-code"]), 3);
    desk
}

/// A launcher that tells the job's script to stop, as the queue does, and waits until it is told itself.
const TOLD: &str =
    "trap 'exit 3' USR1; kill -USR1 $PPID; for k in $(seq 1200); do sleep 0.05; done; exit 9";

/// The story: a job was cancelled and put itself back into the queue.
#[test]
fn a_job_that_is_cancelled_is_not_queued_again() {
    let desk = without_page();
    let root = desk.path();
    let launcher = stand_in(root, &format!("touch '{}/films/'$$.html; {TOLD}", desk.dir));
    fs::create_dir_all(desk.out.join("films")).unwrap();
    let script = script(root, &desk.file, &desk.out, &launcher);
    for (state, again) in [
        ("COMPLETING None", false),
        ("", false),
        ("COMPLETING TimeLimit", true),
        ("RUNNING None", true),
    ] {
        fs::write(root.join("state"), state).unwrap();
        let told = job(root, &script).output().unwrap();
        assert_eq!(!queued(root).is_empty(), again, "{state}");
        let told = String::from_utf8(told.stderr).unwrap();
        assert_eq!(told.contains("the job was cancelled, or"), !again, "{told}");
    }
}

/// The story: a job whose time was too short for its next film came back for ever.
#[test]
fn a_job_that_is_told_to_stop_twice_without_progress_is_not_queued_again() {
    let desk = without_page();
    let root = desk.path();
    let new = root.join("new");
    let moved = format!("[ ! -e '{0}' ] || mv '{0}' '{1}/films/'", new.display(), desk.dir);
    let launcher = stand_in(root, &format!("{moved}; {TOLD}"));
    fs::create_dir_all(desk.out.join("films")).unwrap();
    let script = script(root, &desk.file, &desk.out, &launcher);
    let start = || job(root, &script).output().unwrap();
    start();
    assert_eq!(queued(root).lines().count(), 1);
    // A film between two such starts is progress.
    fs::write(new, "").unwrap();
    for starts in [2, 3] {
        start();
        assert_eq!(queued(root).lines().count(), starts);
    }
    let told = Told::of(start(), 3).err;
    assert!(told.contains("two starts in a row") && told.contains("not put back"), "{told}");
    assert_eq!(queued(root).lines().count(), 3);
}

/// The story: a signal came while the script read a long journal, and nobody heard of it.
#[test]
fn a_signal_before_the_ranks_are_started_is_passed_on() {
    let desk = without_page();
    let root = desk.path();
    let launcher =
        stand_in(root, "trap 'exit 3' USR1; for k in $(seq 400); do sleep 0.05; done; exit 9");
    let path = script(root, &desk.file, &desk.out, &launcher);
    let text = fs::read_to_string(&path).unwrap();
    let (before, after) = text.split_once("before=$(progress)\n").unwrap();
    fs::write(&path, format!("{before}kill -USR1 $$\nbefore=$(progress)\n{after}")).unwrap();
    let start = Instant::now();
    job(root, &path).output().unwrap();
    assert!(start.elapsed() < Duration::from_secs(15), "{:?}", start.elapsed());
    assert_eq!(queued(root).lines().count(), 1);
}

#[test]
fn a_job_script_says_what_was_asked_for() {
    let desk = Desk::new(TINY);
    let script = script(desk.path(), &desk.file, &desk.path().join("it's here"), "srun");
    expect_code(&Command::new("bash").arg("-n").arg(&script).output().unwrap(), 0);
    let text = fs::read_to_string(script).unwrap();
    for line in [
        "#SBATCH --job-name=tiny",
        "#SBATCH --nodes=3",
        "#SBATCH --ntasks-per-node=4",
        "#SBATCH --time=1-12:00:00",
        "#SBATCH --signal=B:USR1@120",
        "#SBATCH --requeue",
    ] {
        assert!(text.lines().any(|it| it == line), "{line}: {text}");
    }
    assert!(text.contains("it'\\''s here'"), "{text}");
    for name in ["{NAME}", "{NODES}", "{OUT}", "{FILE}", "{GRACE}", "{MORE}"] {
        assert!(!text.contains(name), "{name}: {text}");
    }
    let idle = ["--nodes", "1", "--time", "9", "--launcher", " "];
    for bad in [&["--nodes", "0", "--time", "1"][..], &["--nodes", "1", "--time", "1h"], &idle] {
        ended(2, &[&["slurm", &desk.file][..], bad].concat());
    }
    // The story: Slurm may send its signal 60 s early, which left such a job no time at all.
    let slurm =
        |code, time| ended(code, &["slurm", &desk.file, "--nodes", "1", "--time", time]).err;
    let told = slurm(2, "2:59");
    assert!(
        told.contains("--time 2:59: the sweep is told to stop 120 s before (--grace-s)"),
        "{told}"
    );
    slurm(0, "3");
}

/// Slurm gave a rank of several threads a single core, where it binds tasks to cores.
#[test]
fn ranks_of_several_threads_ask_srun_for_their_cores() {
    let desk = Desk::new(TINY);
    let script = |resources: &[&str], launcher: &str| {
        let common = ["slurm", &desk.file, "--nodes", "1", "--time", "9", "--launcher", launcher];
        ended(0, &[&common[..], resources].concat()).out
    };
    let asked = "\nSRUN_CPUS_PER_TASK=\"${SLURM_CPUS_PER_TASK-8}\" srun -l ";
    for (launcher, threads, asks) in
        [("srun -l", "8", true), ("srun", "1", false), ("mpirun", "8", false)]
    {
        let text = script(&["--threads", threads], launcher);
        assert_eq!(text.contains(asked), asks, "{text}");
    }
    // The story: where nothing was said four nodes of 64 cores ran four cases at once.
    for (launcher, bind) in
        [("srun -l", "SLURM_CPU_BIND=none srun -l "), ("mpirun", "policy=none mpirun ")]
    {
        let text = script(&[], launcher);
        assert!(text.contains("\n#SBATCH --exclusive\n#SBATCH --ntasks-per-node=1\n"), "{text}");
        assert!(text.contains(bind) && !text.contains("--threads"), "{text}");
    }
    let text = script(&["--ranks-per-node", "4"], "srun");
    assert!(
        text.contains("=4\n#SBATCH --cpus-per-task=1\n") && text.contains(" --threads 1 "),
        "{text}"
    );
}

/// What a launcher that does nothing but tell its environment tells of the keepalive settings.
fn keepalive(job: &mut Command) -> std::collections::BTreeMap<String, u64> {
    let told = job.stdout(Stdio::piped()).output().unwrap().stdout;
    let told = String::from_utf8(told).unwrap();
    let pairs = told.lines().filter_map(|line| line.split_once('='));
    let ours = pairs.filter(|(name, _)| name.contains("_MCA_oob_tcp_keepalive_"));
    ours.map(|(name, value)| (name.to_owned(), value.parse().unwrap())).collect()
}

#[test]
fn a_machine_that_is_cut_off_ends_the_job_within_half_a_minute() {
    let desk = Desk::new(TINY);
    let script = script(desk.path(), &desk.file, &desk.path().join("out"), "env; true");
    let told = keepalive(&mut job(desk.path(), &script));
    for launcher in ["OMPI", "PRTE"] {
        let of = |name: &str| told[&format!("{launcher}_MCA_oob_tcp_keepalive_{name}")];
        assert!(of("time") + of("intvl") * of("probes") <= 30, "{told:?}");
    }
    // Who has set a time of their own keeps it.
    let mut own = job(desk.path(), &script);
    own.env("OMPI_MCA_oob_tcp_keepalive_time", "60");
    assert_eq!(keepalive(&mut own)["OMPI_MCA_oob_tcp_keepalive_time"], 60);
}

#[test]
fn a_job_that_is_told_to_stop_is_queued_again_until_all_is_done() {
    let desk = Desk::new(LONG);
    let (out, whole) = (desk.path().join("out"), desk.path().join("whole"));
    let script = script(desk.path(), &desk.file, &out, "env");
    let child = job(desk.path(), &script).spawn().unwrap();
    wait_for_lines(&out, 1);
    signal(child.id(), "USR1");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.signal(), Some(9), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(queued(desk.path()), "requeue 17\n");
    expect_code(&job(desk.path(), &script).output().unwrap(), 0);
    assert_eq!(queued(desk.path()), "requeue 17\n");
    let (file, told) = (&desk.file, whole.to_str().unwrap());
    ended(0, &["sweep", file, "--out", told]);
    assert_same(&whole, &out);
}

#[test]
fn a_job_that_cannot_go_on_is_not_queued_again() {
    // The ranks cannot be started.
    let desk = Desk::new(TINY);
    let dead = script(desk.path(), &desk.file, &desk.out, "false");
    expect_code(&job(desk.path(), &dead).output().unwrap(), 70);
    // They die before anything is done, though something is there.
    desk.sweep(&[]);
    let journal = fs::read_to_string(desk.out.join("journal.jsonl")).unwrap();
    let header = journal.lines().next().unwrap();
    fs::write(desk.out.join("journal.jsonl"), format!("{header}\n")).unwrap();
    expect_code(&job(desk.path(), &dead).output().unwrap(), 3);
    // Bad input stays bad.
    let well = script(desk.path(), &desk.file, &desk.out, "env");
    fs::write(&desk.file, "name = 3").unwrap();
    expect_code(&job(desk.path(), &well).output().unwrap(), 2);
    assert_eq!(queued(desk.path()), "");
}

#[test]
fn a_watched_sweep_tells_its_rate_until_it_ends() {
    let desk = Desk::new(TINY);
    let mut sweep = seawall();
    let sweep = sweep.arg("sweep").arg(&desk.file).arg("--out").arg(&desk.out).args([
        "--threads",
        "1",
        "--quiet",
    ]);
    let mut sweep = sweep.spawn().unwrap();
    wait_for_lines(&desk.out, 1);
    wait_until("manifest.json", || desk.out.join("manifest.json").is_file());
    let watch = run(&["status", &desk.dir, "--watch", "0.1", "--exit-code"]);
    assert!(sweep.wait().unwrap().success());
    expect_code(&watch, 0);
    let told = String::from_utf8(watch.stdout).unwrap();
    assert!(told.contains("tiny: running") && told.contains("tiny: finished"), "{told}");
    assert!(told.contains(" per hour on 1 rank, ") && told.contains(" % idle"), "{told}");
    // What is known of the load outlives the session.
    assert!(told.contains("\nbusy ") && !desk.out.join("load.json").exists(), "{told}");
    let status = run(&["status", &desk.dir, "--format", "json"]);
    let status: serde_json::Value = serde_json::from_slice(&status.stdout).unwrap();
    let share = status["load"]["ranks"][0]["busy_share"].as_f64().unwrap();
    assert!(share > 0.0 && share <= 1.0, "{share}");
    let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
    assert!(page.contains("<h3>Load per rank</h3>") && page.contains(" cases per hour."));
}

/// The story: a sweep waited without end for a rank that was told to do something else, or nothing that it knows.
#[test]
fn a_command_that_does_not_join_a_sweep_ends_the_job() {
    if !mpirun_is_there() || is_mpich() {
        return;
    }
    let desk = Desk::new(TINY);
    let other = "error: rank 1: of several commands under one launcher";
    for (words, told) in [
        (&["status", "."][..], other),
        (&["sweep", &desk.file, "--dry-run"], other),
        (&["swep"], "unrecognized subcommand 'swep'"),
    ] {
        let mut command = mpirun(1);
        command.args(["sweep", &desk.file, "--out", &desk.dir, ":", "-n", "1"]);
        command.arg(env!("CARGO_BIN_EXE_seawall")).args(words);
        let errors = Told::of(command.output().unwrap(), 2).err;
        assert!(errors.contains(told), "{errors}");
        assert!(!Path::new(&desk.dir).exists());
    }
}
