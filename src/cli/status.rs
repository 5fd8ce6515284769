//! `seawall status`: the progress of a sweep, from its files alone.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::output::Output;
use super::standing::Standing;
use super::watch::Watch;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS, options};

/// Show what is done, what failed and why, what is left, and the time to go.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall status results/runs/nightly
  seawall status results/runs/nightly --format json
  seawall status results/runs/nightly --exit-code || echo 'not done, or not all well'
  seawall status results/runs/nightly --watch 30")]
pub(super) struct StatusArgs {
    /// The output directory of a sweep.
    dir: PathBuf,
    /// End with the sweep's own exit code: 0 all well, 1 some case failed, 3 something is left.
    #[arg(long)]
    exit_code: bool,
    /// Look again every so many seconds while the sweep runs, and tell how fast it goes. With `--format json`
    /// each look is one line (JSON lines).
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = "10", value_parser = options::seconds(0.1, 1e6), allow_negative_numbers = true)]
    watch: Option<f64>,
}

pub(super) fn main(args: &StatusArgs, output: &Output) -> anyhow::Result<u8> {
    let mut seen = Standing::of(&args.dir)?;
    let mut watch = Watch::begin(seen.view());
    while let Some(pause) = args.watch.filter(|_| seen.running) {
        output.line(&watch.with_rate(&seen.text(), seen.view()), &seen.json())?;
        std::thread::sleep(Duration::from_secs_f64(pause));
        seen = Standing::of(&args.dir)?;
    }
    let told = watch.with_rate(&seen.text(), seen.view());
    match args.watch {
        Some(_) => output.line(&told, &seen.json())?,
        None => output.result(&told, &seen.json())?,
    }
    Ok(match (seen.is_whole(), seen.failed) {
        _ if !args.exit_code => SUCCESS,
        (true, 0) => SUCCESS,
        (true, _) => CASES_FAILED,
        (false, _) => INTERRUPTED,
    })
}
