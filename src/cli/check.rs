//! `seawall check`: validates a file and says what it would take.

use std::path::PathBuf;

use clap::Args;

use super::expected::Expected;
use super::failure::BadInput;
use super::input::{Expect, Setting, study};
use super::output::Output;
use super::table::Table;
use super::{SUCCESS, max_error};
use crate::keys::{Shared, shortened};
use crate::study::{Study, schema};

/// Check a sweep or scene file, and list its cases and what they cost. Nothing runs.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall check sweeps/nightly.toml
  seawall check sweeps/liang2017.toml -v
  seawall check --schema > seawall.schema.json
  seawall check sweeps/nightly.toml --set numerics.particle_spacing_m=0.016 --format json")]
pub(super) struct CheckArgs {
    /// The sweep or scene file.
    #[arg(required_unless_present = "schema")]
    file: Option<PathBuf>,
    /// Print the JSON Schema of sweep and scene files instead, for editors.
    #[arg(long, conflicts_with_all = ["file", "settings"])]
    schema: bool,
    /// Set a key of the file, such as numerics.particle_spacing_m=0.016. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
    /// Choose the numerics case by case, as `seawall sweep --max-error` does.
    #[arg(long, value_name = "PERCENT", conflicts_with = "schema", allow_hyphen_values = true, value_parser = max_error::percent)]
    max_error: Option<f64>,
}

/// How many cases are listed without `-v`.
const ROWS: usize = 10;

pub(super) fn main(args: &CheckArgs, output: &Output) -> anyhow::Result<u8> {
    let Some(file) = &args.file else {
        let schema = schema();
        output.result(&format!("{schema:#}\n"), &schema)?;
        return Ok(SUCCESS);
    };
    let study = study(file, &args.settings, Expect::Either)?;
    let study = match (study.keys.is_empty(), args.max_error) {
        (false, _) => max_error::chosen(args.max_error, study, output)?,
        (true, None) => study,
        (true, Some(percent)) => {
            let reason = "chooses the numerics of a sweep; this file has no [grid], and `run` takes it as it is";
            return Err(BadInput(format!("--max-error {percent}: {reason}")).into());
        }
    };
    show(&study, true, output)
}

pub(super) fn show(study: &Study, branching: bool, output: &Output) -> anyhow::Result<u8> {
    let expected = Expected::of(study, branching)?;
    let rows = if output.verbose { usize::MAX } else { ROWS };
    output.result(&(first_cases(study, rows) + &expected.text()), &expected.json())?;
    Ok(SUCCESS)
}

/// A table of the first `rows` cases, and the number of further ones.
fn first_cases(study: &Study, rows: usize) -> String {
    let mut table =
        Table::new(["case", "id"].into_iter().chain(study.keys.iter().map(String::as_str)));
    for case in study.cases.iter().take(rows) {
        let value = |value: &Option<Shared<toml::Value>>| match value {
            Some(value) => shortened(&value.to_string()),
            None => "-".to_owned(),
        };
        let place = [case.index.to_string(), case.id.to_string()];
        table.row(place.into_iter().chain(case.assignments.iter().map(value)));
    }
    let mut text = table.render();
    if study.cases.len() > rows {
        text.push_str(&format!("... and {} more (-v lists all)\n", study.cases.len() - rows));
    }
    text
}
