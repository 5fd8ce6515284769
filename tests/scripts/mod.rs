//! All scripts: their words, in a folder whose name has a space, called from elsewhere.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use crate::common::expect_code;

/// The scripts in a folder whose name has a space, with the program that is tested and with a stub for cargo.
struct Copy {
    root: tempfile::TempDir,
}

impl Copy {
    fn new() -> Copy {
        let root = tempfile::Builder::new().prefix("a b").tempdir().unwrap();
        let home = Path::new(env!("CARGO_MANIFEST_DIR"));
        let parts = ["scripts", "sweeps", "examples"].map(|part| home.join(part));
        let copied = Command::new("cp").arg("-r").args(parts).arg(root.path()).status().unwrap();
        assert!(copied.success());
        let program = env!("CARGO_BIN_EXE_seawall");
        let cargo = format!(
            "#!/bin/bash\n[ \"$1\" = build ] || exit 9\nmkdir -p \"$CARGO_TARGET_DIR/release\"\n\
             ln -s '{program}' \"$CARGO_TARGET_DIR/release/seawall\"\n"
        );
        let stub = root.path().join("cargo");
        fs::write(&stub, cargo).unwrap();
        fs::set_permissions(&stub, fs::Permissions::from_mode(0o755)).unwrap();
        Copy { root }
    }

    fn script(&self, name: &str, words: &[&str]) -> Command {
        let mut command = Command::new(self.root.path().join("scripts").join(name));
        let path = format!("{}:{}", self.root.path().display(), std::env::var("PATH").unwrap());
        command.args(words).env("PATH", path).env("CARGO_TARGET_DIR", self.root.path().join("t"));
        command.env("SEAWALL_BINARY", env!("CARGO_BIN_EXE_seawall")).current_dir("/");
        command
    }
}

/// The story: `scripts/validate` removed what earlier runs had left before it had looked at its words. So did two
/// more, and a dry run of any of these ended with errors, or wrote over stored tables.
#[test]
fn dry_runs_and_words_that_cannot_be_used_cost_no_earlier_results() {
    let copy = Copy::new();
    let runs = copy.root.path().join("results/runs");
    let earlier = ["validation", "convergence", "boundary_comparison"].map(|name| runs.join(name));
    for folder in &earlier {
        fs::create_dir_all(folder).unwrap();
        fs::write(folder.join("summary.md"), "earlier").unwrap();
    }
    let scripts = ["validate", "convergence", "boundary_comparison", "nightly", "study", "settled"];
    for script in scripts {
        for (code, words) in
            [(2, &["--nonsense"][..]), (2, &["--set", "numerics.colour=1"]), (0, &["--dry-run"])]
        {
            expect_code(&copy.script(script, words).output().unwrap(), code);
            assert!(earlier.iter().all(|folder| folder.join("summary.md").exists()), "{script}");
            assert_eq!(fs::read_dir(&runs).unwrap().count(), earlier.len(), "{script} {words:?}");
        }
    }
    let output = copy.script("liang2017", &["--only", "surface_20mm", "--dry-run"]).output();
    expect_code(&output.unwrap(), 0);
    assert!(!copy.root.path().join("results/liang2017").exists());
}

#[test]
fn words_that_a_script_cannot_use_are_bad_input() {
    let copy = Copy::new();
    for words in [
        &["ranks", "4", "5"][..],
        &["liang2017", "--only", "nonsense"],
        &["same_answers", "keep", "kept", "/no/where"],
        &["same_answers", "keep", "kept", "/tmp"],
        &["flume_film", "nonsense"],
        &["screenshots", "one", "two"],
        &["torture", "nonsense"],
        &["torture", "--trials", "0"],
        &["torture", "--trials=many"],
        &["torture", "--fault"],
        &["torture", "--trials", "5", "--fault", "nonsense"],
    ] {
        let output = copy.script(words[0], &words[1..]).output().unwrap();
        expect_code(&output, 2);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(told.contains(&format!("; see scripts/{} --help", words[0])), "{told}");
    }
    // A build, which the stub refuses, is only begun with words that can be used.
    let strace = copy.root.path().join("strace"); // or it would be installed
    fs::copy(copy.root.path().join("cargo"), strace).unwrap();
    let mut torture = copy.script("torture", &["--trials", "1", "--fault=checkpoint-bit"]);
    expect_code(&torture.output().unwrap(), 9);
    // A folder is no program.
    let mut command = copy.script("accuracy", &[]);
    expect_code(&command.env("SEAWALL_BINARY", "/tmp").output().unwrap(), 70);
}

/// The story: with a target directory that counts from the caller's, the build was looked for elsewhere than it went.
#[test]
fn a_target_directory_may_be_relative() {
    let (copy, place) = (Copy::new(), tempfile::tempdir().unwrap());
    let file = copy.root.path().join("sweeps/smoke.toml");
    let mut command =
        copy.script("sweep", &["--threads-only", "--dry-run", file.to_str().unwrap()]);
    command.current_dir(place.path()).env("CARGO_TARGET_DIR", "built").env_remove("SEAWALL_BINARY");
    expect_code(&command.output().unwrap(), 0);
    assert!(place.path().join("built/release/seawall").exists());
}
