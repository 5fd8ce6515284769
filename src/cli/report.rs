//! `seawall report`: tables and figures from files alone.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::output::Output;

/// Write tables, figures and report.html from a sweep's files; simulate nothing.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall report results/runs/nightly")]
pub(super) struct ReportArgs {
    /// The output directory of a sweep.
    dir: PathBuf,
}

pub(super) fn main(args: &ReportArgs, output: &Output) -> anyhow::Result<u8> {
    if !args.dir.join("summary.csv").is_file() {
        let reason = "holds no summary.csv: not the output directory of a sweep";
        return Err(BadInput(format!("{}: {reason}", args.dir.display())).into());
    }
    let report = crate::report::write(&args.dir)?;
    output.result(&format!("report: {}\n", report.display()), &json!({ "report": report }))?;
    Ok(SUCCESS)
}
