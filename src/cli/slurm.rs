//! `seawall slurm`: a job script for a cluster's queue.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::input::{Expect, Setting, default_out, study};
use super::output::Output;
use super::{numbers, shown};

/// Print a job script of a sweep for Slurm's sbatch. The job stops before its time limit, and queues itself
/// again until every case is done.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall slurm sweeps/liang2017.toml --nodes 4 --time 12:00:00 | sbatch
  seawall slurm study.toml --nodes 2 --time 30 --ranks-per-node 64 --launcher 'mpirun' > study.sh")]
pub(super) struct SlurmArgs {
    /// The sweep file.
    file: PathBuf,
    /// How many nodes the job has.
    #[arg(long, value_parser = numbers::whole(1, 100_000_u32), allow_negative_numbers = true)]
    nodes: u32,
    /// Time limit, as sbatch takes it: minutes, HH:MM:SS or DAYS-HH:MM:SS.
    #[arg(long, value_name = "TIME", value_parser = time)]
    time: String,
    /// Ranks on each node.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = numbers::whole(1, 10_000_u32), allow_negative_numbers = true)]
    ranks_per_node: u32,
    /// Threads of each rank.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = numbers::whole(1, 10_000_u32), allow_negative_numbers = true)]
    threads: u32,
    /// The sweep is told to stop so many seconds before the time limit.
    #[arg(long, value_name = "SECONDS", default_value_t = 120, value_parser = numbers::whole(1, 65_535_u32), allow_negative_numbers = true)]
    grace_s: u32,
    /// The command that starts the ranks.
    #[arg(long, value_name = "COMMAND", default_value = "srun --mpi=pmix --kill-on-bad-exit=1")]
    launcher: String,
    /// Where results go [default: results/runs/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Set a key of the file, such as numerics.boundary=improved-shepard. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

/// The script, with names in braces for what is filled in.
const SCRIPT: &str = include_str!("../../data/slurm.sh");

fn time(text: &str) -> Result<String, String> {
    let (days, clock) =
        text.split_once('-').map_or((None, text), |(days, clock)| (Some(days), clock));
    let parts: Vec<_> = days.into_iter().chain(clock.split(':')).collect();
    let number = |part: &&str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let some = parts.iter().any(|part| part.bytes().any(|byte| byte != b'0'));
    if parts.len() <= 4 && parts.iter().all(number) && some {
        return Ok(text.to_owned());
    }
    Err("must be minutes, HH:MM:SS or DAYS-HH:MM:SS, and more than nothing".to_owned())
}

pub(super) fn main(args: &SlurmArgs, output: &Output) -> anyhow::Result<u8> {
    let study = study(&args.file, &args.settings, Expect::Grid)?;
    let out = args.out.clone().unwrap_or_else(|| default_out(&study));
    let mut more = format!(" --threads {}", args.threads);
    for setting in &args.settings {
        more += &format!(" --set {}", quoted(&setting.text));
    }
    let text = [
        ("{NAME}", study.name.clone()),
        ("{NODES}", args.nodes.to_string()),
        ("{RANKS}", args.ranks_per_node.to_string()),
        ("{THREADS}", args.threads.to_string()),
        ("{TIME}", args.time.clone()),
        ("{GRACE}", args.grace_s.to_string()),
        ("{SEAWALL}", absolute(&std::env::current_exe()?)?),
        ("{FILE}", absolute(&args.file)?),
        ("{OUT}", absolute(&out)?),
        ("{LAUNCH}", args.launcher.clone()),
        ("{MORE}", more),
    ];
    let script = text.iter().fold(SCRIPT.to_owned(), |script, (name, is)| script.replace(name, is));
    output.result(&script, &json!({ "script": script, "out": shown::path(&out) }))?;
    Ok(SUCCESS)
}

/// A path that holds wherever the job starts, as a word of the shell.
fn absolute(path: &Path) -> Result<String, BadInput> {
    let told = || format!("{}: is no UTF-8 text, which a job script must be", path.display());
    let whole = std::path::absolute(path).map_err(|error| BadInput(error.to_string()))?;
    whole.to_str().map(quoted).ok_or_else(|| BadInput(told()))
}

/// A text as one word of the shell.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_sbatch() {
        for good in ["30", "1:30", "12:00:00", "2-0", "2-12:30", "1-00:00:00"] {
            assert_eq!(time(good).as_deref(), Ok(good));
        }
        for bad in ["", "0", "00:00", "1h", "1-", "-5", "1:2:3:4:5", "1:", "ten"] {
            assert!(time(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_word_of_the_shell_stays_one() {
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}
