//! `seawall run`: one scene.

use std::path::PathBuf;

use clap::Args;

use super::execute::{Job, on_threads};
use super::input::{Expect, Setting, SimdChoice, default_out, study};
use super::output::{Output, duration, short};
use super::table::Table;
use crate::execute::{Ending, VtkFilm};
use crate::results::{CaseRecord, OpenMode};
use crate::simulation::{EnergyBudget, Maximum, NamedReading, Outcome, PhaseShare};

/// Run one scene: its history, outcome, energy budget, and where the time went.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall run sweeps/scenes/fixed_wall.toml
  seawall run sweeps/scenes/fixed_wall.toml --set scene.wave_height_ratio=0.3 --out results/runs/h03
  seawall run sweeps/scenes/dam_break.toml --vtk 0.02
  seawall run sweeps/scenes/fixed_wall.toml --fresh --format json")]
pub(super) struct RunArgs {
    /// The scene file: name, [scene], [numerics], and no [grid].
    file: PathBuf,
    /// Where results go [default: results/runs/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Move an earlier run aside and start over.
    #[arg(long)]
    fresh: bool,
    /// Write the particles for ParaView into vtk/, every SECONDS of simulated time.
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = "0.05")]
    vtk: Option<Seconds>,
    /// Threads that share the work, as far as there are 2,000 particles for each; the results are
    /// the same for any number [default: the processors that it may use].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Instruction set of the hot loops.
    #[arg(long, value_enum, default_value_t = SimdChoice::Auto)]
    simd: SimdChoice,
    /// Set a value by its path, such as scene.wave_height_ratio=0.3; repeatable.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

/// A time above 0.
#[derive(Debug, Clone, Copy)]
struct Seconds(f64);

impl std::str::FromStr for Seconds {
    type Err = String;

    fn from_str(text: &str) -> Result<Seconds, String> {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value > 0.0);
        value.map(Seconds).ok_or_else(|| "must be a finite number of seconds above 0".to_owned())
    }
}

pub(super) fn main(args: &RunArgs, output: &Output) -> anyhow::Result<u8> {
    let study = study(&args.file, &args.settings, Expect::SingleScene)?;
    let job = Job {
        out: args.out.clone().unwrap_or_else(|| default_out(&study)),
        study,
        mode: if args.fresh { OpenMode::Fresh } else { OpenMode::Resume },
        retry_failed: true,
        branching: false,
        shares_threads: true,
        simd: args.simd.path(),
        overrides: args.settings.iter().map(|setting| setting.text.clone()).collect(),
    };
    let folder = job.out.join("vtk");
    let film = args.vtk.map(|Seconds(interval_s)| VtkFilm { interval_s, folder });
    let done = on_threads(&job, args.threads, film, output)?;
    if args.vtk.is_some() && done.wall_time_s.is_none() {
        output.note("--vtk: nothing was filmed, as nothing was run; --fresh films it");
    }
    if done.ending == Ending::Interrupted {
        output.note("interrupted: a single scene starts over");
    }
    for record in done.records() {
        let text = format!("{}files: {}\n", told(record), done.directory.path().display());
        output.result(&text, record)?;
    }
    Ok(done.exit_code())
}

fn told(record: &CaseRecord) -> String {
    let mut text = format!("case {}", record.id);
    let (Some(outcome), Some(energy)) = (&record.outcome, &record.energy) else {
        text.push_str(&format!(" failed: {}\n", record.reason));
        return text;
    };
    text.push_str(&format!(", {}\n\n", duration(record.wall_time_s)));
    text.push_str(&outcome_table(outcome));
    if !record.readings.is_empty() {
        text.push_str("\nreadings\n");
        text.push_str(&readings_table(&record.readings));
    }
    text.push_str("\nenergy budget            J/m  % of paddle work\n");
    text.push_str(&energy_table(energy, outcome.energy_gap_percent));
    text.push_str("\nwhere the time went\n");
    text.push_str(&phase_table(&record.phases));
    text
}

