//! What the sweep's integration tests share: a tiny sweep, and a comparison that leaves out time.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod job;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

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

/// Writes a sweep file; its path as a word of a command line.
pub fn write_file(directory: &Path, text: &str) -> String {
    let path = directory.join("sweep.toml");
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The program under test, away from any launcher of the test run itself.
pub fn seawall() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_seawall"));
    for name in [
        "OMPI_COMM_WORLD_SIZE",
        "OMPI_COMM_WORLD_RANK",
        "PMI_SIZE",
        "PMIX_RANK",
        "SLURM_STEP_NUM_TASKS",
    ] {
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

/// What a command told: its results, and notes and errors.
pub struct Told {
    pub out: String,
    pub err: String,
}

impl Told {
    /// What a command told that has ended with this code.
    pub fn of(output: Output, code: i32) -> Told {
        expect_code(&output, code);
        let [out, err] = [output.stdout, output.stderr];
        let [out, err] = [out, err].map(|bytes| String::from_utf8(bytes).unwrap());
        Told { out, err }
    }

    /// The results for a program.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}", self.out))
    }
}

/// Runs a command, which must end with this code.
pub fn ended(code: i32, arguments: &[&str]) -> Told {
    Told::of(run(arguments), code)
}

/// `seawall sweep` of a file into a directory, without films, which must end with this code.
pub fn sweep(code: i32, file: &str, out: &Path, more: &[&str]) -> Told {
    let out = out.to_str().unwrap();
    ended(code, &[&["sweep", file, "--out", out, "--film", "none"], more].concat())
}

/// A directory with the file of a study, and a place for what it leaves.
pub struct Desk {
    root: TempDir,
    /// The file's path.
    pub file: String,
    /// Where results go: `out`, which nobody has made yet.
    pub out: PathBuf,
    /// The same as a word of a command line.
    pub dir: String,
}

impl Desk {
    pub fn new(text: &str) -> Desk {
        let root = tempfile::tempdir().unwrap();
        let (file, out) = (write_file(root.path(), text), root.path().join("out"));
        let dir = out.to_str().unwrap().to_owned();
        Desk { root, file, out, dir }
    }

    pub fn path(&self) -> &Path {
        self.root.path()
    }

    /// Another file in the place of the first.
    pub fn write(&self, text: &str) {
        write_file(self.path(), text);
    }

    /// `seawall sweep` of the file, with more arguments, which must end well.
    pub fn sweep(&self, more: &[&str]) -> Told {
        ended(0, &[&["sweep", &self.file, "--out", &self.dir], more].concat())
    }

    /// `seawall run` likewise.
    pub fn run(&self, more: &[&str]) -> Told {
        ended(0, &[&["run", &self.file, "--out", &self.dir], more].concat())
    }
}

/// A column of a directory's `summary.csv`.
pub fn column(out: &Path, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let place = reader.headers().unwrap().iter().position(|column| column == name).unwrap();
    reader.records().map(|row| row.unwrap()[place].to_owned()).collect()
}

/// Runs a scene file that must be refused: exit code 2, these words, and nothing written.
pub fn expect_refused(text: &str, told: &str) {
    let desk = Desk::new(text);
    let error = ended(2, &["run", &desk.file, "--out", &desk.dir]).err;
    assert!(error.contains(told), "{text}: {error}");
    assert!(!desk.out.exists());
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
