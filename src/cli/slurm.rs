//! `seawall slurm`: a job script for a cluster's queue.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::input::{Expect, Setting, default_out, study};
use super::options;
use super::output::{Output, json_path};
use crate::keys::named;

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
    #[arg(long, value_parser = options::whole(1, 100_000_u32), allow_negative_numbers = true)]
    nodes: u32,
    /// Time limit, as sbatch takes it: minutes, HH:MM:SS or DAYS-HH:MM:SS.
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    time: String,
    /// Ranks on each node [default: 1]. Without this and --threads the job asks for whole nodes and uses all
    /// their cores.
    #[arg(long, value_name = "N", value_parser = options::whole(1, 10_000_u32), allow_negative_numbers = true)]
    ranks_per_node: Option<u32>,
    /// Threads of each rank [default: 1, or all cores of whole nodes].
    #[arg(long, value_name = "N", value_parser = options::whole(1, 10_000_u32), allow_negative_numbers = true)]
    threads: Option<u32>,
    /// The sweep is told to stop so many seconds before the time limit.
    #[arg(long, value_name = "SECONDS", default_value_t = 120, value_parser = options::whole(1, 65_535_u32), allow_negative_numbers = true)]
    grace_s: u32,
    /// The command that starts the ranks.
    #[arg(long, value_name = "COMMAND", value_parser = command, default_value = "srun --mpi=pmix --kill-on-bad-exit=1")]
    launcher: String,
    /// Where results go [default: results/runs/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Set a key of the file, such as numerics.boundary=improved-shepard. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

/// The script, with names in braces where values are filled in.
const SCRIPT: &str = include_str!("../../data/slurm.sh");

/// Keeps mpirun of Open MPI 4 and 5 from binding a rank to one core. Other launchers pay no heed.
const UNBOUND: &str =
    "OMPI_MCA_hwloc_base_binding_policy=none PRTE_MCA_hwloc_default_binding_policy=none";

fn command(text: &str) -> Result<String, String> {
    let refused = || "must be a command, such as srun or mpirun".to_owned();
    Some(text.trim()).filter(|text| !text.is_empty()).map(str::to_owned).ok_or_else(refused)
}

/// The longest time limit that is taken. Longer ones are slips, or exceed sbatch's counter.
const LONGEST_DAYS: f64 = 1000.0;
const DAY_S: f64 = 86_400.0;

/// How much sooner than asked Slurm may send its signal, seconds (sbatch's manual, `--signal`).
const SOONER_S: f64 = 60.0;

fn time(text: &str) -> Result<String, String> {
    let refused = || {
        format!(
            "must be minutes, HH:MM:SS or DAYS-HH:MM:SS, of MM and SS below 60, more than nothing and at most \
             {LONGEST_DAYS} days"
        )
    };
    let fits = |seconds: &f64| *seconds > 0.0 && *seconds <= LONGEST_DAYS * DAY_S;
    seconds(text).filter(fits).map(|_| text.to_owned()).ok_or_else(refused)
}

/// A time limit in seconds. Without days and hours, minutes come first.
fn seconds(text: &str) -> Option<f64> {
    let (days, clock) = text.split_once('-').map_or((None, text), |(d, clock)| (Some(d), clock));
    let number = |part: &str| {
        let digits = !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        part.parse::<f64>().ok().filter(|_| digits)
    };
    let clock = clock.split(':').map(number).collect::<Option<Vec<_>>>()?;
    let units = match (days, clock.len()) {
        (Some(_), 1..=3) | (None, 3) => [3600.0, 60.0, 1.0],
        (None, 1 | 2) => [60.0, 1.0, 0.0],
        _ => return None,
    };
    if clock[1..].iter().any(|&value| value >= 60.0) {
        return None;
    }
    let clock: f64 = clock.iter().zip(units).map(|(value, unit)| value * unit).sum();
    Some(clock + DAY_S * days.map_or(Some(0.0), number)?)
}

/// A text with each `{NAME}` replaced. The values are not searched again.
fn filled(mut script: &str, names: &[(&str, String)]) -> String {
    let mut text = String::new();
    while let Some(at) = script.find('{') {
        let (before, rest) = script.split_at(at);
        let name = names.iter().find(|(name, _)| rest.starts_with(name));
        text += before;
        text += name.map_or("{", |(_, is)| is);
        script = &rest[name.map_or(1, |(name, _)| name.len())..];
    }
    text + script
}

/// What a job takes of its nodes.
struct Share {
    /// Lines for sbatch.
    cores: String,
    /// The command that starts the ranks, with its environment.
    launch: String,
    /// Options for the sweep.
    threads: String,
}

