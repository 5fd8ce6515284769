//! Limits of a case: what is over one fails with its reason, and the study goes on.

use std::path::Path;

use crate::common::{Desk, TINY, TINY_CASES, assert_same, ended, expect_code, run};

/// Steps that the cases of one wave need more of than those of the other.
const STEPS: &str = "limits.steps=332";

fn sweep(file: &str, out: &Path, more: &[&str]) -> std::process::Output {
    let out = out.to_str().unwrap();
    run(&[&["sweep", file, "--out", out, "--threads", "2"], more].concat())
}

/// The reasons of the failed cases.
fn failures(out: &Path) -> Vec<String> {
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let rows = reader.records().map(Result::unwrap);
    rows.filter(|row| &row[1] == "failed").map(|row| row[2].to_owned()).collect()
}

#[test]
fn a_limit_in_steps_fails_the_same_cases_however_they_are_run() {
    let desk = Desk::new(TINY);
    let (out, whole) = (desk.path().join("out"), desk.path().join("whole"));
    expect_code(&sweep(&desk.file, &out, &["--set", STEPS]), 1);
    let reasons = failures(&out);
    assert_eq!(reasons.len(), TINY_CASES / 2, "{reasons:?}");
    for reason in reasons {
        assert!(reason.starts_with("over-limit at t = 1."), "{reason}");
        assert!(reason.ends_with(" s: needs more than 332 steps (limits.steps)"), "{reason}");
    }
    for more in [&["--no-branch"][..], &["--threads", "1"], &["--set", "limits.memory_mib=1000"]] {
        let other = desk.path().join(format!("other{}", more.len()));
        let _ = std::fs::remove_dir_all(&other);
        let more = [more, &["--set", STEPS]].concat();
        let more: Vec<_> = more.into_iter().collect();
        let (file, told) = (&desk.file, other.to_str().unwrap());
        ended(1, &[&["sweep", file, "--out", told][..], &more].concat());
        assert_same(&out, &other);
    }
    // Limits are no part of what a case is.
    expect_code(&sweep(&desk.file, &out, &["--set", STEPS]), 1);
    expect_code(&sweep(&desk.file, &out, &["--retry-failed"]), 0);
    expect_code(&sweep(&desk.file, &whole, &[]), 0);
    assert_same(&whole, &out);
}

#[test]
fn too_little_time_and_memory_fail_cases_with_their_reason() {
    let desk = Desk::new(TINY);
    for (number, (limit, words)) in [
        ("limits.wall_time_s=1e-6", "takes more than 0.000001 s (limits.wall_time_s)"),
        ("limits.memory_mib=4", "needs some 8.1 MiB, more than 4 (limits.memory_mib)"),
        #[cfg(target_os = "linux")]
        ("limits.memory_mib=8.5", " MiB, more than 8.5 (limits.memory_mib)"),
    ]
    .into_iter()
    .enumerate()
    {
        let out = desk.path().join(format!("out{number}"));
        expect_code(&sweep(&desk.file, &out, &["--set", limit]), 1);
        let reasons = failures(&out);
        assert_eq!(reasons.len(), TINY_CASES, "{limit}");
        for reason in reasons {
            assert!(
                reason.starts_with("over-limit at t = ") && reason.ends_with(words),
                "{reason}"
            );
        }
    }
}

/// The process that watched the memory ended the case before it could tell how far it was. The case is long and
/// its steps are short: a machine with much else to do takes them, too, before the time is over.
#[test]
#[cfg(target_os = "linux")]
fn a_case_that_is_watched_tells_at_which_time_it_was_over_its_limit() {
    let long = TINY.replace("_centre_s = 0.8", "_centre_s = 1000").replace("0.025", "0.0125");
    let text = long.replace("[10, 1e4]", "[10]");
    let desk = Desk::new(&text.replace("[50, 250]", "[50]"));
    let limits = ["--set", "limits.wall_time_s=1", "--set", "limits.memory_mib=900"];
    expect_code(&sweep(&desk.file, &desk.out, &limits), 1);
    let reasons = failures(&desk.out);
    assert_eq!(reasons.len(), 2);
    for reason in reasons {
        let time = reason.strip_prefix("over-limit at t = ").unwrap();
        let time: f64 = time.split(' ').next().unwrap().parse().unwrap();
        assert!(time > 0.0 && reason.ends_with("(limits.wall_time_s)"), "{reason}");
    }
}

