//! The sweep that is tortured, and how its results are compared.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};

/// Two waves on movable walls in a short, coarse tank.
const SWEEP: &str = r#"
name = "torture"
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
/// Longer than any of its runs on any machine.
const PATIENCE: Duration = Duration::from_secs(300);

/// Files by their names.
type Files = BTreeMap<String, Vec<u8>>;

/// A sweep, its undisturbed results, and room for trials.
pub struct Study {
    seawall: PathBuf,
    mpi: Option<PathBuf>,
    root: tempfile::TempDir,
    file: PathBuf,
    /// What an undisturbed sweep leaves.
    pub undisturbed: Files,
    /// How long it takes.
    pub time: Duration,
}

impl Study {
    /// Runs it undisturbed.
    pub fn new(seawall: &Path, mpi: Option<&Path>) -> Result<Study> {
        let root = tempfile::tempdir()?;
        let file = root.path().join("torture.toml");
        fs::write(&file, SWEEP)?;
        let seawall = fs::canonicalize(seawall).context("no such program")?;
        let mpi = mpi.map(fs::canonicalize).transpose().context("no such program with MPI")?;
        let (undisturbed, time) = (Files::new(), Duration::ZERO);
        let mut study = Study { seawall, mpi, root, file, undisturbed, time };
        let out = study.room("undisturbed")?;
        let start = Instant::now();
        let output = study.sweep(&out, &[])?;
        ensure!(output.status.success(), "the undisturbed sweep failed: {}", told(&output));
        study.time = start.elapsed();
        study.undisturbed = study.results(&out)?;
        Ok(study)
    }

    /// A place for a trial's results, where nothing is yet.
    pub fn room(&self, name: &str) -> Result<PathBuf> {
        let room = self.root.path().join("trial");
        if room.exists() {
            fs::remove_dir_all(&room)?;
        }
        fs::create_dir_all(&room)?;
        Ok(room.join(name))
    }

    /// The sweep, to be started.
    pub fn command(&self, out: &Path, more: &[&str]) -> Command {
        let mut command = Command::new(&self.seawall);
        command.arg("sweep").arg(&self.file).args(["--executor", "threads", "--threads", "2"]);
        command
            .args(["--film", "none"])
            .arg("--out")
            .arg(out)
            .args(more)
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command
    }

    /// Its sweep file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The program.
    pub fn program(&self) -> &Path {
        &self.seawall
    }

    /// The program with MPI.
    pub fn mpi(&self) -> Result<&Path> {
        self.mpi.as_deref().context("no program with MPI was given")
    }

    /// The sweep on so many MPI ranks, to be started.
    pub fn job(&self, out: &Path, ranks: usize, more: &[&str]) -> Result<Command> {
        let mut command = Command::new("mpirun");
        command.args(["-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none"]);
        command.arg(self.mpi()?).arg("sweep").arg(&self.file).args(["--threads", "1"]);
        command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
        command.args(["--film", "none", "--out"]).arg(out).args(more);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        Ok(command)
    }

    /// The sweep by the script that users have, to be started.
    pub fn script(&self, out: &Path) -> Result<Command> {
        // A shell cannot trap a signal that is ignored where it begins, as in the background of another.
        let mut command = Command::new("env");
        command.arg("--default-signal=INT");
        command.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/sweep"));
        command.env("SEAWALL_MPI_BINARY", self.mpi()?).arg(&self.file);
        command.args(["--film", "none", "--out"]).arg(out);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        Ok(command)
    }

    /// The sweep, to its end.
    pub fn sweep(&self, out: &Path, more: &[&str]) -> Result<Output> {
        Ok(self.command(out, more).output()?)
    }

    /// A finished sweep that nobody has disturbed.
    pub fn finished(&self, name: &str) -> Result<PathBuf> {
        let out = self.room(name)?;
        let output = self.sweep(&out, &[])?;
        ensure!(output.status.success(), "a sweep failed: {}", told(&output));
        Ok(out)
    }

    /// Another subcommand on its results.
    pub fn ask(&self, subcommand: &str, out: &Path) -> Result<Output> {
        Ok(Command::new(&self.seawall).arg(subcommand).arg(out).output()?)
    }

    /// What must be the same to the byte: summary without times, histories, pressures, energies.
    pub fn results(&self, out: &Path) -> Result<Files> {
        let mut files = Files::new();
        for folder in ["histories", "envelopes"] {
            for entry in fs::read_dir(out.join(folder))? {
                let path = entry?.path();
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                files.insert(format!("{folder}/{name}"), fs::read(&path)?);
            }
        }
        files.insert("energy.csv".to_owned(), fs::read(out.join("energy.csv"))?);
        files.insert("summary.csv".to_owned(), timeless(&out.join("summary.csv"))?);
        Ok(files)
    }
}

/// A table without the column of wall times.
fn timeless(path: &Path) -> Result<Vec<u8>> {
    let mut reader = csv::Reader::from_path(path)?;
    let header = reader.headers()?.clone();
    let time = header.iter().position(|name| name == "wall_time_s");
    let mut text = Vec::new();
    for row in std::iter::once(Ok(header)).chain(reader.records()) {
        for (at, cell) in row?.iter().enumerate().filter(|(at, _)| Some(*at) != time) {
            text.extend(format!("{at}:{cell};").into_bytes());
        }
    }
    Ok(text)
}

/// Sends a signal; whether there was somebody to get it.
pub fn signal(process: u32, name: &str) -> bool {
    let mut kill = Command::new("kill");
    let kill = kill.args([format!("-{name}"), process.to_string()]).stderr(Stdio::null());
    kill.status().is_ok_and(|status| status.success())
}

/// The processes that a process has started.
pub fn children(of: u32) -> Vec<u32> {
    let told = Command::new("pgrep").args(["-P", &of.to_string()]).output();
    let told = told.map(|output| output.stdout).unwrap_or_default();
    String::from_utf8_lossy(&told).lines().filter_map(|line| line.parse().ok()).collect()
}

/// What a process told on standard error, in one line.
pub fn told(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let is_rule = |line: &&str| !line.is_empty() && line.chars().all(|letter| letter == '-');
    text.lines().map(str::trim).filter(|line| !is_rule(line)).collect::<Vec<_>>().join(" / ")
}

/// Its exit code, or how else it ended.
pub fn code(output: &Output) -> String {
    output.status.code().map_or_else(|| output.status.to_string(), |code| code.to_string())
}

/// Waits for a process, but not for ever.
pub fn wait(mut child: Child) -> Result<Output> {
    let start = Instant::now();
    while child.try_wait()?.is_none() {
        if start.elapsed() > PATIENCE {
            child.kill()?;
            bail!("a process hung");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    Ok(child.wait_with_output()?)
}
