//! The command line: one file per subcommand, and `commands.rs`, which names them all.
//!
//! Exit codes: 0 all well; 1 some case failed; 2 bad input or usage, nothing written; 3
//! interrupted, can be resumed; 70 internal error. Under an MPI launcher rank 0 alone validates,
//! prints and returns the code; the other ranks return 0.

mod accuracy;
mod answer;
mod check;
mod closed_study;
mod commands;
mod compare;
mod completions;
mod cost;
mod execute;
mod executor;
mod expected;
mod explain;
mod failed_cases;
mod failure;
mod film;
mod films;
mod find;
mod glossary;
mod goal;
mod highlights;
mod init;
mod input;
mod job;
mod known_limits;
mod lost_bars;
mod made_figure;
mod matrix;
mod max_error;
mod notices;
mod options;
mod output;
mod overview;
mod physics;
mod picked_case;
mod readme_words;
mod refine;
mod report;
mod reproduce;
mod run;
mod show;
mod slurm;
mod standing;
mod status;
mod stored;
mod stress;
mod sweep;
mod table;
mod time_to_go;
mod verify;
mod warnings;
mod watch;

use std::ffi::OsString;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, ColorChoice, CommandFactory, FromArgMatches, Parser};
use serde_json::json;

use self::commands::Subcommands;
use self::failure::BadInput;
use self::output::{Format, Output};
use crate::execute::{Launcher, apart, outlive_long_files};

const SUCCESS: u8 = 0;
/// Some case failed; the others' results are complete.
const CASES_FAILED: u8 = 1;
/// Bad input or usage; nothing was written.
const BAD_INPUT: u8 = 2;
/// Stopped by a signal; the journal is whole.
const INTERRUPTED: u8 = 3;
/// The program or the machine failed.
const INTERNAL: u8 = 70;

/// Parameter sweeps of SPH simulations of solitary waves on fixed and spring-mounted seawalls.
#[derive(Debug, Parser)]
#[command(name = "seawall", version, propagate_version = true)]
#[command(after_help = "Start with: seawall init my_study")]
struct Cli {
    #[command(flatten)]
    global: Global,
    #[command(subcommand)]
    command: Subcommands,
}

/// Options of every command.
#[derive(Debug, Clone, Args)]
struct Global {
    /// Print nothing but errors, and with `--format json` the answer.
    #[arg(long, global = true, display_order = 900)]
    quiet: bool,
    /// How results are printed.
    #[arg(long, global = true, display_order = 901, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// Print more; for example every case rather than the first few.
    #[arg(short, long, global = true, display_order = 902)]
    verbose: bool,
}

/// Runs the command line and returns the process's exit code.
pub fn main() -> ExitCode {
    let launcher = Launcher::detect();
    // Without this, a file above the size limit would end the program.
    let _ = outlive_long_files();
    let code = catch_unwind(AssertUnwindSafe(|| main_with(std::env::args_os(), launcher)));
    ExitCode::from(code.unwrap_or_else(|panic| {
        if asks_for_json(std::env::args_os()) && launcher.rank == 0 {
            let message = panic.downcast_ref::<String>().map(String::as_str);
            let message = message.or_else(|| panic.downcast_ref::<&str>().copied());
            failure::print_internal(message.unwrap_or("the program has failed"));
        }
        INTERNAL
    }))
}

/// Whether `--format json` is among the arguments, for errors before they are understood.
fn asks_for_json(arguments: impl Iterator<Item = OsString>) -> bool {
    let words: Vec<_> = arguments.collect();
    let pair = |pair: &[OsString]| pair[0] == "--format" && pair[1] == "json";
    words.windows(2).any(pair) || words.iter().any(|word| word == "--format=json")
}

/// The definition of the command line.
fn command(launcher: Launcher) -> clap::Command {
    let never = launcher.present || std::env::var_os("NO_COLOR").is_some_and(|set| !set.is_empty());
    // Under mpirun standard output is a pseudo-terminal even when it ends in a file.
    if never { Cli::command().color(ColorChoice::Never) } else { Cli::command() }
}

fn main_with(arguments: impl IntoIterator<Item = OsString>, launcher: Launcher) -> u8 {
    let arguments: Vec<_> = arguments.into_iter().collect();
    let as_json = asks_for_json(arguments.iter().cloned());
    let parsed = command(launcher)
        .try_get_matches_from(arguments)
        .and_then(|matches| Cli::from_arg_matches(&matches));
    let cli = match parsed {
        Ok(cli) => cli,
        Err(_) if launcher.rank > 0 && !launcher.several => return SUCCESS,
        Err(error) => {
            let whole = error.to_string();
            // The list of subcommands has the hidden one, too.
            let plain = whole.replace(&format!(" {},", apart::SUBCOMMAND), "");
            if as_json && error.use_stderr() {
                failure::print_usage(&plain);
            }
            if as_json && error.kind() == ErrorKind::DisplayVersion {
                failure::print(&json!({ "name": "seawall", "version": env!("CARGO_PKG_VERSION") }));
                return SUCCESS;
            }
            // If the output is closed, nobody can be told.
            let told = crate::keys::shown(&plain);
            let _ = match told == whole {
                true => error.print(),
                false => write!(std::io::stderr(), "{told}"),
            };
            return if error.use_stderr() { BAD_INPUT } else { SUCCESS };
        }
    };
    let output = Output::new(&cli.global, launcher);
    if let Err(reason) = cli.command.demand(launcher) {
        // A launcher may have set this on some ranks alone: each reports for itself.
        if launcher.rank > 0 {
            eprintln!("error: rank {}: {reason}", launcher.rank);
            return BAD_INPUT;
        }
        return failure::exit_code(Err(BadInput(reason).into()), launcher, output.is_json());
    }
    let result = cli.command.run(&output, launcher);
    failure::exit_code(result, launcher, output.is_json())
}

#[cfg(test)]
mod tests;
