//! `seawall report`: tables and figures from files alone.

use std::io::ErrorKind;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::Output;
use crate::report::ReportError;

/// Write tables, figures and report.html from a sweep's files; simulate nothing.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall report results/runs/nightly")]
pub(super) struct ReportArgs {
    /// The output directory of a sweep.
    dir: PathBuf,
}

pub(super) fn main(args: &ReportArgs, output: &Output) -> anyhow::Result<u8> {
    demand_output_of_study(&args.dir, "summary.csv")?;
    let report = crate::report::write(&args.dir).map_err(unusable)?;
    output.result(&format!("report: {}\n", report.display()), &json!({ "report": report }))?;
    Ok(SUCCESS)
}

/// A directory that cannot be written is bad input, as for every command with an output directory.
fn unusable(error: ReportError) -> anyhow::Error {
    match &error {
        ReportError::Write { source, .. } if !is_the_disks(source.kind()) => {
            BadInput(error.to_string()).into()
        }
        _ => error.into(),
    }
}

/// Whether the machine failed rather than the place being wrong.
fn is_the_disks(kind: ErrorKind) -> bool {
    use ErrorKind::{
        AlreadyExists, IsADirectory, NotADirectory, PermissionDenied, ReadOnlyFilesystem,
    };
    !matches!(
        kind,
        AlreadyExists | IsADirectory | NotADirectory | PermissionDenied | ReadOnlyFilesystem
    )
}
