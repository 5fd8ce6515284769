//! Cases that take long keep checkpoints: killed in their midst they go on, to the same bytes.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use common::job::{signal, wait_until};
use common::{Desk, Told, assert_same, ended, expect_code, run, seawall, write_file};
use sha2::{Digest, Sha256};

/// Two walls behind a shared stretch, which take a second or so each.
const SPRINGS: &str = r#"
name = "springs"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.5
wall = "movable"
seawall_mass_kg_per_m = 50
[numerics]
particle_spacing_m = 0.01
[grid]
spring_stiffness_n_per_m = [10, 1e4]
"#;
/// One case, of each of these walls and schemes.
const CAISSON: &str = r#"
name = "caisson"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.5
wall = "caisson"
seawall_mass_kg_per_m = 60
submerged_weight_n_per_m = 300
static_friction = 0.6
kinetic_friction = 0.3
[numerics]
particle_spacing_m = 0.01
"#;
const INCOMPRESSIBLE: &str = r#"
name = "incompressible"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1
wall = "movable"
seawall_mass_kg_per_m = 50
spring_stiffness_n_per_m = 500
[numerics]
scheme = "isph"
particle_spacing_m = 0.02
"#;
const BED: &str = r#"
name = "bed"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.5
bed = [[0, 0], [0.5, 0], [1, 0.05]]
[numerics]
particle_spacing_m = 0.01
"#;
const OFTEN: [&str; 2] = ["--checkpoint-every-s", "0.05"];

/// The checkpoints of a directory by their ending.
fn checkpoints(out: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(out.join("checkpoints")).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths.filter(|path| path.extension().is_some_and(|found| found == ending)).collect()
}

fn words<'a>(command: &'a str, file: &'a str, out: &'a Path) -> Vec<&'a str> {
    vec![command, file, "--out", out.to_str().unwrap(), "--threads", "2"]
}

