//! Tables of `results/scenes`, from the finished runs of `scripts/scenes`:
//!
//! `cargo run --release --example scenes -- RUNS_DIR OUT_DIR`
//!
//! A part of which `RUNS_DIR` has runs gets its table anew, `OUT_DIR/<part>.csv`; `OUT_DIR/scenes.md` then
//! shows all the tables that are there. Exit code 0 where every run is well, 1 where one failed, 2 on bad
//! input.

#[allow(dead_code)] // Each example takes a part.
#[path = "common/runs.rs"]
mod runs;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result, ensure};
use runs::{Row, Table, gather, markdown, short, write};

/// A part of the scenes, and what its table shows.
struct Part {
    /// Folder of the runs, and the table's name.
    name: &'static str,
    title: &'static str,
    /// What tells its runs apart, in the order by which they are sorted.
    keys: &'static [&'static str],
    /// What a key is where no `--set` changes it.
    defaults: &'static [(&'static str, &'static str)],
    /// Names in `summary.csv` or among the readings. What no run has is left out.
    columns: &'static [&'static str],
}

const PARTS: [Part; 4] = [
    Part {
        name: "still",
        title: "Still water for 35 s: largest gap at any time in percent of rho g h, mean gap and drift in \
                percent of rho g (h - y)",
        keys: &["boundary", "ghost_gravity"],
        defaults: &[],
        columns: &[
            "P0_worst_gap_full",
            "P1_worst_gap_full",
            "P2_worst_gap_full",
            "P3_worst_gap_full",
            "P0_mean_gap",
            "P1_mean_gap",
            "P2_mean_gap",
            "P3_mean_gap",
            "P0_drift",
            "P1_drift",
            "P2_drift",
            "P3_drift",
            "boundary_fallbacks",
            "particles_lost",
            "energy_gap_percent",
        ],
    },
    Part {
        name: "dam_break",
        title: "Dam break: times over sqrt(H/g), lengths over H, pressures over rho g H, gaps in percent",
        keys: &["preset", "slip", "initial_density", "particle_spacing_m"],
        defaults: &[("preset", "huang2019"), ("slip", "free"), ("initial_density", "dam-break")],
        columns: &[
            "particles",
            "front_at_wall",
            "P1_low_arrival",
            "P1_high_arrival",
            "P1_low_plateau",
            "P1_high_plateau",
            "P1_low_plateau_noise",
            "P1_high_plateau_noise",
            "cavity_closure",
            "front_at_1",
            "front_at_1.5",
            "front_at_2",
            "corner_ringing",
            "particles_lost",
            "mass_gap",
            "horizontal_momentum_gap",
            "energy_gap_percent",
        ],
    },
    Part {
        name: "inclines",
        title: "Water at rest at an inclined wall for 2 s: largest gap at any time in percent of rho g h, by \
                the gauge's height; of the two uppermost the mean in percent of rho g (h - y) too",
        keys: &["wall_angle_deg", "sound_speed_ratio", "particle_spacing_m"],
        defaults: &[("sound_speed_ratio", "15")],
        columns: &[
            "y_0.0m_worst_gap_full",
            "y_0.02m_worst_gap_full",
            "y_0.05m_worst_gap_full",
            "y_0.1m_worst_gap_full",
            "y_0.15m_worst_gap_full",
            "y_0.2m_worst_gap_full",
            "y_0.22m_worst_gap_full",
            "y_0.23m_worst_gap_full",
            "y_0.24m_worst_gap_full",
            "y_0.23m_mean_gap",
            "y_0.24m_mean_gap",
            "particles_lost",
        ],
    },
    Part {
        name: "waves",
        title: "A wave of H/h = 0.6 at an upright and an inclined wall: pressures in Pa, void as a share",
        keys: &["scene", "particle_spacing_m", "time_step_s"],
        defaults: &[],
        columns: &[
            "particles",
            "steps",
            "measured_wave_height_ratio",
            "force_max",
            "first_force_max",
            "runup_max",
            "first_runup_max",
            "P0_max",
            "P1_max",
            "void_max",
            "particles_lost",
            "energy_gap_percent",
        ],
    },
];

/// The directories with runs under `directory`, itself included.
fn finished(directory: &Path) -> Vec<PathBuf> {
    let inside = fs::read_dir(directory).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut all: Vec<_> = inside.chain([directory.to_owned()]).collect();
    all.retain(|path| path.join("manifest.json").exists() && path.join("summary.csv").exists());
    all.sort();
    all
}

