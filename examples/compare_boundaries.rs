//! Tables of the boundary comparison, from finished sweeps and the benchmark's output:
//!
//! `cargo run --release --example compare_boundaries -- RUNS_DIR OUT_DIR MACHINE`
//!
//! Reads `RUNS_DIR/<scene>/`, `RUNS_DIR/every_scene/<scene>/` and `RUNS_DIR/cost.csv`, writes one table
//! per scene, one of what survives where, and `OUT_DIR/summary.md` with all of them. Exit code 0 where
//! every case is well, 1 where one failed, 2 on bad input.

mod common;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Result, ensure};
use common::{Row, read};

/// A scene's directory, what it shows, and its columns: names in `summary.csv` or among the
/// readings; `noise:NAME` is the pressure noise of a probe.
const SCENES: [(&str, &str, &[&str]); 6] = [
    (
        "hydrostatic",
        "Still water, gaps of the pressure from rho g depth in percent over the whole run, noise in Pa",
        &[
            "ghost_gravity",
            "P0_worst_gap",
            "P0_mean_gap",
            "P1_worst_gap",
            "P1_mean_gap",
            "P2_worst_gap",
            "P2_mean_gap",
            "P1_drift",
            "noise:P0",
            "noise:P2",
        ],
    ),
    (
        "dam_break",
        "Dam break: times over sqrt(H/g), pressures over rho g H; measured: plateau 0.543, the front \
         at the wall at 2.43 and the cavity's closure at 5.98 in Huang et al. 2019",
        &[
            "ghost_gravity",
            "front_at_wall",
            "P1_low_arrival",
            "P1_low_plateau",
            "P1_low_plateau_noise",
            "P1_high_arrival",
            "P1_high_plateau",
            "P1_high_plateau_noise",
            "cavity_closure",
            "horizontal_momentum_gap",
        ],
    ),
    (
        "inclined_wall",
        "Solitary wave at a wall of 120 degrees: no truth at hand; noise in Pa",
        &["measured_wave_height_ratio", "runup_max", "P0_max", "P1_max", "noise:P0", "noise:P1"],
    ),
    (
        "fixed_wall",
        "Solitary wave at a vertical wall; potential theory: F* 2.998, R* 1.2255",
        &[
            "measured_wave_height_ratio",
            "first_force_max",
            "first_runup_max",
            "force_max_raw",
            "force_gap_percent",
            "energy_gap_percent",
        ],
    ),
    (
        "movable_wall",
        "Movable wall; potential theory for k = 500: F* 2.338, R* 0.839, X* 1.7526",
        &[
            "spring_stiffness_n_per_m",
            "first_force_max",
            "first_runup_max",
            "displacement_max",
            "force_max_raw",
            "force_gap_percent",
            "energy_gap_percent",
        ],
    ),
    (
        "shepard_weights",
        "Weights of improved Shepard under a wave at a vertical wall, 0.016 m",
        &[
            "shepard_lambda",
            "shepard_sigma",
            "measured_wave_height_ratio",
            "first_force_max",
            "first_runup_max",
            "force_max_raw",
            "force_gap_percent",
            "energy_gap_percent",
        ],
    ),
];

/// Scenes in which every interpolator runs with every preset and placement of gravity.
const EVERY_SCENE: [&str; 5] =
    ["hydrostatic", "dam_break", "fixed_wall", "movable_wall", "inclined_wall"];

/// Columns of every table.
const FIRST: [&str; 2] = ["boundary", "status"];
const LAST: [&str; 4] = ["boundary_fallbacks", "particles_lost", "particles", "steps"];

/// Root mean square of what a centred mean of five samples leaves, over the run's second half.
fn noise(samples: &[f64]) -> Option<f64> {
    let tail = &samples[samples.len() / 2..];
    let squares: Vec<f64> =
        tail.windows(5).map(|near| (near[2] - near.iter().sum::<f64>() / 5.0).powi(2)).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (!squares.is_empty()).then(|| mean.sqrt())
}

