//! Faults, caused for real: what the user sees, and that nothing is lost or wrong unseen.

mod common;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use common::job::{LONG, signal, wait_for_lines};
use common::{
    Desk, SOFT, TINY, TINY_CASES, assert_same, ended, expect_code, journal_lines, results, run,
    seawall, sweep, with_gauge, write_file,
};

/// Three cases; the second one needs more memory than `ulimit` leaves.
const POISON: &str = r#"
name = "poison"
[scene]
kind = "hydrostatic"
end_time_s = 0.01
[grid]
particle_spacing_m = [0.02, 0.0008, 0.025]
"#;
/// Kilobytes of data, or of address space.
const LITTLE: u32 = 450_000;

fn start(file: &str, out: &Path, more: &[&str]) -> Child {
    let mut command = seawall();
    command.arg("sweep").arg(file).arg("--out").arg(out);
    command.args(["--threads", "2", "--film", "none"]).args(more);
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A sweep with little memory, of which only a process that takes too much gets to know.
fn limited(file: &str, out: &Path) -> Output {
    limited_by("-d", file, out)
}

fn limited_by(option: &str, file: &str, out: &Path) -> Output {
    let script = format!("ulimit {option} {LITTLE}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_seawall"), "sweep"]);
    command.arg(file).arg("--out").arg(out);
    command.args(["--threads", "2", "--film", "none"]).output().unwrap()
}

/// The system ended the program by a signal, without a word.
#[test]
#[cfg(target_os = "linux")]
fn files_that_may_not_grow_are_told() {
    let desk = Desk::new(TINY);
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f 4; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_seawall"), "sweep"]);
    let stopped = command.arg(&desk.file).arg("--out").arg(&desk.out).args(["--film", "none"]);
    let stopped = stopped.output().unwrap();
    assert!(told(&stopped).contains("file too large"), "{}", told(&stopped));
    assert!(stopped.status.code().is_some_and(|code| code > 1), "{:?}", stopped.status);
    sweep(0, &desk.file, &desk.out, &[]);
    let whole = desk.path().join("whole");
    sweep(0, &desk.file, &whole, &[]);
    assert_same(&desk.out, &whole);
}