impl Part {
    /// The table from the runs, and whether all of them are well; `None` where there are no runs.
    fn table(&self, runs: &Path) -> Result<Option<(Table, bool)>> {
        let mut rows = Vec::new();
        for directory in finished(&runs.join(self.name)) {
            rows.extend(gather(&directory)?);
        }
        if rows.is_empty() {
            return Ok(None);
        }
        for row in &mut rows {
            for (key, value) in self.defaults {
                row.entry((*key).to_owned()).or_insert_with(|| (*value).to_owned());
            }
        }
        let cell = |row: &Row, name: &str| row.get(name).cloned().unwrap_or_default();
        let place = |row: &Row| {
            let sorted = |key: &&str| {
                let text = cell(row, key);
                // Finer spacings come later.
                let sign = if *key == "particle_spacing_m" { -1.0 } else { 1.0 };
                (sign * text.parse().unwrap_or(0.0), text)
            };
            self.keys.iter().map(sorted).collect::<Vec<_>>()
        };
        rows.sort_by(|a, b| place(a).partial_cmp(&place(b)).expect("keys are numbers or words"));
        let well = rows.iter().all(|row| row["status"] == "ok");
        let given = |name: &&str| rows.iter().any(|row| !cell(row, name).is_empty());
        let told = |row: &Row, name: &str| {
            let text = cell(row, name);
            if self.keys.contains(&name) { text } else { short(&text) }
        };
        let all = self.keys.iter().chain(&["status"]).chain(self.columns).chain(&["reason"]);
        let names: Vec<&str> = all.copied().filter(given).collect();
        let mut table = vec![names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>()];
        table.extend(rows.iter().map(|row| names.iter().map(|name| told(row, name)).collect()));
        Ok(Some((table, well)))
    }
}

/// All tables of the directory in one page.
fn page(out: &Path) -> Result<String> {
    let mut text =
        "# Scenes of Huang et al. 2019: all tables\n\nWritten by `scripts/scenes`. What they say \
                    stands in [README.md](README.md).\n"
            .to_owned();
    for Part { name, title, .. } in PARTS {
        let path = out.join(format!("{name}.csv"));
        if !path.exists() {
            continue;
        }
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(&path)?;
        let rows = reader.records().map(|row| Ok(row?.iter().map(str::to_owned).collect()));
        let table = rows.collect::<Result<Table>>()?;
        text += &format!("\n## {title}\n\n{}", markdown(&table));
    }
    Ok(text)
}

fn run() -> Result<bool> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [runs, out] = &arguments[..] else { anyhow::bail!("usage: scenes RUNS_DIR OUT_DIR") };
    let (runs, out) = (Path::new(runs), Path::new(out));
    let (mut any, mut well) = (false, true);
    for part in PARTS {
        let Some((table, good)) = part.table(runs).with_context(|| part.name)? else { continue };
        (any, well) = (true, well && good);
        write(&out.join(format!("{}.csv", part.name)), &table)?;
    }
    ensure!(any, "no finished runs in {}", runs.display());
    fs::write(out.join("scenes.md"), page(out)?)?;
    Ok(well)
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("scenes: {error:#}");
            ExitCode::from(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A directory with one run per (spacing, measured) pair.
    fn runs_with(part: &str, runs: &[(&str, &str)]) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        for (spacing, loss) in runs {
            let run = root.path().join(part).join(spacing);
            fs::create_dir_all(&run).unwrap();
            let summary = format!(
                "case_id,status,particle_spacing_m,energy_gap_percent,P0_max\na,ok,{spacing},{loss},1\n"
            );
            fs::write(run.join("summary.csv"), summary).unwrap();
            let manifest =
                r#"{"name": "inclined_wall", "overrides": ["numerics.time_step_s=1e-4"]}"#;
            fs::write(run.join("manifest.json"), manifest).unwrap();
        }
        root
    }

    #[test]
    fn a_table_has_the_columns_that_some_run_fills_and_ends_with_the_finest() {
        let root = runs_with("waves", &[("0.005", "0.12345"), ("0.02", "4")]);
        let (table, well) = PARTS[3].table(root.path()).unwrap().unwrap();
        assert!(well);
        let expected = [
            "scene",
            "particle_spacing_m",
            "time_step_s",
            "status",
            "P0_max",
            "energy_gap_percent",
        ];
        assert_eq!(table[0], expected);
        assert_eq!(table[1], ["inclined_wall", "0.02", "1e-4", "ok", "1", "4"]);
        assert_eq!(table[2][5], "0.1235");
        assert!(PARTS[0].table(root.path()).unwrap().is_none(), "no runs, no table");
    }
}
