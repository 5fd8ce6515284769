//! `seawall find`: the part of a finished study that meets a condition.

use std::path::PathBuf;

use clap::Args;

use super::SUCCESS;
use super::answer::Answer;
use super::failure::BadInput;
use super::output::Output;
use super::stored::demand_summary;
use crate::math::words::counted;
use crate::report::find::find;
use crate::report::load::Loaded;

/// Find the cases of a finished study that meet a condition. For each swept key, tell where they begin
/// and where they end.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall find results/runs/two_waves \"force_max < 2\"
  seawall find results/runs/two_waves \"force_max < 2 and displacement_max <= 0.5\"
  seawall find results/runs/two_waves \"F* < 2 and H/h = 0.5\"
  seawall find results/runs/two_waves \"runup_max > 1\" --format json

Any column of summary.csv that holds numbers will do, by its name or its symbol. Boundaries are interpolated
linearly, in the logarithm where the axis is logarithmic. Exit code: 0 whether or not a case meets the condition,
2 where the condition or the directory cannot be used.")]
pub(super) struct FindArgs {
    /// The output directory of a finished sweep.
    dir: PathBuf,
    /// Columns and limits: COLUMN < NUMBER, with <, <=, >, >= or =, and `and` between them.
    #[arg(value_name = "CONDITION")]
    condition: String,
}

pub(super) fn main(args: &FindArgs, output: &Output) -> anyhow::Result<u8> {
    demand_summary(&args.dir)?;
    let bad = |reason: &str| BadInput::of(&args.dir, reason);
    let data = Loaded::read(&args.dir).map_err(|error| BadInput(error.to_string()))?;
    if data.manifest.is_none() {
        return Err(bad("manifest.json is missing or damaged: it says what was swept").into());
    }
    if data.left() > 0 {
        let left = counted(data.left(), "case");
        let reason = format!("the study is not finished, {left} left: run its sweep again first");
        return Err(bad(&reason).into());
    }
    let found = find(&args.condition, &data).map_err(BadInput)?;
    let answer = Answer::new(&data, &found);
    output.result(&answer.text(output.verbose), &output.value(|| answer.value()))?;
    Ok(SUCCESS)
}
