//! The command line: one file per subcommand.
//!
//! Exit codes: 0 all well; 1 some case failed; 2 bad input or usage, nothing written;
//! 3 interrupted, to be gone on with; 70 internal error. Under an MPI launcher rank 0 alone
//! validates, prints and returns the code; the other ranks return 0.

mod accuracy;
mod answer;
mod check;
mod closed;
mod compare;
mod completions;
mod cost;
mod execute;
mod executor;
mod explain;
mod failure;
mod film;
mod films;
mod find;
mod glossary;
mod highlights;
mod init;
mod input;
mod job;
mod matrix;
mod max_error;
mod notices;
mod options;
mod output;
mod overview;
mod physics;
mod pick;
mod printed;
mod refine;
mod report;
mod reproduce;
mod run;
mod show;
mod slurm;
mod status;
mod stored;
mod stress;
mod sweep;
mod table;
mod things;
mod verify;
mod warnings;
mod watch;

use std::ffi::OsString;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};

use serde_json::json;

use self::failure::BadInput;
use self::output::{Format, Output};
use crate::execute::{Launcher, SphRunner, apart, outlive_long_files, widest_simd};

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

#[derive(Debug, Subcommand)]
enum Subcommands {
    Sweep(sweep::SweepArgs),
    Run(run::RunArgs),
    Film(film::FilmArgs),
    Check(check::CheckArgs),
    Init(init::InitArgs),
    Explain(explain::ExplainArgs),
    Status(status::StatusArgs),
    Slurm(slurm::SlurmArgs),
    Verify(verify::VerifyArgs),
    Show(show::ShowArgs),
    Report(report::ReportArgs),
    Find(find::FindArgs),
    Compare(compare::CompareArgs),
    Reproduce(reproduce::ReproduceArgs),
    Accuracy(accuracy::AccuracyArgs),
    Stress(stress::StressArgs),
    /// Does a piece of a sweep's work, read from standard input.
    #[command(name = apart::SUBCOMMAND, hide = true)]
    Apart,
    Completions(completions::CompletionsArgs),
    Man(completions::ManArgs),
}

/// Whether the environment lowers the instruction set of a command that computes to one that there is.
fn simd_limit(command: &Subcommands) -> Result<(), String> {
    let computes = match command {
        Subcommands::Sweep(args) => !args.dry_run,
        Subcommands::Verify(args) => args.rerun > 0,
        Subcommands::Run(_)
        | Subcommands::Film(_)
        | Subcommands::Reproduce(_)
        | Subcommands::Accuracy(_)
        | Subcommands::Stress(_)
        | Subcommands::Apart => true,
        _ => false,
    };
    if computes { widest_simd().map(|_| ()) } else { Ok(()) }
}

/// Refuses what does not join the other ranks where a launcher was given several commands: one that is a sweep would
/// wait for it without end.
fn joins(command: &Subcommands, launcher: Launcher) -> Result<(), String> {
    // A child of a sweep's has its work from there.
    let joins = matches!(command, Subcommands::Apart)
        || matches!(command, Subcommands::Sweep(args) if !args.dry_run);
    if joins || !launcher.several {
        return Ok(());
    }
    Err("of several commands under one launcher each must be a `seawall sweep` that runs"
        .to_owned())
}

/// Runs the command line and returns the process's exit code.
pub fn main() -> ExitCode {
    let launcher = Launcher::detect();
    // Without it long files end the program, as everywhere.
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

/// What the command line may be.
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
            if as_json && error.use_stderr() {
                failure::print_usage(&error.to_string());
            }
            if as_json && error.kind() == ErrorKind::DisplayVersion {
                failure::print(&json!({ "name": "seawall", "version": env!("CARGO_PKG_VERSION") }));
                return SUCCESS;
            }
            // Where nobody listens there is nobody to tell.
            let plain = error.to_string();
            let told = crate::keys::shown(&plain);
            let _ = match told == plain {
                true => error.print(),
                false => write!(std::io::stderr(), "{told}"),
            };
            return if error.use_stderr() { BAD_INPUT } else { SUCCESS };
        }
    };
    let output = Output::new(&cli.global, launcher);
    if let Err(reason) = simd_limit(&cli.command).and(joins(&cli.command, launcher)) {
        // A launcher may have given it to some ranks alone: each tells for itself.
        if launcher.rank > 0 {
            eprintln!("error: rank {}: {reason}", launcher.rank);
            return BAD_INPUT;
        }
        return failure::exit_code(Err(BadInput(reason).into()), launcher, output.is_json());
    }
    let result = match cli.command {
        Subcommands::Sweep(args) => sweep::main(&args, &output, launcher),
        _ if launcher.rank > 0 => Ok(SUCCESS),
        Subcommands::Run(args) => run::main(&args, &output),
        Subcommands::Film(args) => film::main(&args, &output),
        Subcommands::Check(args) => check::main(&args, &output),
        Subcommands::Init(args) => init::main(&args, &output),
        Subcommands::Explain(args) => explain::main(&args, &output),
        Subcommands::Status(args) => status::main(&args, &output),
        Subcommands::Slurm(args) => slurm::main(&args, &output),
        Subcommands::Verify(args) => verify::main(&args, &output),
        Subcommands::Show(args) => show::main(&args, &output),
        Subcommands::Report(args) => report::main(&args, &output),
        Subcommands::Find(args) => find::main(&args, &output),
        Subcommands::Compare(args) => compare::main(&args, &output),
        Subcommands::Reproduce(args) => reproduce::main(&args, &output),
        Subcommands::Accuracy(args) => accuracy::main(&args, &output),
        Subcommands::Stress(args) => stress::main(&args, &output),
        Subcommands::Apart => {
            let runner = |resources, keep| SphRunner { resources, film: None, keep };
            apart::serve(std::io::stdin().lock(), std::io::stdout().lock(), runner)
                .map(|()| SUCCESS)
        }
        Subcommands::Completions(args) => completions::completions(&args, &Cli::command(), &output),
        Subcommands::Man(args) => completions::man(&args, Cli::command(), &output),
    };
    failure::exit_code(result, launcher, output.is_json())
}

#[cfg(test)]
mod tests;