/// All that is known of a case by name.
fn gather(directory: &Path, mut row: Row) -> Result<Row> {
    let id = format!("{}.csv", row["case_id"]);
    let readings = directory.join("readings").join(&id);
    if readings.exists() {
        for reading in read(&readings)? {
            row.insert(reading["name"].clone(), reading["value"].clone());
        }
    }
    let probes = directory.join("probes").join(&id);
    if probes.exists() {
        let samples = read(&probes)?;
        for name in samples.first().into_iter().flat_map(Row::keys) {
            let values: Vec<f64> =
                samples.iter().filter_map(|row| row[name].parse().ok()).collect();
            if let Some(noise) = noise(&values) {
                row.insert(format!("noise:{name}"), noise.to_string());
            }
        }
    }
    Ok(row)
}

/// Four significant digits of a number, anything else as it stands.
fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value) if value.fract() != 0.0 => {
            let digits = 3 - value.abs().log10().floor().clamp(-3.0, 3.0) as i32;
            format!("{value:.*}", digits.max(0) as usize)
        }
        _ => text.to_owned(),
    }
}

fn push_table(report: &mut String, columns: &[String], rows: &[Vec<String>]) {
    let _ = writeln!(report, "| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len()));
    for row in rows {
        let _ = writeln!(report, "| {} |", row.join(" | "));
    }
}

fn write_csv(path: &Path, columns: &[String], rows: &[Vec<String>]) -> Result<()> {
    let mut writer = csv::Writer::from_path(path)?;
    writer.write_record(columns)?;
    rows.iter().try_for_each(|row| writer.write_record(row))?;
    Ok(writer.flush()?)
}

/// Costs with their ratios to improved Shepard beside them.
fn costs(path: &Path) -> Result<(Vec<String>, Vec<Vec<String>>)> {
    let rows = read(path)?;
    let names = ["ns_per_ghost", "us_per_step_ghosts", "us_per_step_total"];
    let mut columns: Vec<String> =
        ["table", "particles", "boundary"].into_iter().chain(names).map(str::to_owned).collect();
    columns.extend(["ghosts_percent", "ratio_to_improved_shepard"].map(str::to_owned));
    let told = rows.iter().map(|row| {
        let base = rows.iter().find(|other| {
            other["boundary"] == "improved-shepard"
                && ["table", "particles"].iter().all(|key| other[*key] == row[*key])
        });
        let ratios: Vec<String> = names
            .iter()
            .filter_map(|name| {
                let (a, b) = (row[*name].parse::<f64>().ok()?, base?[*name].parse::<f64>().ok()?);
                Some(format!("{:.2}", a / b))
            })
            .collect();
        let mut cells: Vec<String> = columns[..7].iter().map(|name| row[name].clone()).collect();
        cells.push(ratios.join(" "));
        cells
    });
    let told = told.collect();
    Ok((columns, told))
}

/// Why a failed case failed, or how much of the work is unaccounted for and how many ghosts fell back.
fn fate(row: &Row) -> String {
    if row["status"] == "ok" {
        format!("{} %, {}", short(&row["energy_gap_percent"]), row["boundary_fallbacks"])
    } else {
        row["reason"].split(" at t = ").next().unwrap_or_default().to_owned()
    }
}

/// One line per preset, placement and interpolator, one column per scene.
fn survival(runs: &Path) -> Result<(Vec<String>, Vec<Vec<String>>)> {
    let keys = ["preset", "ghost_gravity", "boundary"];
    let columns = keys.into_iter().chain(EVERY_SCENE).map(str::to_owned).collect();
    let mut lines: Vec<Vec<String>> = Vec::new();
    for (number, scene) in EVERY_SCENE.into_iter().enumerate() {
        for row in read(&runs.join("every_scene").join(scene).join("summary.csv"))? {
            let case = keys.map(|key| row[key].clone());
            let line = match lines.iter().position(|line| line[..3] == case) {
                Some(line) => line,
                None => {
                    lines.push(case.into());
                    lines.len() - 1
                }
            };
            lines[line].resize(3 + number, String::new());
            lines[line].push(fate(&row));
        }
    }
    Ok((columns, lines))
}

fn compare(runs: &Path, out: &Path, machine: &str) -> Result<bool> {
    fs::create_dir_all(out)?;
    let mut report = format!(
        "# Boundary interpolators compared\n\nWritten by `scripts/boundary_comparison` on {machine}. \
         What it says stands in [README.md](README.md).\n"
    );
    let mut well = true;
    for (scene, title, columns) in SCENES {
        let directory = runs.join(scene);
        let columns: Vec<String> =
            FIRST.iter().chain(columns).chain(&LAST).map(|&name| name.to_owned()).collect();
        let mut rows = Vec::new();
        for row in read(&directory.join("summary.csv"))? {
            let row = gather(&directory, row)?;
            well &= row["status"] == "ok";
            let cell = |name: &String| row.get(name).map(|text| short(text)).unwrap_or_default();
            rows.push(columns.iter().map(cell).collect::<Vec<_>>());
        }
        ensure!(!rows.is_empty(), "{scene}: no cases");
        write_csv(&out.join(format!("{scene}.csv")), &columns, &rows)?;
        let _ = writeln!(report, "\n## {title}\n");
        push_table(&mut report, &columns, &rows);
    }
    let (columns, rows) = survival(runs)?;
    write_csv(&out.join("every_scene.csv"), &columns, &rows)?;
    report.push_str(
        "\n## Every method in every scene, short and coarse: the energy unaccounted for in percent of \
         the paddle's work (of the potential energy at the start, without a paddle; above zero it is \
         lost) and the fallbacks, or why the run ended\n\n",
    );
    push_table(&mut report, &columns, &rows);
    let (columns, rows) = costs(&runs.join("cost.csv"))?;
    write_csv(&out.join("cost.csv"), &columns, &rows)?;
    report.push_str("\n## Cost: the ghost pass alone, and within whole steps of a wave case\n\n");
    push_table(&mut report, &columns, &rows);
    fs::write(out.join("summary.md"), &report)?;
    print!("{report}");
    Ok(well)
}

fn run() -> Result<bool> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [runs, out, machine] = &arguments[..] else {
        anyhow::bail!("usage: compare_boundaries RUNS_DIR OUT_DIR MACHINE");
    };
    compare(Path::new(runs), Path::new(out), machine)
}