fn start(words: &[&str]) -> Child {
    let mut command: Command = seawall();
    command.args(words).args(OFTEN).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// Kills a command once a checkpoint of this ending is there, `times` times over.
fn kill_again_and_again(words: &[&str], out: &Path, ending: &str, times: usize) {
    for _ in 0..times {
        let before: Vec<_> = checkpoints(out, ending);
        let written = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
        let times: Vec<_> = before.iter().map(|path| written(path)).collect();
        let mut child = start(words);
        wait_until("checkpoint", || {
            let now = checkpoints(out, ending);
            now.len() > before.len()
                || before.iter().zip(&times).any(|(path, time)| written(path) != *time)
        });
        child.kill().unwrap();
        child.wait().unwrap();
    }
}

/// The last start: it must tell that it goes on.
fn finish(words: &[&str]) {
    let told = ended(0, words).err;
    assert!(told.contains("checkpoint"), "{told}");
}

#[test]
fn a_killed_sweep_goes_on_within_its_cases() {
    let desk = Desk::new(SPRINGS);
    let [whole, out] = ["whole", "out"].map(|name| desk.path().join(name));
    ended(0, &[&words("sweep", &desk.file, &whole)[..], &["--film", "none"]].concat());
    assert!(!whole.join("checkpoints").exists(), "none of short cases");
    let sweep = words("sweep", &desk.file, &out);
    kill_again_and_again(&sweep, &out, "trunk", 1);
    kill_again_and_again(&sweep, &out, "case", 2);
    assert!(!checkpoints(&out, "trunk").is_empty(), "kept for branches that have not begun");
    ended(0, &["verify", out.to_str().unwrap()]);
    finish(&sweep);
    assert_same(&whole, &out);
    assert!(!out.join("checkpoints").exists() && !out.join("running").exists());
}

#[test]
fn a_killed_run_goes_on_whatever_its_scene() {
    for text in [CAISSON, INCOMPRESSIBLE, BED] {
        let root = tempfile::tempdir().unwrap();
        let file = write_file(root.path(), text);
        let [whole, out] = ["whole", "out"].map(|name| root.path().join(name));
        ended(0, &words("run", &file, &whole));
        let one = words("run", &file, &out);
        kill_again_and_again(&one, &out, "case", 2);
        finish(&one);
        assert_same(&whole, &out);
        assert!(!out.join("checkpoints").exists());
    }
}

#[test]
fn a_run_that_is_told_to_stop_keeps_its_state() {
    let desk = Desk::new(BED);
    let [whole, out] = ["whole", "out"].map(|name| desk.path().join(name));
    ended(0, &words("run", &desk.file, &whole));
    let one = words("run", &desk.file, &out);
    let child = start(&one);
    wait_until("checkpoint", || !checkpoints(&out, "case").is_empty());
    assert!(signal(child.id(), "TERM"));
    let output = child.wait_with_output().unwrap();
    expect_code(&output, 3);

    // With a film it starts over, and was told to go on.
    let mut filmed = seawall();
    filmed.args(&one).args(["--vtk", "0.01"]).stdout(Stdio::null()).stderr(Stdio::piped());
    let child = filmed.spawn().unwrap();
    wait_until("film", || out.join("vtk").exists());
    assert!(signal(child.id(), "TERM"));
    let told = Told::of(child.wait_with_output().unwrap(), 3).err;
    assert!(told.contains("interrupted: a single scene starts over"), "{told}");
    fs::remove_dir_all(out.join("vtk")).unwrap();
    finish(&one);
    assert_same(&whole, &out);
}

#[test]
fn what_cannot_be_gone_on_from_is_told_and_starts_over() {
    let desk = Desk::new(BED);
    let whole = desk.path().join("whole");
    ended(0, &words("run", &desk.file, &whole));
    type Spoil = fn(&mut Vec<u8>);
    let ways: [(Spoil, &str); 3] = [
        (|bytes| bytes.truncate(bytes.len() / 2), "is damaged: its case starts over"),
        (
            |bytes| {
                let middle = bytes.len() / 2;
                bytes[middle] ^= 1;
            },
            "is damaged: its case starts over",
        ),
        (
            |bytes| {
                let end = bytes.iter().position(|&byte| byte == b'\n').unwrap();
                let line = String::from_utf8(bytes[..end].to_vec()).unwrap();
                let at = line.find("\"sources\":\"").unwrap() + 11;
                bytes[at..at + 4].copy_from_slice(b"0000");
                // As that build would have sealed it.
                let head = line.find("\"checkpoint\":").unwrap() + 13;
                let mut hash = Sha256::new();
                hash.update(&bytes[head..end - 1]);
                hash.update(&bytes[end + 1..]);
                let sum: String =
                    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect();
                bytes[8..24].copy_from_slice(sum.as_bytes());
            },
            "was written by another build",
        ),
    ];
    for (number, (spoil, words_told)) in ways.iter().enumerate() {
        let out = desk.path().join(number.to_string());
        let one = words("run", &desk.file, &out);
        kill_again_and_again(&one, &out, "case", 1);
        let path = checkpoints(&out, "case").pop().unwrap();
        let mut bytes = fs::read(&path).unwrap();
        spoil(&mut bytes);
        fs::write(&path, bytes).unwrap();
        let verified = run(&["verify", out.to_str().unwrap()]);
        let told = String::from_utf8_lossy(&verified.stdout).into_owned();
        assert_eq!(told.contains(".case is damaged"), number < 2, "{told}");
        let told = ended(0, &one).err;
        assert!(told.contains(words_told), "{told}");
        assert_same(&whole, &out);
        assert!(!out.join("checkpoints").exists());
    }
}

#[test]
fn how_often_is_a_time() {
    let desk = Desk::new(BED);
    for bad in ["-1", "nan", "often"] {
        let told = ended(
            2,
            &[&words("run", &desk.file, &desk.out)[..], &["--checkpoint-every-s", bad]].concat(),
        )
        .err;
        assert!(told.contains("a finite number of seconds"), "{told}");
    }
    assert!(!desk.out.exists());
}