/// The shared stretch of four cases needs too much memory, and so do they from rest: each of them took the process
/// with it in turn.
#[test]
#[cfg(target_os = "linux")]
fn cases_whose_shared_stretch_ends_its_process_are_not_tried_in_the_open() {
    let grid =
        "[grid]\nparticle_spacing_m = [0.025, 0.0006]\nspring_stiffness_n_per_m = [10, 20, 30, 40]";
    let text = SOFT.replace("particle_spacing_m = 0.025\n", "").replace("[grid]", grid);
    let desk = Desk::new(&text);
    let first = limited(&desk.file, &desk.out);
    assert_eq!(first.status.code(), None, "the process itself should have died: {}", told(&first));
    expect_code(&limited(&desk.file, &desk.out), 1);
    let summary = fs::read_to_string(desk.out.join("summary.csv")).unwrap();
    assert_eq!(summary.matches("ended-the-process").count(), 4, "{summary}");
    assert_eq!(summary.lines().count(), 9, "{summary}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_case_that_ends_its_process_is_recorded_and_the_sweep_goes_on() {
    let desk = Desk::new(POISON);
    let first = limited(&desk.file, &desk.out);
    assert_eq!(first.status.code(), None, "the process itself should have died: {}", told(&first));
    let second = limited(&desk.file, &desk.out);
    expect_code(&second, 1);
    let summary = fs::read_to_string(desk.out.join("summary.csv")).unwrap();
    let failed: Vec<_> = summary.lines().filter(|line| line.contains("failed")).collect();
    assert_eq!((summary.lines().count(), failed.len()), (4, 1), "{summary}");
    assert!(failed[0].contains("ended-the-process"), "{summary}");
    assert!(failed[0].contains("memory allocation"), "{summary}");
    assert!(!desk.out.join("running").exists());
    // With memory enough it is well.
    sweep(0, &desk.file, &desk.out, &["--retry-failed"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_limit_of_the_address_space_is_asked_before_anything_runs() {
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), POISON), root.path().join("out"));
    let refused = limited_by("-v", &file, &out);
    expect_code(&refused, 2);
    let words = told(&refused);
    assert!(words.contains("(ulimit -v) has") && words.contains("fewer --threads"), "{words}");
    assert!(!out.exists(), "nothing is written");
    // What fits runs.
    let coarse = write_file(root.path(), &POISON.replace("0.0008", "0.015"));
    expect_code(&limited_by("-v", &coarse, &out), 0);
}

#[test]
fn kills_in_quick_succession_make_no_case_fail() {
    let desk = Desk::new(TINY);
    let (whole, out) = (desk.path().join("whole"), desk.path().join("out"));
    sweep(0, &desk.file, &whole, &[]);
    for lines in [0, 1, 1, 2, 2, 3, 4] {
        let mut child = start(&desk.file, &out, &[]);
        wait_for_lines(&out, lines);
        child.kill().unwrap();
        child.wait().unwrap();
    }
    sweep(0, &desk.file, &out, &[]);
    assert_same(&whole, &out);
}

/// A study whose cases were done was called finished without its films and page, and a job script ended well.
#[test]
fn films_and_page_are_left_until_they_are_made() {
    let desk = Desk::new(LONG);
    let out = desk.path().join("out");
    let one =
        ["--set", "grid.wave_height_ratio=[0.5]", "--set", "grid.spring_stiffness_n_per_m=[10]"];
    let status = |code| ended(code, &["status", out.to_str().unwrap(), "--exit-code"]).out;
    for name in ["INT", "KILL"] {
        let mut command = seawall();
        command.arg("sweep").arg(&desk.file).arg("--out").arg(&out).args(one);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
        assert!(lines.any(|line| line.starts_with("filming")));
        signal(child.id(), name);
        lines.for_each(drop);
        child.wait().unwrap();
        assert!(status(3).contains("the same command makes films and page"), "{name}");
    }
    sweep(0, &desk.file, &out, &one);
    assert!(status(0).contains("finished"));
}

#[test]
fn a_directory_that_goes_away_is_never_called_well() {
    let desk = Desk::new(TINY);
    let ways: [fn(&Path); 4] = [
        |out| fs::rename(out, out.with_extension("gone")).unwrap(),
        |out| fs::remove_file(out.join("journal.jsonl")).unwrap(),
        |out| while fs::remove_dir_all(out).is_err() {},
        |out| fs::write(out.join("journal.jsonl"), "").unwrap(),
    ];
    for (number, way) in ways.iter().enumerate() {
        let out = desk.path().join(format!("out{number}"));
        let child = start(&desk.file, &out, &[]);
        wait_for_lines(&out, 2);
        way(&out);
        let output = child.wait_with_output().unwrap();
        expect_code(&output, 70);
        assert!(told(&output).contains("error: "), "{}", told(&output));
        // What is left is nobody else's directory.
        if number == 1 {
            let refused = sweep(2, &desk.file, &out, &[]);
            assert!(refused.err.contains("journal.jsonl is missing"), "{}", refused.err);
        }
        let more: &[&str] = if number == 0 || number == 2 { &[] } else { &["--fresh"] };
        sweep(0, &desk.file, &out, more);
    }
}

#[test]
fn many_that_start_over_at_once_leave_one_whole_result() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let before = results(&desk.out);
    let children: Vec<_> = (0..6).map(|_| start(&desk.file, &desk.out, &["--fresh"])).collect();
    let mut well = 0;
    for child in children {
        let output = child.wait_with_output().unwrap();
        match output.status.code() {
            Some(0) => well += 1,
            code => assert_eq!(code, Some(2), "{}", told(&output)),
        }
    }
    assert!(well >= 1);
    assert_eq!(results(&desk.out), before);
    let folders = fs::read_dir(desk.path())
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().starts_with("out"));
    assert_eq!(folders.count(), 1 + well, "one moved aside for each that started over");
}

#[test]
fn flipped_bits_are_told_and_mended() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let before = results(&desk.out);
    ended(0, &["verify", &desk.dir, "--rerun", "2"]);
    let history = fs::read_dir(desk.out.join("histories")).unwrap().next().unwrap().unwrap().path();
    for path in [history, desk.out.join("journal.jsonl"), desk.out.join("summary.csv")] {
        let mut bytes = fs::read(&path).unwrap();
        let place = bytes.len() * 2 / 3;
        bytes[place] ^= 2;
        fs::write(&path, bytes).unwrap();
        ended(1, &["verify", &desk.dir]);
        sweep(0, &desk.file, &desk.out, &[]);
        assert_eq!(results(&desk.out), before, "{}", path.display());
        ended(0, &["verify", &desk.dir]);
    }
    fs::write(desk.out.join("summary.csv"), "case_id\n").unwrap();
    let report = ended(0, &["report", &desk.dir]);
    assert!(report.err.contains("made again from the journal"), "{}", report.err);
    assert_eq!(results(&desk.out), before);
    for damaged in ["", "{"] {
        fs::write(desk.out.join("manifest.json"), damaged).unwrap();
        sweep(0, &desk.file, &desk.out, &[]);
        ended(0, &["status", &desk.dir]);
    }
}

/// Every file below a directory, but for the lock, which holds nothing.
fn files(directory: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for path in fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            files.extend(self::files(&path));
        } else if !path.to_str().unwrap().ends_with("lock") {
            files.push(path);
        }
    }
    files.sort();
    files
}

