//! This tank by fully nonlinear potential theory, independent of all particles:
//!
//! `cargo run --release --example potential_tank -- --fixed 0.1,0.3 --sweep FILE --out FILE.csv`
//!
//! Waves on fixed and spring-mounted walls, inviscid and incompressible, until the surface breaks.
//! `results/potential/README.md` tells the method and what it was checked against.

mod cases;
mod conjugate;
mod gmres;
mod grid;
mod law;
mod measures;
mod motion;
mod readings;
mod settings;
mod table;
mod tank;
mod water;
mod window;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Result, ensure};
use clap::Parser;

use cases::Case;
use settings::Settings;
use table::Table;
use tank::{Stopped, Tank};

/// The wall can move only after the force has passed this share of its weight at rest.
const BRANCHING: f64 = 1.05;

/// Fully nonlinear potential theory of the tank.
#[derive(Parser)]
struct Arguments {
    /// Fixed walls at these H/h
    #[arg(long, value_delimiter = ',')]
    fixed: Vec<f64>,
    /// Every case of this sweep file's grid
    #[arg(long)]
    sweep: Option<PathBuf>,
    /// Every case of this table: wave_height_ratio, spring_stiffness_n_per_m, seawall_mass_kg_per_m
    #[arg(long)]
    cases: Option<PathBuf>,
    /// The table to write
    #[arg(long)]
    out: PathBuf,
    /// Writes a history per case into this directory
    #[arg(long)]
    histories: Option<PathBuf>,
    #[command(flatten)]
    settings: Settings,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let mut cases: Vec<Case> = arguments.fixed.iter().map(|h| Case::fixed(*h)).collect();
    if let Some(path) = &arguments.sweep {
        cases.extend(cases::of_sweep(path)?);
    }
    if let Some(path) = &arguments.cases {
        cases.extend(cases::of_table(path)?);
    }
    ensure!(!cases.is_empty(), "no cases: give --fixed, --sweep or --cases");
    ensure!(arguments.settings.nodes >= 33, "--nodes must be at least 33");
    let mut table = Table::create(&arguments.out)?;
    let mut trunks = Trunks { settings: arguments.settings, height: f64::NAN, tanks: Vec::new() };
    for case in &cases {
        let started = Instant::now();
        let (tank, status) = run(case, &mut trunks);
        table.write(case, &tank.readings, arguments.settings.nodes, &status)?;
        if let Some(directory) = &arguments.histories {
            table::write_history(directory, case, &tank.readings)?;
        }
        let (told, steps) = (case.parameters().join(" "), tank.steps());
        eprintln!("{told}: {status}, {steps} steps, {:.1} s", started.elapsed().as_secs_f64());
    }
    Ok(())
}

/// Runs a case with one setting after the other until one of them reaches the end; else the one that
/// came farthest counts.
fn run(case: &Case, trunks: &mut Trunks) -> (Tank, String) {
    let mut farthest: Option<(Tank, String)> = None;
    for (attempt, settings) in trunks.settings.attempts().into_iter().enumerate() {
        let mut tank = trunks.tank(case.wave_height_ratio, attempt);
        if let Some(spring) = case.spring {
            tank.mount(spring);
        }
        let Settings { smoothing, floor, .. } = settings;
        let with = match attempt {
            0 => String::new(),
            _ => format!(" (smoothing {smoothing} floor {floor})"),
        };
        match tank.run(|_| false) {
            Ok(()) => return (tank, format!("ok{with}")),
            Err(Stopped { reason, time }) => {
                if farthest.as_ref().is_none_or(|(best, _)| time > best.time()) {
                    farthest = Some((tank, format!("stopped at {time:.3} s: {reason}{with}")));
                }
            }
        }
    }
    farthest.expect("there is at least one attempt")
}

/// The stretches that all walls under a wave share, one per attempt.
struct Trunks {
    settings: Settings,
    height: f64,
    tanks: Vec<Tank>,
}

impl Trunks {
    /// The tank shortly before its wall can move; a trunk that fails does so again at once.
    fn tank(&mut self, wave_height_ratio: f64, attempt: usize) -> Tank {
        if self.height != wave_height_ratio {
            self.height = wave_height_ratio;
            self.tanks.clear();
        }
        while self.tanks.len() <= attempt {
            let settings = self.settings.attempts()[self.tanks.len()];
            let mut tank = Tank::new(wave_height_ratio, settings);
            let _ = tank.run(|tank| tank.readings.force() > BRANCHING);
            self.tanks.push(tank);
        }
        self.tanks[attempt].clone()
    }
}
