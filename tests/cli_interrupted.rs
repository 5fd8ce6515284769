//! What programs are told where a command was interrupted.

use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use crate::common::job::{signal, wait_until};
use crate::common::{Desk, TINY, expect_code, seawall};
use serde_json::Value;

/// A case that takes longer than this test.
const LONG: &str =
    "name = \"long\"\n[scene]\nend_time_s = 200\n[numerics]\nparticle_spacing_m = 0.02\n";

/// Starts a command, stops it a moment after a file is there, and returns its object.
fn stopped(arguments: &[&str], once: &Path) -> Value {
    let mut command = seawall();
    command.args(arguments).args(["--format", "json", "--threads", "1"]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait_until("a file", || once.exists());
    std::thread::sleep(Duration::from_millis(100));
    assert!(signal(child.id(), "TERM"));
    let output = child.wait_with_output().unwrap();
    expect_code(&output, 3);
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The story: a program that read the output of an interrupted sweep, run or film got nothing.
#[test]
fn an_interrupted_command_tells_programs_what_is_known() {
    let grid = Desk::new(&format!("{LONG}[grid]\nwave_height_ratio = [0.3, 0.4]\n"));
    let told = stopped(
        &["sweep", &grid.file, "--out", &grid.dir, "--film", "none"],
        &grid.out.join("journal.jsonl"),
    );
    assert_eq!((&told["interrupted"], &told["name"]), (&true.into(), &"long".into()), "{told}");
    assert_eq!((&told["cases"], &told["done"]), (&2.into(), &0.into()), "{told}");
    assert_eq!(told["out"], grid.dir.as_str());

    let single = Desk::new(LONG);
    let told =
        stopped(&["run", &single.file, "--out", &single.dir], &single.out.join("journal.jsonl"));
    assert_eq!((&told["interrupted"], &told["cases"]), (&true.into(), &1.into()), "{told}");
    assert_eq!((&told["out"], &told["done"]), (&single.dir.as_str().into(), &0.into()), "{told}");

    let one = TINY.replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.0125");
    let one = one.replace("end_after_stroke_centre_s = 0.8", "end_after_stroke_centre_s = 3");
    let one = Desk::new(&one);
    one.run(&["H/h=0.5", "k=10", "m=50"]);
    let lock = one.out.join("derived.lock");
    let _ = std::fs::remove_file(&lock);
    let told = stopped(&["film", &one.dir], &lock);
    assert_eq!((&told["interrupted"], &told["out"]), (&true.into(), &one.dir.as_str().into()));
    assert_eq!(told["case_id"].as_str().map(str::len), Some(16), "{told}");
}
