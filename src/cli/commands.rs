//! The subcommands, each in a line: its arguments and whether it computes cases. Its `main` is in the same file.

use clap::{CommandFactory, Subcommand};

use super::output::Output;
use super::{
    Cli, SUCCESS, accuracy, check, compare, completions, explain, film, find, init, report,
    reproduce, run, show, slurm, status, stress, sweep, verify,
};
use crate::execute::{Launcher, SphRunner, apart, widest_simd};

/// Declares them. `sweep` stands apart, as all ranks of a launcher join in it; so do `apart`, and those that
/// share `completions.rs`.
macro_rules! commands {
    ($($name:ident($file:ident::$args:ident), computes $computes:expr;)+) => {
        #[derive(Debug, Subcommand)]
        pub(super) enum Subcommands {
            Sweep(sweep::SweepArgs),
            $($name($file::$args),)+
            /// Does a piece of a sweep's work, read from standard input.
            #[command(name = apart::SUBCOMMAND, hide = true)]
            Apart,
            Completions(completions::CompletionsArgs),
            Man(completions::ManArgs),
        }

        impl Subcommands {
            /// Whether it computes cases.
            fn computes(&self) -> bool {
                match self {
                    Subcommands::Sweep(args) => !args.dry_run,
                    $(Subcommands::$name(args) => {
                        let computes: fn(&$file::$args) -> bool = $computes;
                        computes(args)
                    })+
                    Subcommands::Apart => true,
                    Subcommands::Completions(_) | Subcommands::Man(_) => false,
                }
            }

            /// Does what it says, and returns the exit code. Other ranks than the first have work in a sweep alone.
            pub(super) fn run(self, output: &Output, launcher: Launcher) -> anyhow::Result<u8> {
                match self {
                    Subcommands::Sweep(args) => sweep::main(&args, output, launcher),
                    _ if launcher.rank > 0 => Ok(SUCCESS),
                    $(Subcommands::$name(args) => $file::main(&args, output),)+
                    Subcommands::Apart => {
                        let runner = |resources, keep| SphRunner { resources, film: None, keep };
                        apart::serve(std::io::stdin().lock(), std::io::stdout().lock(), runner)
                            .map(|()| SUCCESS)
                    }
                    Subcommands::Completions(args) => {
                        completions::completions(&args, &Cli::command(), output)
                    }
                    Subcommands::Man(args) => completions::man(&args, Cli::command(), output),
                }
            }
        }
    };
}

commands! {
    Run(run::RunArgs), computes |_| true;
    Film(film::FilmArgs), computes |_| true;
    Check(check::CheckArgs), computes |_| false;
    Init(init::InitArgs), computes |_| false;
    Explain(explain::ExplainArgs), computes |_| false;
    Status(status::StatusArgs), computes |_| false;
    Slurm(slurm::SlurmArgs), computes |_| false;
    Verify(verify::VerifyArgs), computes |args| args.rerun > 0;
    Show(show::ShowArgs), computes |_| false;
    Report(report::ReportArgs), computes |_| false;
    Find(find::FindArgs), computes |_| false;
    Compare(compare::CompareArgs), computes |_| false;
    Reproduce(reproduce::ReproduceArgs), computes |_| true;
    Accuracy(accuracy::AccuracyArgs), computes |_| true;
    Stress(stress::StressArgs), computes |_| true;
}

impl Subcommands {
    /// Whether it joins the other ranks of a launcher.
    fn joins(&self) -> bool {
        match self {
            Subcommands::Sweep(args) => !args.dry_run,
            // A child of a sweep's has its work from there.
            Subcommands::Apart => true,
            _ => false,
        }
    }

    /// Refuses what cannot run here. The environment may ask for an instruction set that there is not. Beside a sweep under
    /// the same launcher, what does not join it would be waited for without end.
    pub(super) fn demand(&self, launcher: Launcher) -> Result<(), String> {
        if self.computes() {
            widest_simd()?;
        }
        if self.joins() || !launcher.several {
            return Ok(());
        }
        Err("of several commands under one launcher each must be a `seawall sweep` that runs"
            .to_owned())
    }
}
