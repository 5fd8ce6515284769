//! What the sweep's integration tests share: a tiny sweep, and a comparison that leaves out time.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod job;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Two waves on movable walls in a short, coarse tank: seconds of work.
pub const TINY: &str = r#"
name = "tiny"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 0.8
wall = "movable"
[numerics]
particle_spacing_m = 0.025
[grid]
wave_height_ratio = [0.4, 0.5]
spring_stiffness_n_per_m = [10, 1e4]
seawall_mass_kg_per_m = [50, 250]
"#;

/// The number of its cases.
pub const TINY_CASES: usize = 8;

/// A wave on a movable wall in such a tank; its springs are to follow.
pub const SOFT: &str = r#"
name = "soft"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.2
wall = "movable"
seawall_mass_kg_per_m = 50
wave_height_ratio = 0.5
[numerics]
particle_spacing_m = 0.025
[grid]
"#;

/// A sweep with a gauge, whose cases leave probes.
pub fn with_gauge(sweep: &str) -> String {
    let gauge = "[[probe]]\nname = \"level\"\nkind = \"level\"\nx_m = 0.5\n[numerics]";
    sweep.replace("[numerics]", gauge)
}

/// Writes a sweep file.
pub fn write_file(directory: &Path, text: &str) -> PathBuf {
    let path = directory.join("sweep.toml");
    fs::write(&path, text).unwrap();
    path
}

/// The program under test, away from any launcher of the test run itself.
pub fn seawall() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_seawall"));
    for name in ["OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMIX_RANK"] {
        command.env_remove(name);
    }
    command
}

/// Runs it to its end.
pub fn run(arguments: &[&str]) -> Output {
    seawall().args(arguments).output().unwrap()
}

/// The exit code, and what was told where it is not the expected one.
pub fn expect_code(output: &Output, code: i32) {
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{told}");
}

/// Runs a scene file that must be refused: exit code 2, these words, and nothing written.
pub fn expect_refused(folder: &Path, text: &str, told: &str) {
    let file = write_file(folder, text);
    let out = folder.join("out");
    let output = run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    expect_code(&output, 2);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains(told), "{text}: {error}");
    assert!(!out.exists());
}

/// Everything that must be the same bit for bit: summary without wall time, energies, histories.
pub fn results(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for folder in ["histories", "probes", "envelopes", "waves"] {
        let Ok(entries) = fs::read_dir(out.join(folder)) else { continue };
        for entry in entries.map(Result::unwrap) {
            let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
            files.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    for name in ["energy.csv", "histories.csv.gz"] {
        if let Ok(bytes) = fs::read(out.join(name)) {
            files.insert(name.to_owned(), bytes);
        }
    }
    assert!(files.contains_key("energy.csv"), "{}", out.display());
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let mut summary = String::new();
    let rows = std::iter::once(headers.clone()).chain(reader.records().map(Result::unwrap));
    for row in rows {
        for (name, cell) in headers.iter().zip(&row) {
            if name != "wall_time_s" {
                summary.push_str(cell);
                summary.push(';');
            }
        }
        summary.push('\n');
    }
    files.insert("summary.csv".to_owned(), summary.into_bytes());
    files
}

/// Fails, naming the file, where two directories differ in anything but time.
pub fn assert_same(a: &Path, b: &Path) {
    let (left, right) = (results(a), results(b));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&left), names(&right));
    for (name, bytes) in &left {
        assert!(bytes == &right[name], "{name} differs: {} and {}", a.display(), b.display());
    }
}

/// Lines of the journal: one for the header and one for each finished case.
pub fn journal_lines(out: &Path) -> usize {
    fs::read_to_string(out.join("journal.jsonl")).map_or(0, |text| text.lines().count())
}
