//! Page, figures, tables and films: several processes that make them at once, and one that does not come to its end.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::job::{signal, wait_for_lines, wait_until};
use crate::common::{Desk, TINY, TINY_CASES, column, ended, run, seawall, sweep};

fn started(arguments: &[&str]) -> Child {
    seawall().args(arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// All must end well.
fn joined(children: Vec<Child>) {
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// The story: of two reports at once one ended with 70, as the other had renamed its file, or seals were taken of files
/// that were half-written.
#[test]
fn reports_and_films_at_once_neither_fail_nor_seal_what_is_half_written() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let cases = column(&desk.out, "case_id");
    for _ in 0..4 {
        let reports = (0..3).map(|_| started(&["report", &desk.dir]));
        let films = cases[..2].iter().map(|case| started(&["film", &desk.dir, case]));
        joined(reports.chain(films).collect());
        ended(0, &["verify", &desk.dir]);
        fs::remove_file(desk.out.join("derived.json")).unwrap();
    }
}

/// The story: the sweep itself ended with 70 when it came to its page.
#[test]
fn a_sweep_makes_its_page_among_reports() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    // On a busy machine a single report may last as long as the sweep.
    let (mut among_reports, mut rounds) = (0, 0);
    while among_reports < 3 {
        rounds += 1;
        assert!(rounds <= 12, "{among_reports} of {rounds} sweeps had two reports beside them");
        fs::remove_file(desk.out.join("derived.json")).unwrap();
        fs::remove_file(desk.out.join("summary.csv")).unwrap();
        let mut child = started(&["sweep", &desk.file, "--out", &desk.dir, "--film", "auto"]);
        let mut reports = 0;
        while child.try_wait().unwrap().is_none() {
            let report = run(&["report", &desk.dir]);
            // Before the summary is there, there is nothing to report.
            let told = String::from_utf8_lossy(&report.stderr).into_owned();
            assert!(report.status.success() || told.contains("no summary.csv"), "{told}");
            reports += 1;
        }
        joined(vec![child]);
        among_reports += u32::from(reports > 1);
        ended(0, &["verify", &desk.dir]);
        fs::remove_dir_all(desk.out.join("films")).unwrap();
    }
}

fn is_whole(folder: &Path) -> bool {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let svgs = files.filter(|path| path.extension().is_some_and(|ending| ending == "svg"));
    let texts: Vec<_> = svgs.map(|path| fs::read_to_string(path).unwrap()).collect();
    !texts.is_empty() && texts.iter().all(|text| text.trim_end().ends_with("</svg>"))
}

/// The story: a report ended on a full disk and left half a figure. Then `verify` and `status` called all well.
#[test]
fn a_report_that_does_not_end_is_told_until_one_does() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let full = || {
        let script = "ulimit -f 40; exec \"$0\" report \"$1\"";
        let program = seawall().get_program().to_owned();
        let mut shell = Command::new("bash");
        shell.args(["-c", script]).arg(program).arg(&desk.dir).output().unwrap()
    };
    let figure = desk.out.join("figures/response-force.svg");
    let in_the_way = || {
        fs::remove_file(&figure).unwrap();
        fs::create_dir(&figure).unwrap();
        let output = run(&["report", &desk.dir]);
        fs::remove_dir(&figure).unwrap();
        output
    };
    let ways: [(&dyn Fn() -> std::process::Output, i32); 2] = [(&full, 70), (&in_the_way, 2)];
    for (way, code) in ways {
        assert_eq!(way().status.code(), Some(code));
        assert!(is_whole(&desk.out.join("figures")));
        let told = ended(1, &["verify", &desk.dir]).out;
        assert!(
            told.contains("page, figures and tables were not finished: `seawall report`"),
            "{told}"
        );
        let told = ended(3, &["status", &desk.dir, "--exit-code"]).out;
        assert!(
            told.contains("finished but for its page; `seawall report` makes it again"),
            "{told}"
        );
        ended(0, &["report", &desk.dir]);
        ended(0, &["verify", &desk.dir]);
        ended(0, &["status", &desk.dir, "--exit-code"]);
    }
}

