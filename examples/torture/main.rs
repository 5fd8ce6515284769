//! Causes every fault that a sweep should survive, many times, and says what came of it.
//!
//! `cargo run --release --example torture -- SEAWALL OUT.md [--trials N] [--fault NAME] [--mpi PROGRAM]`
//!
//! Every trial is judged by the results of a sweep that nobody disturbed: after the fault, and after the
//! command that a user would give next, they must be the same to the byte. Exit code 0 all well, 1 where
//! something was lost or wrong unseen, 2 on bad input.

mod calls;
mod damage;
mod faults;
mod processes;
mod ranks;
mod study;

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::Parser;

use seawall::math::words::counted;

use faults::{FAULTS, Fault, Needs, Verdict};
use study::Study;

/// Causes faults and says what came of them.
#[derive(Parser)]
struct Arguments {
    /// The program
    seawall: PathBuf,
    /// The table to write
    out: PathBuf,
    /// How often each fault is caused
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u64).range(1..))]
    trials: u64,
    /// The program with MPI, for faults of ranks
    #[arg(long)]
    mpi: Option<PathBuf>,
    /// Only this fault
    #[arg(long)]
    fault: Option<String>,
}

fn main() -> ExitCode {
    match torture(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("torture: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn torture(arguments: &Arguments) -> Result<bool> {
    let chosen = |fault: &&Fault| arguments.fault.as_deref().is_none_or(|name| name == fault.name);
    if let Some(name) = &arguments.fault {
        let names: Vec<_> = FAULTS.iter().map(|fault| fault.name).collect();
        anyhow::ensure!(names.contains(&&**name), "--fault {name}: there are {}", names.join(", "));
    }
    let study = Study::new(&arguments.seawall, arguments.mpi.as_deref())?;
    let mut text = format!(
        "# Faults\n\nWritten by `scripts/torture`. Each fault was caused {}, at moments and places \
         spread over the whole run. *Whole* counts the trials after which the results were those of an \
         undisturbed sweep, to the byte. *Refused* counts those in which the program said that it cannot go on, \
         and touched nothing. *Lost* counts those with any other end.\n\n\
         | fault | trials | whole | refused | lost | exit codes | what the user sees, once |\n\
         |---|---|---|---|---|---|---|\n",
        counted(arguments.trials as usize, "time")
    );
    let mut well = true;
    for fault in FAULTS.iter().filter(chosen) {
        let missing = match fault.needs {
            Needs::Nothing => None,
            Needs::Strace => (!calls::is_there()).then_some("strace"),
            Needs::Mpi => arguments.mpi.is_none().then_some("--mpi PROGRAM"),
        };
        if let Some(missing) = missing {
            eprintln!("{}: skipped: it needs {missing}", fault.name);
            continue;
        }
        let tally = Tally::of(fault, &study, arguments.trials)?;
        well &= tally.lost.is_empty();
        writeln!(text, "{}", tally.row(fault))?;
        eprintln!("{}", tally.row(fault));
        tally.lost.iter().for_each(|lost| eprintln!("{}: LOST: {lost}", fault.name));
    }
    std::fs::write(&arguments.out, text)
        .with_context(|| format!("cannot write {}", arguments.out.display()))?;
    Ok(well)
}

/// What came of a fault's trials.
#[derive(Default)]
struct Tally {
    trials: u64,
    whole: u64,
    refused: u64,
    lost: Vec<String>,
    codes: std::collections::BTreeMap<String, u64>,
    seen: String,
}

impl Tally {
    fn of(fault: &Fault, study: &Study, trials: u64) -> Result<Tally> {
        let mut tally = Tally { trials, ..Tally::default() };
        for trial in 0..trials {
            let share = (trial as f64 + 0.5) / trials as f64;
            let outcome = (fault.cause)(study, trial, share)
                .with_context(|| format!("{}, trial {trial}", fault.name))?;
            *tally.codes.entry(outcome.code).or_default() += 1;
            if tally.seen.is_empty() {
                tally.seen = outcome.seen;
            }
            match outcome.verdict {
                Verdict::Whole => tally.whole += 1,
                Verdict::Refused => tally.refused += 1,
                Verdict::Lost(what) => tally.lost.push(format!("trial {trial}: {what}")),
            }
        }
        Ok(tally)
    }

    fn row(&self, fault: &Fault) -> String {
        let codes = self.codes.iter().map(|(code, count)| format!("{code} ({count})"));
        let codes = codes.collect::<Vec<_>>().join(", ");
        let Tally { trials, whole, refused, seen, .. } = self;
        let lost = self.lost.len();
        format!("| {} | {trials} | {whole} | {refused} | {lost} | {codes} | {seen} |", fault.what)
    }
}