impl Share {
    /// Ranks and threads as asked for. Where nothing is asked one rank takes all cores of a node: without
    /// `--threads` a rank sees how many it may use.
    fn of(args: &SlurmArgs) -> Share {
        let launcher = &args.launcher;
        let by_srun = launcher.starts_with("srun");
        if (args.ranks_per_node, args.threads) == (None, None) {
            let bind = if by_srun { "SLURM_CPU_BIND=none" } else { UNBOUND };
            return Share {
                cores: "#SBATCH --exclusive\n#SBATCH --ntasks-per-node=1".to_owned(),
                launch: format!("{bind} {launcher}"),
                threads: String::new(),
            };
        }
        let [ranks, threads] = [args.ranks_per_node, args.threads].map(|asked| asked.unwrap_or(1));
        let launch = match (threads, by_srun) {
            (1, _) => launcher.clone(),
            // The srun inside mpirun starts a node's daemon, which needs the cores of all its ranks.
            (_, true) => {
                format!("SRUN_CPUS_PER_TASK=\"${{SLURM_CPUS_PER_TASK-{threads}}}\" {launcher}")
            }
            (_, false) => format!("{UNBOUND} {launcher}"),
        };
        Share {
            cores: format!("#SBATCH --ntasks-per-node={ranks}\n#SBATCH --cpus-per-task={threads}"),
            launch,
            threads: format!(" --threads {threads}"),
        }
    }
}

pub(super) fn main(args: &SlurmArgs, output: &Output) -> anyhow::Result<u8> {
    let (time, grace) = (&args.time, args.grace_s);
    if seconds(time).is_some_and(|limit| limit < f64::from(grace) + SOONER_S) {
        return Err(BadInput(format!(
            "--time {time}: the sweep is told to stop {grace} s before (--grace-s), by Slurm up to {SOONER_S} s \
             sooner; give it {SOONER_S} s more than the grace, or longer"
        ))
        .into());
    }
    let study = study(&args.file, &args.settings, Expect::Grid)?;
    let out = args.out.clone().unwrap_or_else(|| default_out(&study));
    let Share { cores, launch, threads } = Share::of(args);
    let mut more = threads;
    for setting in &args.settings {
        more += &format!(" --set {}", quoted(&setting.text));
    }
    let text = [
        ("{NAME}", study.name.clone()),
        ("{NODES}", args.nodes.to_string()),
        ("{CORES}", cores),
        ("{TIME}", args.time.clone()),
        ("{GRACE}", args.grace_s.to_string()),
        ("{SEAWALL}", absolute(&std::env::current_exe()?)?),
        ("{FILE}", absolute(&args.file)?),
        ("{OUT}", absolute(&out)?),
        ("{FOLDER}", absolute(&std::env::current_dir()?)?),
        ("{LAUNCH}", launch),
        ("{MORE}", more),
    ];
    let script = filled(SCRIPT, &text);
    output.result(&script, &json!({ "script": script, "out": json_path(&out) }))?;
    Ok(SUCCESS)
}

/// A path that is right wherever the job starts, as a word of the shell.
fn absolute(path: &Path) -> Result<String, BadInput> {
    let told = || format!("{}: is no UTF-8 text, which a job script must be", named(path));
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
        for good in ["30", "1:30", "36:00:00", "2-0", "2-12:30", "1-00:00:00", "1000-0"] {
            assert_eq!(time(good).as_deref(), Ok(good));
        }
        for bad in ["", "0", "00:00", "1h", "1-", "-5", "1:2:3:4", "1-2:3:4:5", "1:", "ten", "1e3"]
        {
            assert!(time(bad).is_err(), "{bad}");
        }
        for absurd in ["00:61:00", "0:0:60", "5:60", "1-2:60", "1000-0:0:1", "99999999999-0", "0-0"]
        {
            let told = time(absurd).unwrap_err();
            assert!(told.ends_with("below 60, more than nothing and at most 1000 days"), "{told}");
        }
        let all = ["2", "1:30", "1:00:01", "1-2", "1-0:1", "0-0:0:5"].map(seconds);
        assert_eq!(all, [120.0, 90.0, 3601.0, 93_600.0, 86_460.0, 5.0].map(Some));
    }

    #[test]
    fn what_is_filled_in_stays_as_it_is() {
        let names = [("{A}", "{B} {".to_owned()), ("{B}", "it".to_owned())];
        assert_eq!(filled("${x} {A}{B}{", &names), "${x} {B} {it{");
    }

    #[test]
    fn a_word_of_the_shell_stays_one() {
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}