fn outcome_table(outcome: &Outcome) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            text.push_str(&format!("{name:<32}{value}\n"));
        }
    };
    let maximum = |maximum: Option<Maximum>| {
        maximum.map(|maximum| format!("{} at {:.4} s", short(maximum.value), maximum.time_s))
    };
    // At the very end and still moving: the maximum is yet to come.
    let displacement = |own: Option<Maximum>| {
        let at_end = own.is_some() && own == outcome.displacement_max;
        if at_end && outcome.displacement_truncated == Some(true) {
            return maximum(own).map(|text| format!("≥ {text}, still moving at the end"));
        }
        maximum(own)
    };
    line("measured H/h", outcome.measured_wave_height_ratio.map(short));
    line("largest F*", maximum(Some(outcome.force_max)));
    line("largest R*", maximum(Some(outcome.runup_max)));
    line("largest X*", displacement(outcome.displacement_max));
    line("first impact, largest F*", maximum(outcome.first_force_max));
    line("first impact, largest R*", maximum(outcome.first_runup_max));
    line("first impact, largest X*", displacement(outcome.first_displacement_max));
    line("first peak, F*", outcome.first_force_peak.map(short));
    line("first peak, R*", outcome.first_runup_peak.map(short));
    line("largest F* of any step", Some(short(outcome.force_max_raw)));
    line(
        "F*, R* at the end",
        Some(format!("{}, {}", short(outcome.force_end), short(outcome.runup_end))),
    );
    line("X* at the end", outcome.displacement_end.map(short));
    line("onset", outcome.onset_time_s.map(|time| format!("{time:.4} s")));
    line("stroke centre", outcome.stroke_centre_s.map(|time| format!("{time:.4} s")));
    line("hits on the stop", outcome.stops.map(|stops| stops.to_string()));
    line("strongest impulse of a stop", maximum(outcome.stop_impulse.filter(|m| m.value != 0.0)));
    line("doubtful", outcome.doubtful_reason.clone());
    line("force gap", Some(format!("{} %", short(outcome.force_gap_percent))));
    line("particles, lost", Some(format!("{}, {}", outcome.particles, outcome.particles_lost)));
    line("steps", Some(outcome.steps.to_string()));
    line("pair evaluations", Some(outcome.pair_evaluations.to_string()));
    line("boundary fallbacks", Some(outcome.boundary_fallbacks.to_string()));
    text
}

fn readings_table(readings: &[NamedReading]) -> String {
    let mut table = Table::default();
    for reading in readings {
        table.row([reading.name.clone(), short(reading.value), reading.unit.clone()]);
    }
    table.render()
}

/// Every term, its share of the paddle's work, and what is left over.
fn energy_table(energy: &EnergyBudget, gap_percent: f64) -> String {
    let spent = [
        ("kinetic", energy.kinetic),
        ("potential", energy.potential),
        ("elastic", energy.elastic),
        ("wall, kinetic", energy.wall_kinetic),
        ("spring", energy.spring),
        ("threshold device", energy.threshold_device),
        ("stops", energy.stops),
        ("viscous", energy.viscous),
        ("density diffusion", energy.density_diffusion),
        ("shifting", energy.shifting),
    ];
    let total: f64 = spent.iter().map(|(_, value)| value).sum();
    let mut text = String::new();
    let mut line = |name: &str, value: f64| {
        let share = match energy.paddle_work {
            0.0 => "-".to_owned(),
            work => format!("{:.2}", 100.0 * value / work),
        };
        text.push_str(&format!("{name:<18}{:>10}  {share:>16}\n", short(value)));
    };
    line("paddle work", energy.paddle_work);
    for (name, value) in spent {
        line(name, value);
    }
    line("residual", energy.paddle_work - total);
    text.push_str(&format!("reported gap {gap_percent:.2} %\n"));
    text
}

fn phase_table(phases: &[PhaseShare]) -> String {
    let total: f64 = phases.iter().map(|phase| phase.seconds).sum();
    let mut table = Table::default();
    for phase in phases {
        let share = if total > 0.0 { 100.0 * phase.seconds / total } else { 0.0 };
        let seconds = format!("{:.2} s", phase.seconds);
        table.row([phase.phase.clone(), seconds, format!("{share:.1} %")]);
    }
    table.render()
}
