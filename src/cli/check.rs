//! `seawall check`: validates a file and says what it would take.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use rayon::prelude::*;
use serde_json::json;

use super::cost::{binary, estimated_time, time_of_all};
use super::failure::BadInput;
use super::input::{Expect, Setting, study};
use super::output::{Output, duration};
use super::physics::physics;
use super::table::Table;
use super::warnings::warnings;
use super::{SUCCESS, max_error, refine};
use crate::keys::{Shared, brief};
use crate::math::lists::counts;
use crate::math::words::counted;
use crate::scene::limits;
use crate::simulation::{Cost, cost};
use crate::study::{Plan, Study, schema};

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

/// Cases that are looked at in one go.
const CHUNK: usize = 4096;
/// Cases listed without `-v`.
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
    let [particles, steps, memory] = ranges(study);
    let plan = Plan::new(study, branching, cost, |_| true);
    let (seconds, cores) = estimated_time(study, &plan);
    let aim = study.max_error_percent.filter(|_| !study.keys.is_empty());
    let longest = aim.map(|percent| max_error::longest(percent, study)).transpose()?;
    let (computed, from_rest) = (plan.total_cost(), plan.unbranched_cost());
    let saved = 100.0 * (1.0 - computed as f64 / from_rest.max(1) as f64);
    let time = if branching { (seconds, cores) } else { time_of_all(study) };
    let (physics, odd) = (physics(study), warnings(study, time));

    let rows = if output.verbose { usize::MAX } else { ROWS };
    let mut table =
        Table::new(["case", "id"].into_iter().chain(study.keys.iter().map(String::as_str)));
    for case in study.cases.iter().take(rows) {
        let value = |value: &Option<Shared<toml::Value>>| match value {
            Some(value) => brief(&value.to_string()),
            None => "-".to_owned(),
        };
        let place = [case.index.to_string(), case.id.to_string()];
        table.row(place.into_iter().chain(case.assignments.iter().map(value)));
    }
    let mut text = table.render();
    if study.cases.len() > rows {
        text.push_str(&format!("... and {} more (-v lists all)\n", study.cases.len() - rows));
    }
    let line = |name: &str, value: String| format!("{name:<19} {value}\n");
    text.push('\n');
    for on in &physics {
        text.push_str(&line(&on.label, on.text(&study.file_text)));
    }
    text.push_str(&line("cases", study.cases.len().to_string()));
    if let Some(asked) = &study.refine {
        text.push_str(&line("refine", refine::ahead(asked)));
    }
    if let Some(percent) = aim {
        text.push_str(&line("max error", max_error::ahead(percent)));
    }
    if !study.companions.is_empty() {
        text.push_str(&line("error bars", counted(study.companions.len(), "coarser companion")));
    }
    text.push_str(&line("particles", between(particles)));
    text.push_str(&line("steps per case", between(steps)));
    text.push_str(&line("memory per case", binary(memory.1)));
    text.push_str(&line("shared trunks", plan.trunks.len().to_string()));
    text.push_str(&line("saved by trunks", format!("{saved:.0} % of the steps")));
    let films = if study.keys.is_empty() { "" } else { ", without films" };
    let again = longest.filter(|&longest| longest > seconds);
    let again = again.map(|longest| format!(", up to {} with what runs again", duration(longest)));
    let (cores_told, again) = (counted(cores, "core"), again.unwrap_or_default());
    let time = format!("{} on {cores_told}{again}{films}", duration(seconds));
    text.push_str(&line("estimated time", time));
    for warning in &odd {
        text.push_str(&format!("\nwarning: {warning}\n"));
    }
    let limits = known_limits(study);
    for (limit, &cases) in &limits {
        text.push_str(&format!("\nknown limit, {}: {limit}\n", counted(cases, "case")));
    }
    let warnings: Vec<_> = odd.iter().map(String::as_str).chain(limits.into_keys()).collect();
    // Of a million cases that is much, and nobody reads it elsewhere.
    let listed = if output.is_json() { &study.cases[..] } else { &[] };
    let cases: Vec<_> = listed
        .iter()
        .map(|case| {
            let values: serde_json::Map<_, _> = study.values(case).into_iter().collect();
            json!({ "index": case.index, "id": case.id, "values": values })
        })
        .collect();
    let value = json!({
        "name": study.name,
        "physics": physics.iter().map(|on| (on.name, &on.values)).collect::<BTreeMap<_, _>>(),
        "warnings": warnings,
        "cases": cases,
        "refine": study.refine,
        "max_error_percent": study.max_error_percent,
        "companions": study.companions.len(),
        "particles": particles,
        "steps": steps,
        "memory_bytes_per_case": memory.1,
        "trunks": plan.trunks.len(),
        "particle_steps": computed,
        "particle_steps_without_trunks": from_rest,
        "cores": cores,
        "estimated_time_s": seconds,
        "longest_time_s": longest,
    });
    output.result(&text, &value)?;
    Ok(SUCCESS)
}

/// The least and the most that a case has of particles, steps and bytes.
fn ranges(study: &Study) -> [(u64, u64); 3] {
    let costs = study.cases.par_iter().map(|case| {
        let Cost { particles, steps, memory_bytes, .. } = cost(&case.config);
        [particles, steps, memory_bytes].map(|count| (count, count))
    });
    let wider = |a: [(u64, u64); 3], b: [(u64, u64); 3]| {
        [0, 1, 2].map(|of| (a[of].0.min(b[of].0), a[of].1.max(b[of].1)))
    };
    costs.reduce_with(wider).unwrap_or_default()
}

/// The known limits that the study runs into, with the number of cases.
fn known_limits(study: &Study) -> BTreeMap<&'static str, usize> {
    let chunks = study.cases.par_chunks(CHUNK);
    let chunks = chunks.map(|cases| counts(cases.iter().flat_map(|case| limits(&case.config))));
    chunks.reduce(BTreeMap::new, |mut all, more| {
        more.into_iter().for_each(|(limit, cases)| *all.entry(limit).or_default() += cases);
        all
    })
}

fn between((low, high): (u64, u64)) -> String {
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}
