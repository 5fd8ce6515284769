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