#[test]
fn a_flipped_bit_in_any_file_is_told_and_mended() {
    let desk = Desk::new(&with_gauge(TINY));
    let arguments = ["sweep", &desk.file, "--out", &desk.dir, "--threads", "2"];
    ended(0, &arguments);
    ended(0, &["verify", &desk.dir]);
    let all = files(&desk.out);
    let mut seen = std::collections::BTreeMap::new();
    for path in all.iter().rev() {
        // Of each folder two: what differs in kind stands at its ends.
        let folder: &mut Vec<_> = seen.entry(path.parent().unwrap().to_owned()).or_default();
        if folder.len() < 2 || path.parent() == Some(&desk.out) || path.ends_with("columns.csv") {
            folder.push(path.clone());
        }
    }
    let chosen: Vec<_> = seen.into_values().flatten().collect();
    for name in ["films", "figures", "tables", "probes/columns.csv", "derived.json", "energy.csv"] {
        assert!(chosen.iter().any(|path| path.starts_with(desk.out.join(name))), "{name}");
    }
    for path in chosen {
        let before = fs::read(&path).unwrap();
        let mut bytes = before.clone();
        let place = bytes.len() / 2;
        bytes[place] ^= 2;
        fs::write(&path, bytes).unwrap();
        let told_path = path.display();
        assert_eq!(run(&["verify", &desk.dir]).status.code(), Some(1), "{told_path}");
        ended(0, &arguments);
        let verified = run(&["verify", &desk.dir]);
        assert_eq!(verified.status.code(), Some(0), "{told_path}: {}", told(&verified));
        let changes = ["journal.jsonl", "manifest.json", "report.html", "derived.json"];
        let changes =
            path.parent() == Some(&desk.out) && changes.iter().any(|name| path.ends_with(name));
        assert!(changes || fs::read(&path).unwrap() == before, "{told_path}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_terminal_that_goes_away_stops_a_sweep_in_good_order() {
    let desk = Desk::new(&TINY.replace("0.025", "0.015"));
    let hang_up = |child: &Child| assert!(signal(child.id(), "HUP"));
    // Whatever has started these tests heeds or does not heed.
    let start = |heed: &str| {
        let mut command = Command::new("env");
        command.args([heed, env!("CARGO_BIN_EXE_seawall"), "sweep"]).arg(&desk.file);
        command.arg("--out").arg(&desk.out).args(["--threads", "2", "--film", "none"]);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let child = start("--default-signal=HUP");
    wait_for_lines(&desk.out, 2);
    hang_up(&child);
    expect_code(&child.wait_with_output().unwrap(), 3);
    // What `nohup` has started goes on.
    let child = start("--ignore-signal=HUP");
    wait_for_lines(&desk.out, 4);
    hang_up(&child);
    expect_code(&child.wait_with_output().unwrap(), 0);
}

#[test]
fn a_journal_without_a_beginning_is_not_started_over() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let before = results(&desk.out);
    let journal = fs::read_to_string(desk.out.join("journal.jsonl")).unwrap();
    let (_, cases) = journal.split_once('\n').unwrap();
    fs::write(desk.out.join("journal.jsonl"), cases).unwrap();
    ended(1, &["verify", &desk.dir]);
    ended(0, &["status", &desk.dir, "--exit-code"]);
    sweep(0, &desk.file, &desk.out, &[]);
    assert_eq!(results(&desk.out), before);
    assert_eq!(journal_lines(&desk.out), TINY_CASES + 1);
    fs::write(desk.out.join("journal.jsonl"), "").unwrap();
    let refused = sweep(2, &desk.file, &desk.out, &[]);
    assert!(refused.err.contains("has lost its beginning"), "{}", refused.err);
    assert_eq!(results(&desk.out), before);
}

/// A sweep that has lost files does not end well, though the cases after them make the folder again. The same command
/// brings them back.
#[test]
fn histories_that_go_away_or_are_spoilt_are_missed_before_the_end() {
    // Ten trunks on two threads: most are still to come when the first cases have ended, however fast the machine is.
    let many = TINY.replace("0.025", "0.0125").replace("[50, 250]", "[50]");
    let many = many.replace("[0.4, 0.5]", "{ from = 0.3, to = 0.75, points = 10 }");
    let desk = Desk::new(&many);
    let whole = desk.path().join("whole");
    sweep(0, &desk.file, &whole, &[]);
    let ways: [fn(&Path); 2] = [
        |histories| while fs::remove_dir_all(histories).is_err() {},
        |histories| {
            let first = fs::read_dir(histories).unwrap().flatten().next().unwrap().path();
            fs::write(first, "time_s,force,runup,displacement,wall_velocity_m_per_s\n1,2\n")
                .unwrap();
        },
    ];
    for (number, way) in ways.iter().enumerate() {
        let out = desk.path().join(format!("out{number}"));
        let child = start(&desk.file, &out, &[]);
        wait_for_lines(&out, 2);
        // After 0.2 s the first case is on the disk, and nobody opens its files again.
        std::thread::sleep(Duration::from_millis(300));
        way(&out.join("histories"));
        let output = child.wait_with_output().unwrap();
        expect_code(&output, 70);
        assert!(told(&output).contains("histories/"), "{}", told(&output));
        sweep(0, &desk.file, &out, &[]);
        assert_same(&whole, &out);
        ended(0, &["verify", out.to_str().unwrap()]);
    }
}