fn main() -> ExitCode {
    common::exit("compare_boundaries", run())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_what_a_straight_course_lacks() {
        let line: Vec<f64> = (0..100).map(|k| 3.0 + 0.5 * f64::from(k)).collect();
        assert!(noise(&line).unwrap() < 1e-9);
        let rough: Vec<f64> = line.iter().zip([1.0, -1.0].repeat(50)).map(|(a, b)| a + b).collect();
        assert!((noise(&rough).unwrap() - 0.8).abs() < 0.05);
        assert_eq!(noise(&[]), None);
    }

    #[test]
    fn a_case_is_told_by_its_end() {
        let row = |cells: &[(&str, &str)]| {
            cells.iter().map(|&(key, value)| (key.to_owned(), value.to_owned())).collect::<Row>()
        };
        let well =
            [("status", "ok"), ("energy_gap_percent", "0.47371"), ("boundary_fallbacks", "12")];
        assert_eq!(fate(&row(&well)), "0.4737 %, 12");
        let reason = "runaway-speed at t = 0.63 s: particle 7";
        assert_eq!(fate(&row(&[("status", "failed"), ("reason", reason)])), "runaway-speed");
    }

    #[test]
    fn numbers_are_shortened() {
        let told = ["1.23456", "-0.00123456", "1234.567", "12", "sfdi", ""].map(short);
        assert_eq!(told, ["1.235", "-0.001235", "1235", "12", "sfdi", ""]);
    }
}
