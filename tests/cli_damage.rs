//! Files of a study that are damaged or missing: what is told of them, and what mends them.

mod common;

use std::fs;
use std::path::Path;
use std::process::Output;

use common::{TINY, expect_code, journal_lines, run, write_file};

fn sweep(file: &Path, out: &Path) -> Output {
    let (file, out) = (file.to_str().unwrap(), out.to_str().unwrap());
    run(&["sweep", file, "--out", out, "--threads", "2", "--film", "none"])
}

/// No case has to run for it: the study tells what the columns of probes hold.
#[test]
fn what_columns_of_probes_hold_is_told_and_mended() {
    let root = tempfile::tempdir().unwrap();
    let gauge = "[[probe]]\nname = \"level\"\nkind = \"level\"\nx_m = 0.5\n[numerics]";
    let file = write_file(root.path(), &TINY.replace("[numerics]", gauge));
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
