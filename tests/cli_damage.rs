//! Files of a study that are damaged or missing: what is told of them, and what mends them.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use common::{TINY, expect_code, journal_lines, run, with_gauge, write_file};

fn sweep(file: &Path, out: &Path) -> Output {
    let (file, out) = (file.to_str().unwrap(), out.to_str().unwrap());
    run(&["sweep", file, "--out", out, "--threads", "2", "--film", "none"])
}

/// The files in a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// No case has to run for it: the study tells what the columns of probes hold.
#[test]
fn what_columns_of_probes_hold_is_told_and_mended() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), &with_gauge(TINY));
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    expect_code(&sweep(&file, &out), 0);
    let path = out.join("probes/columns.csv");
    let (before, lines) = (fs::read(&path).unwrap(), journal_lines(&out));
    for report in [true, false] {
        for damaged in [None, Some("name,unit,method\n")] {
            match damaged {
                Some(text) => fs::write(&path, text).unwrap(),
                None => fs::remove_file(&path).unwrap(),
            }
            let verified = run(&["verify", directory]);
            expect_code(&verified, 1);
            let words = String::from_utf8_lossy(&verified.stdout).into_owned();
            assert_eq!(words, "probes/columns.csv is damaged or missing\n");
            let mended = if report { run(&["report", directory]) } else { sweep(&file, &out) };
            expect_code(&mended, 0);
            assert_eq!(fs::read(&path).unwrap(), before);
            expect_code(&run(&["verify", directory]), 0);
        }
    }
    assert_eq!(journal_lines(&out), lines, "no case ran again");
}

/// A report without the files that cannot be drawn, with their names, and whole again after the same command.
#[test]
fn a_report_leaves_out_what_is_damaged_and_names_it() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), &with_gauge(TINY));
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    expect_code(&sweep(&file, &out), 0);
    let ways: [fn(&Path); 4] = [
        |path| fs::remove_file(path).unwrap(),
        |path| fs::write(path, "").unwrap(),
        |path| fs::write(path, "time_s,force\nx,y\n").unwrap(),
        |path| {
            let mut bytes = fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 0x80;
            fs::write(path, bytes).unwrap();
        },
    ];
    for folder in ["histories", "probes", "envelopes"] {
        for (number, way) in ways.iter().enumerate() {
            let path = files(&out.join(folder)).swap_remove(number);
            way(&path);
            let report = run(&["report", directory]);
            expect_code(&report, 1);
            let words = String::from_utf8(report.stderr).unwrap();
            let name = path.file_name().unwrap().to_str().unwrap();
            assert!(words.lines().any(|line| line.contains(name)), "{words}");
            assert!(words.contains("1 file left out: the same `seawall sweep`"), "{words}");
            assert!(fs::read_to_string(out.join("report.html")).unwrap().contains("</html>"));
            // Without what tells how the file was, what cannot be read shows all the same.
            let manifest = fs::read(out.join("manifest.json")).unwrap();
            fs::remove_file(out.join("manifest.json")).unwrap();
            assert_ne!(run(&["report", directory]).status.code(), Some(2));
            fs::write(out.join("manifest.json"), manifest).unwrap();
            expect_code(&sweep(&file, &out), 0);
            expect_code(&run(&["report", directory]), 0);
            expect_code(&run(&["verify", directory]), 0);
        }
    }
}

/// The second sweep made a summary without the bars of the first one. The manifest still told the file that asked for
/// them. So `verify` called the summary damaged, and `report` put the bars back.
#[test]
fn other_error_bars_of_the_same_cases_are_no_damage() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let summary = || fs::read_to_string(out.join("summary.csv")).unwrap();
    let mut bars_of = std::collections::BTreeMap::new();
    for bars in ["triple", "none", "pair", "triple", "none"] {
        let text = text.replace("[grid]", &format!("error_bars = {bars:?}\n[grid]"));
        expect_code(&sweep(&write_file(root.path(), &text), &out), 0);
        let swept = summary();
        let mut rows = csv::Reader::from_reader(swept.as_bytes());
        let column = rows.headers().unwrap().iter().position(|name| name == "force_error").unwrap();
        let told: Vec<_> = rows.records().map(|row| row.unwrap()[column].to_owned()).collect();
        assert!(told.len() == 2 && told.iter().all(|bar| bar.is_empty() == (bars == "none")));
        assert_eq!(*bars_of.entry(bars).or_insert_with(|| told.clone()), told, "{bars}");
        expect_code(&run(&["verify", directory, "--rerun", "1"]), 0);
        let report = run(&["report", directory]);
        expect_code(&report, 0);
        let words = String::from_utf8(report.stderr).unwrap();
        assert!(!words.contains("summary.csv"), "{bars}: {words}");
        assert_eq!(summary(), swept, "{bars}");
    }
}

/// Of a study that was stopped, `verify` counts what is finished, for people and for programs.
#[test]
fn verify_counts_what_is_finished() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    expect_code(&sweep(&write_file(root.path(), &text), &out), 0);
    let journal = fs::read_to_string(out.join("journal.jsonl")).unwrap();
    let shorter = journal.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(out.join("journal.jsonl"), format!("{shorter}\n")).unwrap();
    for table in ["summary.csv", "energy.csv"] {
        fs::remove_file(out.join(table)).unwrap();
    }
    let people = run(&["verify", directory]);
    expect_code(&people, 0);
    assert_eq!(
        String::from_utf8_lossy(&people.stdout),
        "1 case: every file is as it was written\n"
    );
    let programs = run(&["verify", directory, "--format", "json"]);
    expect_code(&programs, 0);
    let told: serde_json::Value = serde_json::from_slice(&programs.stdout).unwrap();
    assert_eq!(told, serde_json::json!({ "cases": 1, "rerun": 0, "damage": [] }));
}

/// The story: `verify --rerun 2` of a study whose cases had all failed ran none again, and did not say so.
#[test]
fn a_study_of_failed_cases_has_none_to_run_again() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let out = root.path().join("out");
    let limited = text.replace("[grid]", "[limits]\nsteps = 3\n[grid]");
    expect_code(&sweep(&write_file(root.path(), &limited), &out), 1);
    let again = run(&["verify", out.to_str().unwrap(), "--rerun", "2"]);
    expect_code(&again, 0);
    let told = String::from_utf8(again.stdout).unwrap();
    assert!(told.ends_with("none ran again: no case of this study has ended well\n"), "{told}");
}
