//! `seawall check`: validates a file and says what it would take.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::input::{Expect, Setting, study};
use super::output::{Output, duration};
use super::physics::physics;
use super::table::Table;
use crate::math::simd::SimdPath;
use crate::results::counted;
use crate::scene::{CaseConfig, Scheme, limits};
use crate::simulation::cost;
use crate::study::{Plan, Study, schema};

/// Validate a sweep or scene file, list its cases and what they cost; run nothing.
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
    /// Set a value by its path; repeatable.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

/// Cases listed without `-v`.
const ROWS: usize = 10;

pub(super) fn main(args: &CheckArgs, output: &Output) -> anyhow::Result<u8> {
    let Some(file) = &args.file else {
        let schema = schema();
        output.result(&format!("{schema:#}\n"), &schema)?;
        return Ok(SUCCESS);
    };
    show(&study(file, &args.settings, Expect::Either)?, true, output)
}

pub(super) fn show(study: &Study, branching: bool, output: &Output) -> anyhow::Result<u8> {
    let costs: Vec<_> = study.cases.iter().map(|case| cost(&case.config)).collect();
    let plan = Plan::new(study, branching, cost, |_| true);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let range = |value: fn(&crate::simulation::Cost) -> u64| {
        let values = costs.iter().map(value);
        (values.clone().min().unwrap_or(0), values.max().unwrap_or(0))
    };
    let particles = range(|cost| cost.particles);
    let steps = range(|cost| cost.steps);
    let memory = range(|cost| cost.memory_bytes).1;
    let at_once = cores.min(study.run_count());
    let seconds = processor_time(study, &plan, SimdPath::widest()) / at_once.max(1) as f64;
    let (computed, from_rest) = (plan.total_cost(), plan.unbranched_cost());
    let saved = 100.0 * (1.0 - computed as f64 / from_rest.max(1) as f64);
    let physics = physics(study);

    let rows = if output.verbose { usize::MAX } else { ROWS };
    let mut table =
        Table::new(["case", "id"].into_iter().chain(study.keys.iter().map(String::as_str)));
    for case in study.cases.iter().take(rows) {
        let value = |value: &Option<toml::Value>| match value {
            Some(value) => value.to_string(),
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
        text.push_str(&line(&on.label, on.text()));
    }
    text.push_str(&line("cases", study.cases.len().to_string()));
    if !study.companions.is_empty() {
        text.push_str(&line("error bars", counted(study.companions.len(), "coarser companion")));
    }
    text.push_str(&line("particles", between(particles)));
    text.push_str(&line("steps per case", between(steps)));
    text.push_str(&line("memory per case", binary(memory)));
    text.push_str(&line("shared trunks", plan.trunks.len().to_string()));
    text.push_str(&line("saved by trunks", format!("{saved:.0} % of the steps")));
    let time = format!("{} on {}", duration(seconds), counted(cores, "core"));
    text.push_str(&line("estimated time", time));
    let warnings = warnings(study);
    for (warning, &cases) in &warnings {
        text.push_str(&format!("\nknown limit, {}: {warning}\n", counted(cases, "case")));
    }
    let cases: Vec<_> = study
        .cases
        .iter()
        .map(|case| {
            let values: serde_json::Map<_, _> = study.values(case).into_iter().collect();
            json!({ "index": case.index, "id": case.id, "values": values })
        })
        .collect();
    let value = json!({
        "name": study.name,
        "physics": physics.iter().map(|on| (on.name, &on.values)).collect::<BTreeMap<_, _>>(),
        "warnings": warnings.keys().collect::<Vec<_>>(),
        "cases": cases,
        "companions": study.companions.len(),
        "particles": particles,
        "steps": steps,
        "memory_bytes_per_case": memory,
        "trunks": plan.trunks.len(),
        "particle_steps": computed,
        "particle_steps_without_trunks": from_rest,
        "cores": cores,
        "estimated_time_s": seconds,
    });
    output.result(&text, &value)?;
    Ok(SUCCESS)
}

/// Seconds that a study takes on this machine's cores, or on so many threads.
pub(super) fn expected_seconds(study: &Study, threads: Option<usize>) -> f64 {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let at_once = threads.unwrap_or(cores).min(cores).min(study.run_count()).max(1);
    let plan = Plan::new(study, true, cost, |_| true);
    processor_time(study, &plan, SimdPath::widest()) / at_once as f64
}

/// Seconds that one core takes for a plan. Within a factor of two on the machines that it was
/// measured on: an AMD EPYC (Zen 5) is faster, an Intel Xeon (Sapphire Rapids) slower.
fn processor_time(study: &Study, plan: &Plan, simd: SimdPath) -> f64 {
    let time = |cost: u64, config: &CaseConfig| {
        cost as f64 / particle_steps_per_second(config.numerics.scheme, simd)
    };
    let trunks = plan.trunks.iter().map(|trunk| time(trunk.cost, &trunk.config));
    let cases = plan.cases.iter().map(|case| {
        let own = if case.trunk.is_some() { case.branch_cost } else { case.cost };
        time(own, &study.run(case.index).config)
    });
    trunks.chain(cases).sum()
}

/// Particle-steps per second and core. Of δ-SPH between the two machines of docs/measured.md; of
/// incompressible water what the EPYC took for `sweeps/scenes/movable_wall.toml` at 12.5 mm.
fn particle_steps_per_second(scheme: Scheme, simd: SimdPath) -> f64 {
    match (scheme, simd) {
        (Scheme::Isph, SimdPath::Portable) => 3.5e5,
        (Scheme::Isph, _) => 8e5,
        (Scheme::Wcsph, SimdPath::Avx512) => 9e6,
        (Scheme::Wcsph, SimdPath::Avx2) => 5e6,
        (Scheme::Wcsph, SimdPath::Portable) => 2.4e6,
    }
}

/// Bytes for the human eye: `15.2 MiB`, `28.0 GiB`.
pub(super) fn binary(bytes: u64) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    if mebibytes < 1024.0 {
        format!("{mebibytes:.1} MiB")
    } else {
        format!("{:.1} GiB", mebibytes / 1024.0)
    }
}

/// The known limits that the study runs into, with the number of cases.
fn warnings(study: &Study) -> BTreeMap<&'static str, usize> {
    let mut found = BTreeMap::new();
    for limit in study.cases.iter().flat_map(|case| limits(&case.config)) {
        *found.entry(limit).or_default() += 1;
    }
    found
}

fn between((low, high): (u64, u64)) -> String {
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::SweepFile;

    /// Seconds of one core for a single scene.
    fn seconds(scheme: &str) -> f64 {
        let text = format!("name = \"a\"\n[numerics]\nscheme = \"{scheme}\"");
        let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
        processor_time(&study, &Plan::new(&study, true, cost, |_| true), SimdPath::Avx512)
    }

    #[test]
    fn incompressible_water_is_expected_to_cost_several_times_as_much() {
        let ratio = seconds("isph") / seconds("wcsph");
        assert!((2.0..8.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn memory_is_told_in_units_that_fit() {
        assert_eq!(binary(20_000_000), "19.1 MiB");
        assert_eq!(binary(30_008_000_000), "27.9 GiB");
    }
}