/// The story: a sweep that was killed after its last case, before its tables, was called finished. One that waited there
/// for another process did not heed a first signal.
#[test]
fn a_sweep_that_ends_between_its_last_case_and_its_page_is_not_finished() {
    for name in ["KILL", "TERM"] {
        let desk = Desk::new(TINY);
        let child = started(&["sweep", &desk.file, "--out", &desk.dir, "--film", "none"]);
        wait_until("derived.json", || desk.out.join("derived.json").exists());
        let making = File::open(desk.out.join("derived.lock")).unwrap();
        making.lock().unwrap();
        wait_for_lines(&desk.out, 1 + TINY_CASES);
        let told = ended(0, &["status", &desk.dir]).out;
        assert!(told.contains("running: all cases done, makes films and page"), "{told}");
        let start = Instant::now();
        signal(child.id(), name);
        let output = child.wait_with_output().unwrap();
        assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
        let told = String::from_utf8(output.stderr).unwrap();
        if name == "TERM" {
            assert_eq!(output.status.code(), Some(3), "{told}");
            assert!(
                told.contains("interrupted: 8 of 8 cases done; the same command goes on"),
                "{told}"
            );
        }
        drop(making);
        let told = ended(3, &["status", &desk.dir, "--exit-code"]).out;
        assert!(told.contains("stopped after its cases; the same command makes films"), "{told}");
        let told = ended(1, &["verify", &desk.dir]);
        let wanted =
            "page, figures and tables were not finished: `seawall report` makes them again\n";
        assert_eq!(told.out, wanted);
        sweep(0, &desk.file, &desk.out, &[]);
        ended(0, &["status", &desk.dir, "--exit-code"]);
        ended(0, &["verify", &desk.dir]);
    }
}

/// The story: where a sweep was killed at its last case, the next one finished it, and these files stayed for good.
#[test]
fn nothing_that_only_a_running_sweep_needs_is_left_of_a_killed_one() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let left = ["running", "load.json"].map(|name| desk.out.join(name));
    let case = &column(&desk.out, "case_id")[7];
    fs::write(&left[0], format!("\n+{case}\n")).unwrap();
    fs::write(&left[1], "{\"elapsed_s\":1,\"ranks\":[]}").unwrap();
    sweep(0, &desk.file, &desk.out, &[]);
    assert!(left.iter().all(|path| !path.exists()));
    ended(0, &["verify", &desk.dir]);
}

/// Looks one after another were objects over many lines, which no reader takes apart.
#[test]
fn each_look_is_one_line_for_a_program() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let told = ended(0, &["status", &desk.dir, "--watch", "1", "--format", "json"]);
    assert_eq!((told.out.lines().count(), &told.json()["done"]), (1, &serde_json::json!(8)));
    for words in [&["--format", "json"][..], &[]] {
        let output = run(words);
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8(told).unwrap();
        assert!(told.contains("report") && !told.contains("apart"), "{told}");
    }
}

/// The story: with the cases done and companions left, `status` told programs of no time to go, and people of none at all.
#[test]
fn companions_that_are_left_take_time() {
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let desk = Desk::new(&text.replace("[grid]", "error_bars = \"triple\"\n[grid]"));
    desk.sweep(&["--film", "none"]);
    let status = |format: &[&str]| ended(0, &[&["status", &desk.dir], format].concat());
    assert_eq!(status(&["--format", "json"]).json()["time_to_go_s"], 0.0);
    assert!(!status(&[]).out.contains("to go"));
    // Killed before the last three companions: their lines are missing.
    let path = desk.out.join("journal.jsonl");
    let journal = fs::read_to_string(&path).unwrap();
    let companion = |line: &&str| !line.contains("\"header\"") && index(line) >= 2;
    let companions: Vec<_> = journal.lines().filter(companion).collect();
    assert_eq!(companions.len(), 4);
    let kept = journal.lines().filter(|line| !companions[1..].contains(line));
    fs::write(&path, kept.map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    let told = status(&["--format", "json"]).json();
    assert_eq!((&told["left"], &told["companions_left"]), (&0.into(), &3.into()));
    let seconds = told["time_to_go_s"].as_f64().unwrap();
    assert!(seconds > 0.0, "{told}");
    let text = status(&[]).out;
    assert!(text.contains("\n1 of 4 companions for error bars done, about "), "{text}");
}

/// The place of a journal's line in the study.
fn index(line: &str) -> u64 {
    let line: serde_json::Value = serde_json::from_str(line).unwrap();
    line["entry"]["case"]["index"].as_u64().unwrap()
}