#[test]
fn check_tells_how_many_cases_are_over_a_limit() {
    let desk = Desk::new(TINY);
    let told = |limit: &str| ended(0, &["check", &desk.file, "--set", limit]).out;
    assert!(told("limits.steps=100").contains("limits: 8 cases will probably need more and fail"));
    assert!(!told("limits.steps=100000").contains("limits:"));
}

/// All values stood in one cell of the table: of 100,000 failed cases it was wider than the program can write.
#[test]
fn status_lists_some_of_many_values_that_failed() {
    let range = "{ from = 10, to = 1000, points = 30, spacing = \"log\" }";
    let desk = Desk::new(&TINY.replace("[10, 1e4]", range));
    expect_code(&sweep(&desk.file, &desk.out, &["--set", "limits.steps=1"]), 1);
    let told = ended(0, &["status", &desk.dir]).out;
    assert!(told.contains("(4), 10 others (--format json has all)\n"), "{told}");
}

/// A camera stood between a case and its limits.
#[test]
fn a_case_that_is_filmed_keeps_to_its_limits() {
    let desk = Desk::new(TINY);
    let case = ["wave_height_ratio=0.5", "k=10", "m=50", "--threads", "1"];
    for film in ["--film", "--vtk"] {
        for (limit, words) in [
            ("limits.steps=20", "needs more than 20 steps (limits.steps)"),
            ("limits.wall_time_s=1e-6", "takes more than 0.000001 s (limits.wall_time_s)"),
        ] {
            let told = ["run", &desk.file, "--out", &desk.dir, "--fresh"];
            let words_of = [&told[..], &case, &["--set", limit, film]].concat();
            ended(1, &words_of);
            let reasons = failures(&desk.out);
            assert!(reasons[0].ends_with(words), "{film}: {reasons:?}");
        }
    }
}

/// The lines of a journal, without its header.
fn journalled(out: &Path) -> usize {
    std::fs::read_to_string(out.join("journal.jsonl")).unwrap().lines().count() - 1
}

/// The story: where a companion had failed, `run` and `sweep` printed no error bars and no reason, and each further
/// `run` computed the failed companion again.
#[test]
fn a_companion_that_failed_is_told_and_counts_as_done() {
    let one = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[10, 1e4]", "[10]");
    let desk = Desk::new(&one.replace("[50, 250]", "[50]"));
    let pair = ["--set", "numerics.error_bars=pair"];
    let few = [&pair[..], &["--set", "limits.steps=10"]].concat();
    let why = "the companion with particles 35.36 mm apart failed: over-limit at t = ";
    for command in ["run", "sweep"] {
        let out = desk.path().join(command);
        let go = |more: &[&str]| {
            ended(0, &[&[command, &desk.file, "--out", out.to_str().unwrap()], more].concat())
        };
        go(&[]);
        for _ in 0..2 {
            let told = go(&few);
            let told = if command == "run" { told.err } else { told.out };
            assert_eq!(told.matches(why).count(), 1, "{command}: {told}");
            assert_eq!(journalled(&out), 2, "{command}");
        }
        // A limit that is gone makes nothing run again on its own, as with cases.
        let told = go(&[&pair[..], &["--format", "json"]].concat()).json();
        let record = if command == "run" { &told } else { &told["records"][0] };
        let failed = &record["failed_companions"][0];
        assert!(failed["reason"].as_str().unwrap().starts_with("over-limit at t = "), "{failed}");
        assert_eq!(failed["failure"], "over-limit");
        assert!(record["error_bars"]["force_max_error"].is_null(), "{record}");
    }
    let again =
        sweep(&desk.file, &desk.path().join("sweep"), &[&pair[..], &["--retry-failed"]].concat());
    expect_code(&again, 0);
    let told = String::from_utf8(again.stdout).unwrap();
    assert!(!told.contains("lack") && told.contains("±"), "{told}");
}
